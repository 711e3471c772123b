#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/run.hpp"
#include "raster/blended_margin.hpp"

namespace d2b {

/// DEM whose cells in a margin beside missing ones have `blended_value`.
class UnblendedSource final : public DemSource {
  public:
    explicit UnblendedSource(DemSource& source) : source_(source) {}

    /// @pre nothing reads at the same time
    void set_margin(BlendedMargin margin) { margin_ = std::move(margin); }

    [[nodiscard]] const DemInfo& info() const override { return source_.info(); }
    void read(const Window& part, std::span<double> elevations) override {
        read_without_margin(
            margin_, info().window, part, elevations,
            [this](const Window& area, std::span<double> values) { source_.read(area, values); });
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return source_.take_warnings(); }

  private:
    DemSource& source_;
    BlendedMargin margin_;
};

/// Returns the sources with another DEM.
[[nodiscard]] inline Sources with_dem(const Sources& sources, DemSource& dem) {
    return {dem,
            sources.terrain,
            sources.mask,
            sources.ndvi,
            sources.parcels,
            sources.footprints,
            sources.exclusion,
            sources.corrections};
}

}  // namespace d2b
