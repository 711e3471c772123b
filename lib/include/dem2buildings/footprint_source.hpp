#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Feature whose polygons are a footprint.
struct GivenFootprint {
    std::int64_t fid = 0;                ///< its number in messages
    std::vector<WorldPolygon> polygons;  ///< may be invalid; empty if it has none; curves are lines
    /// The same polygons in the CRS of the output, if that is another one.
    std::vector<WorldPolygon> projected;
    std::vector<std::byte> original;  ///< the whole feature, see LayerSpec::original; may be empty
};

/// Source of footprints that exist, in any CRS. They may overlap.
class FootprintSource {
  public:
    FootprintSource() = default;
    FootprintSource(const FootprintSource&) = delete;
    FootprintSource& operator=(const FootprintSource&) = delete;
    virtual ~FootprintSource() = default;

    /// Returns the CRS of the polygons as WKT2:2019; "" for that of the DEM.
    [[nodiscard]] virtual std::string crs_wkt() const { return {}; }
    /// Returns the layer that the features come from; null if they have no fields to keep.
    [[nodiscard]] virtual std::shared_ptr<const OriginalLayer> layer() const { return nullptr; }
    /// Calls use(footprint) for each, in the order of the source. Called once; afterwards the source holds no
    /// file open, so that the result may go into the same file. @throws InputError
    virtual void for_each(const std::function<void(GivenFootprint&&)>& use) = 0;
    /// Same as DemSource::take_warnings().
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
