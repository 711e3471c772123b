#pragma once

#include <span>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// A part of a DEM, which is read as if its window were no larger. What the DEM notices is its own to tell.
class PartSource final : public DemSource {
  public:
    /// @param whole which must outlive this @param part of its window
    PartSource(DemSource& whole, const Window& part) : whole_(whole), info_(whole.info()) {
        info_.window = part;
    }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(const Window& part, std::span<double> elevations) override { whole_.read(part, elevations); }

  private:
    DemSource& whole_;
    DemInfo info_;
};

}  // namespace d2b
