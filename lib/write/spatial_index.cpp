#include "write/spatial_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "write/row_inserts.hpp"
#include "write/sql.hpp"
#include "write/sqlite_handle.hpp"

namespace d2b {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float below(double value) {
    const auto near = static_cast<float>(value);
    return static_cast<double>(near) > value ? std::nextafter(near, -infinity) : near;
}

float above(double value) {
    const auto near = static_cast<float>(value);
    return static_cast<double>(near) < value ? std::nextafter(near, infinity) : near;
}

}  // namespace

bool SpatialIndex::run(const std::string& sql) const {
    return sql_done(dataset_, sql);
}

std::optional<SpatialIndex> SpatialIndex::begin(GDALDatasetH dataset, OGRLayerH layer,
                                                const WriteTarget& target) {
    const GdalMessages quiet;
    const std::string table = OGR_L_GetName(layer);
    const std::string column = OGR_L_GetGeometryColumn(layer);
    SpatialIndex index(dataset, target);
    index.name_ = "rtree_" + table + "_" + column;
    const std::string nodes = sql_name(index.name_ + "_node");
    const auto look_at_root = [&] {
        sql_query(dataset, "SELECT length(data) FROM " + nodes + " WHERE nodeno = 1",
                  [&](const auto& row) { index.node_bytes_ = std::stoul(row[0]); });
        return index.node_bytes_ > 0;
    };
    // GDAL creates deferred indices before it runs SQL; otherwise create it explicitly.
    if (!look_at_root() &&
        !(index.run("SELECT CreateSpatialIndex(" + sql_text(table) + ", " + sql_text(column) + ")") &&
          look_at_root()))
        return std::nullopt;
    // SQLite may protect its shadow tables against writing.
    if (!index.run("UPDATE " + nodes + " SET data = data WHERE nodeno = 1"))
        return std::nullopt;
    index.rest_triggers(table);
    return index;
}

void SpatialIndex::rest_triggers(const std::string& table) {
    std::vector<std::string> names;
    sql_query(dataset_,
              "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND tbl_name = " + sql_text(table) +
                  " ORDER BY rowid",
              [&](const auto& row) {
                  if (!row[0].starts_with(name_))
                      return;
                  names.push_back(row[0]);
                  triggers_.push_back(row[1]);
              });
    for (const std::string& name : names)
        static_cast<void>(run("DROP TRIGGER " + sql_name(name)));
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
    boxes_.push_back({id, below(low_x), above(high_x), below(low_y), above(high_y)});
}

void SpatialIndex::fill(const PackedRtree& tree) const {
    sqlite3* const handle = sqlite_handle(dataset_);
    const auto rows = [&](const char* verb, const char* table) {
        return RowInserts(dataset_, handle, *target_, verb + sql_name(name_ + table) + " VALUES",
                          "filling the spatial index");
    };
    RowInserts entries = rows("INSERT INTO ", "_rowid");
    for (const PackedRtree::Entry& entry : tree.entries)
        entries.add({entry.id, entry.leaf});
    entries.finish();
    RowInserts nodes = rows("INSERT OR REPLACE INTO ", "_node");
    for (const PackedRtree::Node& node : tree.nodes)
        nodes.add({node.number, std::span(node.bytes)});
    nodes.finish();
    RowInserts parents = rows("INSERT INTO ", "_parent");
    for (const PackedRtree::Node& node : tree.nodes)
        if (node.parent != 0)
            parents.add({node.number, node.parent});
    parents.finish();
}

void SpatialIndex::finish() {
    // Skip if another writer has filled it already.
    bool empty = true;
    sql_query(dataset_, "SELECT 1 FROM " + sql_name(name_ + "_rowid") + " LIMIT 1",
              [&](const auto&) { empty = false; });
    if (empty && !boxes_.empty())
        fill(pack_rtree(std::move(boxes_), node_bytes_));
    for (const std::string& sql : triggers_) {
        OgrCall call(*target_);
        call.check(run(sql), "keeping the spatial index up to date");
    }
}

}  // namespace d2b
