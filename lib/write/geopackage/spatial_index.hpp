#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <sqlite3.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_util.hpp"

namespace d2b {

/// Bounding box of a feature in single precision, rounded outwards.
struct IndexedBox {
    std::int64_t id = 0;
    float min_x = 0;
    float max_x = 0;
    float min_y = 0;
    float max_y = 0;
};

/// R-tree in the storage format of SQLite's rtree module, bulk-loaded by sort-tile-recursive packing
/// (Leutenegger, Lopez and Edgington 1997). Takes a tenth of the time of one-by-one insertion and overlaps
/// less.
struct PackedRtree {
    struct Node {
        std::int64_t number = 0;       ///< 1 is the root
        std::int64_t parent = 0;       ///< 0 for the root
        std::vector<std::byte> bytes;  ///< blob of the _node table
    };
    struct Entry {
        std::int64_t id = 0;
        std::int64_t leaf = 0;  ///< number of the leaf that holds it
    };
    std::vector<Node> nodes;
    std::vector<Entry> entries;  ///< ascending ids
};

/// @param node_bytes node size chosen by SQLite; at least two cells fit @pre not empty
[[nodiscard]] PackedRtree pack_rtree(std::vector<IndexedBox> boxes, std::size_t node_bytes);

/// Inserts many rows into a table of a GeoPackage: with a prepared statement, which takes a third of the time
/// of SQL text, or with multi-row SQL text if GDAL links another copy of SQLite than this library.
class RowInserts {
  public:
    using Cell = std::variant<std::int64_t, std::span<const std::byte>>;

    /// @param handle of the dataset; null to use SQL text @param head e.g. INSERT INTO "a" VALUES
    /// @param doing purpose of the rows, for messages
    RowInserts(GDALDatasetH dataset, sqlite3* handle, const WriteTarget& target, std::string head,
               std::string doing);

    /// @param row with the same number of cells as the previous row @throws OutputError
    void add(std::initializer_list<Cell> row);
    /// Call after the last row. @throws OutputError
    void finish();

  private:
    void bind(std::initializer_list<Cell> row);
    void append(std::initializer_list<Cell> row);
    [[noreturn]] void fail() const;

    GDALDatasetH dataset_;
    sqlite3* handle_;
    const WriteTarget& target_;
    std::string head_;
    std::string doing_;
    std::string sql_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_{nullptr, sqlite3_finalize};
};

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
    void drop_triggers(const std::string& table);
    void fill(const PackedRtree& tree) const;

    GDALDatasetH dataset_;
    const WriteTarget* target_;
    std::string name_;  ///< name of the virtual table
    std::size_t node_bytes_ = 0;
    std::vector<std::string> triggers_;  ///< statements to recreate them
    std::vector<IndexedBox> boxes_;
};

}  // namespace d2b
