#include "write/geopackage/spatial_index.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"

namespace d2b::writing {
namespace {

// https://www.sqlite.org/rtree.html, section 6: a node has its depth (only set in the root) and number of
// cells, two bytes each, then cells of an id and four coordinates; all big-endian.
constexpr std::size_t head_bytes = 4;
constexpr std::size_t cell_bytes = 24;
constexpr int byte_bits = 8;

/// Writes an integer, big-endian, and advances.
template <typename Unsigned>
void put_big_endian(std::span<std::byte>& left, Unsigned value) {
    for (std::size_t i = sizeof value; i > 0; --i) {
        left[i - 1] = static_cast<std::byte>(value);
        value = static_cast<Unsigned>(value >> byte_bits);
    }
    left = left.subspan(sizeof value);
}

std::vector<std::byte> encode_node(std::span<const IndexedBox> cells, std::size_t depth,
                                   std::size_t node_bytes) {
    std::vector<std::byte> bytes(node_bytes);
    std::span<std::byte> left(bytes);
    put_big_endian(left, static_cast<std::uint16_t>(depth));
    put_big_endian(left, static_cast<std::uint16_t>(cells.size()));
    for (const IndexedBox& cell : cells) {
        put_big_endian(left, static_cast<std::uint64_t>(cell.id));
        for (const float value : {cell.min_x, cell.max_x, cell.min_y, cell.max_y})
            put_big_endian(left, std::bit_cast<std::uint32_t>(value));
    }
    return bytes;
}

IndexedBox bounding_box(std::span<const IndexedBox> boxes, std::int64_t id) {
    IndexedBox all = boxes.front();
    all.id = id;
    for (const IndexedBox& box : boxes) {
        all.min_x = std::min(all.min_x, box.min_x);
        all.max_x = std::max(all.max_x, box.max_x);
        all.min_y = std::min(all.min_y, box.min_y);
        all.max_y = std::max(all.max_y, box.max_y);
    }
    return all;
}

std::size_t ceil_div(std::size_t count, std::size_t most) {
    return (count + most - 1) / most;
}

/// Returns the begin of part i of n parts of nearly equal size.
std::size_t part_begin(std::size_t count, std::size_t n, std::size_t i) {
    return count * i / n;
}

/// Sorts into vertical slices by x, each by y, so that neighbours in the list are neighbours on the map.
void sort_tile_recursive(std::span<IndexedBox> boxes, std::size_t cells_per_node) {
    const auto by_x = [](const IndexedBox& a, const IndexedBox& b) {
        return std::pair(a.min_x + a.max_x, a.id) < std::pair(b.min_x + b.max_x, b.id);
    };
    const auto by_y = [](const IndexedBox& a, const IndexedBox& b) {
        return std::pair(a.min_y + a.max_y, a.id) < std::pair(b.min_y + b.max_y, b.id);
    };
    std::ranges::sort(boxes, by_x);
    const auto leaves = static_cast<double>(ceil_div(boxes.size(), cells_per_node));
    const auto slices = static_cast<std::size_t>(std::ceil(std::sqrt(leaves)));
    for (std::size_t i = 0; i < slices; ++i) {
        const std::size_t begin = part_begin(boxes.size(), slices, i);
        std::ranges::sort(boxes.subspan(begin, part_begin(boxes.size(), slices, i + 1) - begin), by_y);
    }
}

using Bytes = std::span<const std::byte>;

/// Inserts many rows into a table of two columns with a prepared statement, which takes a third of the time
/// of SQL text.
class RowInserts {
  public:
    /// @param begin e.g. INSERT INTO "a"
    RowInserts(sqlite3* handle, const WriteTarget& target, const std::string& begin)
        : handle_(handle), target_(target) {
        sqlite3_stmt* statement = nullptr;
        const bool prepared = sqlite3_prepare_v2(handle_, (begin + " VALUES (?,?)").c_str(), -1, &statement,
                                                 nullptr) == SQLITE_OK;
        statement_.reset(statement);
        require(prepared);
    }

    /// @throws OutputError
    void add(std::int64_t first, std::int64_t second) {
        step(first, sqlite3_bind_int64(statement_.get(), 2, second));
    }
    void add(std::int64_t first, Bytes second) {
        step(first, sqlite3_bind_blob64(statement_.get(), 2, second.data(), second.size(), SQLITE_STATIC));
    }

  private:
    void step(std::int64_t first, int bound) {
        require(bound == SQLITE_OK && sqlite3_bind_int64(statement_.get(), 1, first) == SQLITE_OK);
        const bool done = sqlite3_step(statement_.get()) == SQLITE_DONE;
        require(sqlite3_reset(statement_.get()) == SQLITE_OK && done);
    }
    void require(bool done) const {
        if (done)
            return;
        const std::string reason = sqlite3_errmsg(handle_);
        throw OutputError("Cannot write \"" + target_.name + "\": filling the spatial index failed (" +
                          reason + ")" + advice_for(reason) + ".");
    }

