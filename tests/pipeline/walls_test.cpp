#include <cmath>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "geometry/geos.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

using test::buildings;
using test::cells;
using test::contours;
using test::MemorySource;
using test::Result;
using test::run_on;

/// A turned house of 50 x 24 cells with a round tower that stands on it.
std::vector<double> turned_house() {
    std::vector<double> z;
    for (int row = 0; row < 80; ++row)
        for (int col = 0; col < 80; ++col) {
            const double u = (col - 40.0) * std::cos(0.4) + (row - 40.0) * std::sin(0.4);
            const double v = (row - 40.0) * std::cos(0.4) - (col - 40.0) * std::sin(0.4);
            const bool house = std::abs(u) <= 25 && std::abs(v) <= 12;
            z.push_back(house ? (std::hypot(col - 42.0, row - 40.0) < 9 ? 30 : 20) : 5);
        }
    return z;
}

TEST(Pipeline, WallsAreDrawnFromEndToEnd) {
    MemorySource source(80, 80, turned_house());
    source.edit().transform = {1000, 0.5, 0, 2000, 0, -0.5};
    Options options = cells({10, 25});
    options.outline.walls = Walls::automatic;
    options.outline.arcs = true;
    Result result;
    run_on(source, options, result);
    ASSERT_EQ(result.sink.features[buildings].size(), 1U);
    const WorldPolygon& house = result.sink.features[buildings][0].parts[0];
    EXPECT_EQ(house.exterior.size(), 4U);
    EXPECT_EQ(result.sink.value(buildings, 0, "status"), FieldValue{std::string("regularized")});
    // 51 x 25 cells of 0.5 m: the outermost centres are 25 and 12 off the middle.
    EXPECT_NEAR(result.sink.number(buildings, 0, "area_m2"), 50 * 24 * 0.25, 0.03 * 50 * 24 * 0.25);
    const WorldPolygon& tower = result.sink.features[contours][2].parts[0];
    EXPECT_EQ(tower.arcs.size(), 2U);  // a whole circle
    Geos geos;
    EXPECT_EQ(geos.area_outside(tower, result.sink.features[contours][1].parts[0]), 0);
    EXPECT_EQ(result.report.counted(Reason::polygon_repaired), 0);
}

TEST(Pipeline, ArcsAreLeftOutWhereTheyAreNotAskedForOrBend) {
    MemorySource source(80, 80, turned_house());
    source.edit().transform = {1000, 0.5, 0, 2000, 0, -0.5};
    Options options = cells({10, 25});
    options.outline.walls = Walls::automatic;
    Result result;
    run_on(source, options, result);
    EXPECT_TRUE(result.sink.features[contours][2].parts[0].arcs.empty());
    options.outline.arcs = true;
    options.outline.target_crs = "EPSG:4326";
    Result moved;
    EXPECT_THROW(run_on(source, options, moved), OptionError);
}

}  // namespace
}  // namespace d2b
