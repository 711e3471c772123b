#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"
#include "write/packed_rtree.hpp"

namespace d2b {

/// The spatial index of a new layer of a GeoPackage, made in one go when all features are there. GDAL
/// declares it on the empty table, so that what others see is GDAL's own; its triggers rest until it is
/// filled.
/// GDAL 3.6 adds boxes one by one, in ten times as long; from 3.8 on it packs them itself. This is used with
/// every version all the same: one way is tested, and a result has the same bytes whatever GDAL writes it. It
/// may go when 3.8 is the oldest version that is built with.
class SpatialIndex {
  public:
    /// @returns nothing where GDAL or SQLite does not allow it; then all is as it was, and GDAL makes the
    /// index
    [[nodiscard]] static std::optional<SpatialIndex> begin(GDALDatasetH dataset, OGRLayerH layer,
                                                           const WriteTarget& target);

    void add(std::int64_t id, const Feature& feature);
    /// @throws OutputError
    void finish();

  private:
    SpatialIndex(GDALDatasetH dataset, const WriteTarget& target) : dataset_(dataset), target_(&target) {}

    [[nodiscard]] bool run(const std::string& sql) const;
    void rest_triggers(const std::string& table);
    void fill(const PackedRtree& tree) const;

    GDALDatasetH dataset_;
    const WriteTarget* target_;
    std::string name_;  ///< of the virtual table
    std::size_t node_bytes_ = 0;
    std::vector<std::string> triggers_;  ///< that have to be created again
    std::vector<IndexedBox> boxes_;
};

}  // namespace d2b
