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

/// Builds the spatial index of a new layer of a GeoPackage at once after the last feature.
///
/// GDAL creates the empty index, so that its declaration is GDAL's own; its triggers are dropped until the
/// index is filled. GDAL 3.6 inserts boxes one by one, which takes ten times as long; GDAL 3.8 and later pack
/// them too. This class is used with all versions, because then only one path needs testing and results have
/// the same bytes with every version. It can be removed when 3.8 is the oldest supported version.
class SpatialIndex {
  public:
    /// @return nothing if GDAL or SQLite does not permit it; nothing has changed then, and GDAL creates the
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
    std::string name_;  ///< name of the virtual table
    std::size_t node_bytes_ = 0;
    std::vector<std::string> triggers_;  ///< statements to recreate them
    std::vector<IndexedBox> boxes_;
};

}  // namespace d2b
