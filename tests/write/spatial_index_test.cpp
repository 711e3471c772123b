#include "write/geopackage/spatial_index.hpp"

#include <cmath>
#include <map>
#include <random>

#include "dem2buildings/open_sinks.hpp"
#include "write/write_fixture.hpp"

namespace d2b::writing {
namespace {

using namespace test;

std::uint64_t number_at(const std::vector<std::byte>& bytes, std::size_t at, int length) {
    std::uint64_t value = 0;
    for (int i = 0; i < length; ++i)
        value = value << 8U | std::to_integer<std::uint64_t>(bytes[at + static_cast<std::size_t>(i)]);
    return value;
}

/// n boxes of one unit in a row.
std::vector<IndexedBox> row_of(int n) {
    std::vector<IndexedBox> boxes;
    for (int i = 0; i < n; ++i)
        boxes.push_back({i + 1, static_cast<float>(i), static_cast<float>(i) + 1, 0, 1});
    return boxes;
}

TEST(PackedRtree, FewBoxesAreTheRoot) {
    const PackedRtree tree = pack_rtree({{7, 1.5F, 2, -1, 3}}, 4 + 51 * 24);
    ASSERT_EQ(tree.nodes.size(), 1U);
    EXPECT_EQ(tree.nodes[0].number, 1);
    EXPECT_EQ(tree.nodes[0].parent, 0);
    const auto& bytes = tree.nodes[0].bytes;
    ASSERT_EQ(bytes.size(), 1228U);
    EXPECT_EQ(number_at(bytes, 0, 2), 0U);  // the root is a leaf
    EXPECT_EQ(number_at(bytes, 2, 2), 1U);
    EXPECT_EQ(number_at(bytes, 4, 8), 7U);
    EXPECT_EQ(number_at(bytes, 12, 4), 0x3FC00000U);  // 1.5 in IEEE 754
    EXPECT_EQ(number_at(bytes, 16, 4), 0x40000000U);
    EXPECT_EQ(number_at(bytes, 20, 4), 0xBF800000U);
    EXPECT_EQ(number_at(bytes, 24, 4), 0x40400000U);
    ASSERT_EQ(tree.entries.size(), 1U);
    EXPECT_EQ(tree.entries[0].leaf, 1);
}

TEST(PackedRtree, ManyBoxesMakeALevelAboveTheLeaves) {
    const PackedRtree tree = pack_rtree(row_of(10), 4 + 4 * 24);
    // Ten boxes need three leaves of up to four.
    ASSERT_EQ(tree.nodes.size(), 4U);
    std::map<std::int64_t, std::size_t> cells;
    for (const PackedRtree::Node& node : tree.nodes) {
        EXPECT_EQ(node.parent, node.number == 1 ? 0 : 1);
        EXPECT_EQ(number_at(node.bytes, 0, 2), node.number == 1 ? 1U : 0U);
        cells[node.number] = number_at(node.bytes, 2, 2);
    }
    EXPECT_EQ(cells[1], 3U);
    EXPECT_EQ(cells[2] + cells[3] + cells[4], 10U);
    for (std::size_t i = 0; i < tree.entries.size(); ++i)
        EXPECT_EQ(tree.entries[i].id, static_cast<std::int64_t>(i) + 1);
}

class SpatialIndexTest : public WriteTest {
  protected:
    /// Squares anywhere, far from zero, where single precision has to be rounded outwards.
    void write_squares(const std::string& name, int n, const WriteOptions& options) {
        std::mt19937 random(5);
        const auto sink = open_sink(options, callbacks_);
        const LayerSpec spec = layer_spec("buildings");
        sink->begin({&spec, 1}, provenance());
        for (int i = 0; i < n; ++i) {
            Feature feature = square(i + 1);
            const double x = 500000.1 + static_cast<double>(random() % 100000) / 7;
            const double y = 5800000.3 + static_cast<double>(random() % 100000) / 7;
            for (Position& p : feature.parts[0].exterior)
                p = {p.x - (i + 1) + x, p.y + y};
            sink->add(0, feature);
        }
        sink->finish();
        EXPECT_EQ(count(path(name), "buildings"), n);
    }
    void expect_sound(const std::string& name, int n) const {
        EXPECT_EQ(sql(path(name), "SELECT rtreecheck('rtree_buildings_geom')"), "ok");
        EXPECT_EQ(sql(path(name), "SELECT COUNT(*) FROM rtree_buildings_geom"), std::to_string(n));
        // Boxes hold their features, and no more than a step of single precision besides.
        EXPECT_EQ(sql(path(name),
                      "SELECT COUNT(*) FROM buildings b JOIN rtree_buildings_geom r ON b.fid = r.id WHERE "
                      "r.minx <= ST_MinX(geom) AND r.maxx >= ST_MaxX(geom) AND r.miny <= ST_MinY(geom) AND "
                      "r.maxy >= ST_MaxY(geom) AND r.maxy - r.miny < ST_MaxY(geom) - ST_MinY(geom) + 1"),
                  std::to_string(n));
        EXPECT_EQ(sql(path(name), "PRAGMA integrity_check"), "ok");
    }
};

TEST_F(SpatialIndexTest, HoldsEveryFeature) {
    for (const int n : {0, 1, 51, 52, 5000}) {
        const std::string name = std::to_string(n) + ".gpkg";
        write_squares(name, n, to(name));
        expect_sound(name, n);
    }
}

TEST_F(SpatialIndexTest, IsPacked) {
    write_squares("a.gpkg", 5000, to("a.gpkg"));
    // 5,000 boxes fill 99 leaves of 51, and these three nodes of the next level or two.
    EXPECT_LE(std::stoi(sql(path("a.gpkg"), "SELECT COUNT(*) FROM rtree_buildings_geom_node")), 110);
}

TEST_F(SpatialIndexTest, GrowsWithLaterChanges) {
    write_squares("a.gpkg", 300, to("a.gpkg"));
    WriteOptions more = to("a.gpkg");
    more.append = true;
    write(more, 5);
    sql(path("a.gpkg"), "DELETE FROM buildings WHERE fid <= 100", true);
    expect_sound("a.gpkg", 205);
}

TEST_F(SpatialIndexTest, OfAReplacedLayerIsNew) {
    write_squares("a.gpkg", 300, to("a.gpkg"));
    WriteOptions over = to("a.gpkg");
    over.overwrite = true;
    write_squares("a.gpkg", 200, over);
    expect_sound("a.gpkg", 200);
}

TEST_F(SpatialIndexTest, IsLeftOutOnRequest) {
    WriteOptions without = to("a.gpkg");
    without.layer_options = {"SPATIAL_INDEX=NO"};
    write_squares("a.gpkg", 10, without);
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT COUNT(*) FROM sqlite_master WHERE name LIKE 'rtree%'"), "0");
}

TEST_F(SpatialIndexTest, TakesAnyNameOfALayer) {
    WriteOptions options = to("a.gpkg");
    options.layer_name = "it's \"so\"";
    const auto sink = open_sink(options, callbacks_);
    const LayerSpec spec = layer_spec(options.layer_name);
    sink->begin({&spec, 1}, provenance());
    sink->add(0, square(1));
    sink->finish();
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT COUNT(*) FROM \"rtree_it's \"\"so\"\"_geom\""), "1");
}

}  // namespace
}  // namespace d2b::writing
