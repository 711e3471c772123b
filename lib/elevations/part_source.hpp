#pragma once

#include <span>

#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Restricts a DEM to a part of its window. Notices remain with the DEM itself.
class PartSource final : public DemSource {
  public:
    /// @param whole the DEM, which must outlive this object
    /// @param part part of its window
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