    sqlite3* handle_;
    const WriteTarget& target_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_{nullptr, sqlite3_finalize};
};

constexpr float infinity = std::numeric_limits<float>::infinity();

float round_down(double value) {
    const auto near = static_cast<float>(value);
    return static_cast<double>(near) > value ? std::nextafter(near, -infinity) : near;
}

float round_up(double value) {
    const auto near = static_cast<float>(value);
    return static_cast<double>(near) < value ? std::nextafter(near, infinity) : near;
}

}  // namespace

PackedRtree pack_rtree(std::vector<IndexedBox> boxes, std::size_t node_bytes) {
    const std::size_t most = (node_bytes - head_bytes) / cell_bytes;
    sort_tile_recursive(boxes, most);
    PackedRtree tree;
    std::int64_t next_number = 2;
    for (std::size_t depth = 0;; ++depth) {
        const std::size_t count = ceil_div(boxes.size(), most);
        std::vector<IndexedBox> parents;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t begin = part_begin(boxes.size(), count, i);
            const auto cells =
                std::span(boxes).subspan(begin, part_begin(boxes.size(), count, i + 1) - begin);
            const std::int64_t number = count == 1 ? 1 : next_number++;
            tree.nodes.push_back({number, 0, encode_node(cells, count == 1 ? depth : 0, node_bytes)});
            parents.push_back(bounding_box(cells, number));
            for (const IndexedBox& cell : cells)
                if (depth == 0)
                    tree.entries.push_back({cell.id, number});
                else
                    tree.nodes[static_cast<std::size_t>(cell.id) - 2].parent = number;
        }
        if (count == 1)
            break;
        boxes = std::move(parents);
    }
    std::ranges::sort(tree.entries, {}, &PackedRtree::Entry::id);
    return tree;
}

bool SpatialIndex::run(const std::string& sql) const {
    return sql_succeeds(dataset_, sql);
}

std::optional<SpatialIndex> SpatialIndex::begin(GDALDatasetH dataset, OGRLayerH layer,
                                                const WriteTarget& target) {
    sqlite3* const handle = sqlite_handle(dataset);
    if (handle == nullptr)
        return std::nullopt;
    const reading::GdalMessages quiet;
    const std::string table = OGR_L_GetName(layer);
    const std::string column = OGR_L_GetGeometryColumn(layer);
    SpatialIndex index(dataset, handle, target);
    index.name_ = "rtree_" + table + "_" + column;
    const std::string nodes = sql_identifier(index.name_ + "_node");
    const auto read_node_size = [&] {
        sql_query(dataset, "SELECT length(data) FROM " + nodes + " WHERE nodeno = 1",
                  [&](const auto& row) { index.node_bytes_ = std::stoul(row[0]); });
        return index.node_bytes_ > 0;
    };
    // GDAL creates deferred indices before it runs SQL; otherwise create it explicitly.
    if (!read_node_size() &&
        !(index.run("SELECT CreateSpatialIndex(" + sql_literal(table) + ", " + sql_literal(column) + ")") &&
          read_node_size()))
        return std::nullopt;
    // SQLite may protect its shadow tables against writing.
    if (!index.run("UPDATE " + nodes + " SET data = data WHERE nodeno = 1"))
        return std::nullopt;
    index.drop_triggers(table);
    return index;
}

void SpatialIndex::drop_triggers(const std::string& table) {
    std::vector<std::string> names;
    sql_query(dataset_,
              "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND tbl_name = " +
                  sql_literal(table) + " ORDER BY rowid",
              [&](const auto& row) {
                  if (!row[0].starts_with(name_))
                      return;
                  names.push_back(row[0]);
                  triggers_.push_back(row[1]);
              });
    for (const std::string& name : names)
        static_cast<void>(run("DROP TRIGGER " + sql_identifier(name)));
}

void SpatialIndex::add(std::int64_t id, const Feature& feature) {
    double low_x = std::numeric_limits<double>::infinity();
    double low_y = low_x;
    double high_x = -low_x;
    double high_y = -low_x;
    const auto cover = [&](const Position& p) {
        low_x = std::min(low_x, p.x);
        high_x = std::max(high_x, p.x);
        low_y = std::min(low_y, p.y);
        high_y = std::max(high_y, p.y);
    };
    for (const WorldPolygon& part : feature.parts)
        std::ranges::for_each(part.exterior, cover);
    if (feature.place)
        cover(*feature.place);
    boxes_.push_back({id, round_down(low_x), round_up(high_x), round_down(low_y), round_up(high_y)});
}

void SpatialIndex::fill(const PackedRtree& tree) const {
    const auto rows = [&](const char* verb, const char* table) {
        return RowInserts(handle_, *target_, verb + sql_identifier(name_ + table));
    };
    RowInserts entries = rows("INSERT INTO ", "_rowid");
    for (const PackedRtree::Entry& entry : tree.entries)
        entries.add(entry.id, entry.leaf);
    RowInserts nodes = rows("INSERT OR REPLACE INTO ", "_node");
    for (const PackedRtree::Node& node : tree.nodes)
        nodes.add(node.number, node.bytes);
    RowInserts parents = rows("INSERT INTO ", "_parent");
    for (const PackedRtree::Node& node : tree.nodes)
        if (node.parent != 0)
            parents.add(node.number, node.parent);
}

void SpatialIndex::finish() {
    // Skip if another writer has filled it already.
    bool empty = true;
    sql_query(dataset_, "SELECT 1 FROM " + sql_identifier(name_ + "_rowid") + " LIMIT 1",
              [&](const auto&) { empty = false; });
    if (empty && !boxes_.empty())
        fill(pack_rtree(std::move(boxes_), node_bytes_));
    for (const std::string& sql : triggers_) {
        OgrCall call(*target_);
        call.check(run(sql), "keeping the spatial index up to date");
    }
}

}  // namespace d2b::writing
