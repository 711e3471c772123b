#include <algorithm>
#include <cmath>
#include <limits>
#include <pthread.h>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "geometry/geos.hpp"
#include "options/option_table.hpp"
#include "pipeline/pipeline_case.hpp"
#include "support/random_grid.hpp"

namespace d2b::test {
namespace {

TEST(Pipeline, ABlockInPlainUnits) {
    MemorySource source = block();
    const Result result(source, cells({10}));
    EXPECT_TRUE(result.sink.finished);
    ASSERT_EQ(result.sink.features[buildings].size(), 1U);
    ASSERT_EQ(result.sink.features[contours].size(), 2U);
    EXPECT_EQ(result.sink.layers[buildings].name, "buildings");
    EXPECT_EQ(result.sink.layers[contours].name, "contours");
    EXPECT_EQ(result.sink.number(buildings, 0, "area_m2"), 24);
    EXPECT_EQ(result.sink.number(buildings, 0, "perim_m"), 20);
    EXPECT_EQ(result.sink.number(buildings, 0, "height"), 15);
    EXPECT_EQ(result.sink.number(contours, 0, "area_m2"), 120);
    EXPECT_EQ(result.sink.features[buildings][0].parts[0].exterior,
              (WorldRing{{2, -3}, {2, -7}, {8, -7}, {8, -3}}));
    EXPECT_EQ(result.report.vertices, 8);
    EXPECT_EQ(result.report.levels.size(), 2U);
    EXPECT_EQ(result.report.levels[1].points, 24);
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST(Pipeline, GeodesicAreasOnAProjectedGrid) {
    // Lengths on the central meridian of UTM are 0.9996 of the true ones.
    MemorySource source = block();
    source.edit().transform = {500000, 1, 0, 5000000, 0, -1};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    const Result result(source, cells({10}));
    EXPECT_NEAR(result.sink.number(buildings, 0, "area_m2"), 24 / (0.9996 * 0.9996), 0.005);  // in hundredths
    EXPECT_NEAR(result.sink.number(buildings, 0, "perim_m"), 20 / 0.9996, 0.005);
    EXPECT_EQ(result.report.units.areas, "geodesic");
}

TEST(Pipeline, MinAreaIsInSquareMetresOnAGridOfFeet) {
    // 24 cells of 10 ft: 24 * 9.290304 m2 = 222.967 m2, a little more on the ellipsoid.
    const auto count = [](double min_area) {
        MemorySource source = block();
        source.edit().transform = {13000000, 10, 0, 280000, 0, -10};
        source.edit().crs_wkt = Crs("EPSG:2253").wkt();
        Options options = cells({10});
        options.filter.min_area_m2 = min_area;
        const Result result(source, options);
        return result.sink.features[buildings].size();
    };
    EXPECT_EQ(count(222.5), 1U);
    EXPECT_EQ(count(223.5), 0U);
}

TEST(Pipeline, HeightsAreMetresElevationsStay) {
    MemorySource source = block();
    source.edit().band_unit = "ft";
    const Result result(source, cells({10}));
    EXPECT_EQ(result.sink.number(buildings, 0, "roof"), 20);
    EXPECT_EQ(result.sink.number(buildings, 0, "ground"), 5);
    EXPECT_NEAR(result.sink.number(buildings, 0, "height"), 15 * 0.3048, 0.005);
    EXPECT_EQ(result.sink.number(contours, 1, "threshold"), 10);
    EXPECT_EQ(result.sink.layers[contours].fields[4].unit, "foot");
}

TEST(Pipeline, CountsWhatIsWritten) {
    MemorySource source = block();
    Options options = cells({10});
    options.write.layers = Layers::buildings;
    const Result result(source, options);
    EXPECT_EQ(result.report.contours, 0);
    EXPECT_EQ(result.report.buildings, 1);
    EXPECT_EQ(result.report.vertices, 4);
}

TEST(Pipeline, ManyLevelsNeedSixteenBits) {
    std::vector<double> z(900, 0.0);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = static_cast<double>(i);
    MemorySource source(30, 30, z);
    std::vector<double> thresholds;
    for (int t = 0; t < 890; ++t)
        thresholds.push_back(t + 0.5);
    const Result result(source, cells(thresholds));
    EXPECT_EQ(result.report.levels.size(), 891U);
    EXPECT_EQ(result.report.levels[890].points, 10);  // 890 to 899
}

/// Prevents threads from starting as long as it lives: there is no room for their stacks.
class NoRoomForThreads {
  public:
    NoRoomForThreads() {
        pthread_attr_init(&attributes_);
        pthread_getattr_default_np(&attributes_);
        pthread_attr_getstacksize(&attributes_, &before_);
        set(std::size_t{1} << 46);
    }
    NoRoomForThreads(const NoRoomForThreads&) = delete;
    NoRoomForThreads& operator=(const NoRoomForThreads&) = delete;
    ~NoRoomForThreads() {
        set(before_);
        pthread_attr_destroy(&attributes_);
    }

  private:
    void set(std::size_t bytes) {
        pthread_attr_setstacksize(&attributes_, bytes);
        pthread_setattr_default_np(&attributes_);
    }
    pthread_attr_t attributes_{};
    std::size_t before_ = 0;
};

TEST(Pipeline, ThreadsThatCannotBeStartedAreDoneWithout) {
    const NoRoomForThreads no_room;
    MemorySource source = block();
    Options options = cells({10});
    options.run.threads = 16;
    const Result result(source, options);
    EXPECT_EQ(result.sink.features[buildings].size(), 1U);
    EXPECT_EQ(result.report.threads, 1);
    EXPECT_EQ(result.report.warnings,
              std::vector<std::string>{"Only 1 of 16 threads are running, because the system allows no more; "
                                       "the result is the same, but takes longer."});
}

TEST(Pipeline, AReportTellsOfItsOwnRun) {
    for (const Preset preset : every_preset) {
        Options options;
        options.preset = preset;
        options.levels.interval = 0.1;
        options.filter.noise_factor = 1000;
        MemorySource source = block();
        std::vector<std::string> heard;
        Callbacks callbacks;
        callbacks.on_warning = [&](const std::string& text) { heard.push_back(text); };
        const auto run_again = [&] {
            MemorySink sink;
            heard.clear();
            return run(options, {source}, {sink}, callbacks);
        };
        const RunReport first = run_again();
        ASSERT_FALSE(first.warnings.empty());
        EXPECT_EQ(heard, first.warnings);
        const RunReport second = run_again();
        EXPECT_EQ(heard, second.warnings);
        EXPECT_EQ(second.warnings, first.warnings);
        EXPECT_EQ(second.dropped, first.dropped);
        EXPECT_EQ(second.contours, first.contours);
        EXPECT_EQ(second.buildings, first.buildings);
        EXPECT_EQ(second.vertices, first.vertices);
        EXPECT_EQ(second.valid_points, first.valid_points);
        EXPECT_EQ(second.levels.size(), first.levels.size());
    }
}

TEST(Pipeline, ReadsOnceWhatFitsInMemory) {
    // One value along the border might be undeclared NoData, which is looked for in a reading of its own.
    std::vector<double> z(120);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = 5 + 0.01 * static_cast<double>(i);
    MemorySource source{10, 12, z};
    const Result result(source, cells({10}));
    EXPECT_EQ(source.reads, 1);
}

TEST(Pipeline, DisjointBandsAddUpToTheWhole) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const RandomGridCase c = random_grid(2 * seed, 20, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        Options options = cells(c.thresholds);
        options.outline.disjoint = true;
        options.outline.simplify = seed % 3 == 0 ? 1.0 : 0.0;
        Result stacked;
        const Result disjoint(source, options);
        options.outline.disjoint = false;
        run_on(source, options, stacked);
        double roots = 0;
        for (std::size_t i = 0; i < stacked.sink.features[contours].size(); ++i)
            if (std::get<std::int64_t>(stacked.sink.value(contours, i, "level")) == 0)
                roots += area_of(stacked.sink.features[contours][i].parts);
        double bands = 0;
        for (const Feature& feature : disjoint.sink.features[contours])
            bands += area_of(feature.parts);
        EXPECT_NEAR(bands, roots, 1e-9) << seed;
        EXPECT_EQ(disjoint.report.counted(Reason::polygon_repaired), 0);
    }
}

TEST(Pipeline, ReprojectedOutlinesStayNested) {
    Geos geos;
    std::size_t checked_pairs = 0;
    for (unsigned seed = 10; seed < 30; ++seed) {
        const RandomGridCase c = random_grid(2 * seed, 24, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        place_in_utm(source, 10);
        Options options = cells(c.thresholds);
        options.outline.target_crs = "EPSG:3857";
        const Result result(source, options);
        const auto& features = result.sink.features[contours];
        // A cell is 10 m x 10 m, at 52 N about 264 m2 of EPSG:3857.
        for (std::size_t i = 0; i < features.size(); ++i) {
            const FieldValue parent = result.sink.value(contours, i, "parent_id");
            if (!std::holds_alternative<std::int64_t>(parent))
                continue;
            const auto& outer = features[static_cast<std::size_t>(std::get<std::int64_t>(parent) - 1)];
            EXPECT_LT(geos.area_outside(features[i].parts[0], outer.parts[0]), 264e-6);
            ++checked_pairs;
        }
        EXPECT_EQ(result.report.output_crs, "WGS 84 / Pseudo-Mercator");
        EXPECT_EQ(result.report.crs, "ETRS89 / UTM zone 32N");
    }
    EXPECT_GT(checked_pairs, 200U);
}

/// Straight lines bend when they are reprojected: long ones by more than a cell.
TEST(Pipeline, LongOutlinesStayNestedWhenTheyAreReprojected) {
    constexpr int cols = 20000;
    constexpr int rows = 40;
    std::vector<double> z(static_cast<std::size_t>(rows) * cols, 0.0);
    for (int row = 1; row < rows - 1; ++row)
        for (int col = 1; col < cols - 1; ++col)
            z[static_cast<std::size_t>(row) * cols + static_cast<std::size_t>(col)] =
                row > 1 && row < rows - 2 && col % 1000 > 10 ? 20 : 10;
    MemorySource source(rows, cols, z);
    source.edit().transform = {600000, 1, 0, 5800000, 0, -1};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Options options = cells({5, 15});
    options.outline.target_crs = "EPSG:3857";
    const Result result(source, options);
    const auto& features = result.sink.features[contours];
    ASSERT_EQ(features.size(), 22U);
    Geos geos;
    for (std::size_t i = 1; i < features.size(); ++i) {
        const auto parent = std::get<std::int64_t>(result.sink.value(contours, i, "parent_id")) - 1;
        EXPECT_LT(
            geos.area_outside(features[i].parts[0], features[static_cast<std::size_t>(parent)].parts[0]),
            2.6e-6);
    }
    options.outline.disjoint = true;
    const Result disjoint(source, options);
    EXPECT_EQ(disjoint.report.counted(Reason::polygon_repaired), 0);
}

TEST(Pipeline, DisjointContoursReferToWhatIsWritten) {
    MemorySource source = block();  // level 1 and 2 cover the same cells: level 1 has no band of its own
    Options options = cells({10, 15});
    options.outline.disjoint = true;
    const Result result(source, options);
    ASSERT_EQ(result.sink.features[contours].size(), 2U);
    EXPECT_EQ(result.sink.value(contours, 1, "level"), FieldValue{std::int64_t{2}});
    EXPECT_EQ(result.sink.value(contours, 1, "id"), FieldValue{std::int64_t{3}});
    EXPECT_EQ(result.sink.value(contours, 1, "parent_id"), FieldValue{std::int64_t{1}});
    EXPECT_EQ(result.report.contours, 2);
    EXPECT_EQ(result.report.buildings, 1);
}

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
    const Result result(source, options);
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
    const Result result(source, options);
    EXPECT_TRUE(result.sink.features[contours][2].parts[0].arcs.empty());
    options.outline.arcs = true;
    options.outline.target_crs = "EPSG:4326";
    Result moved;
    EXPECT_THROW(run_on(source, options, moved), OptionError);
}

TEST(Pipeline, ALargeToleranceIsWarnedOf) {
    MemorySource source = block();
    source.edit().transform = {13, 1e-5, 0, 52, 0, -1e-5};
    source.edit().crs_wkt = Crs("EPSG:4326").wkt();
    Options options = cells({10});
    options.outline.simplify = 1;
    const Result result(source, options);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(
        result.report.warnings[0],
        "-simplify 1 is 100000 cells wide, which leaves little of a building; it is in units of the input's "
        "CRS.");
}

TEST(Pipeline, WhatGeosRefusesIsWarnedOfByItsId) {
    MemorySource source = block();
    source.edit().transform = {600000, 1e-13, 0, 5800000, 0, -1e-13};  // all positions are one double
    source.edit().crs_wkt = "";
    const Result result(source, cells({10}));
    const std::vector<std::string>& warnings = result.report.warnings;
    for (const char* feature : {"Building 1 ", "Contour 2 "}) {
        const auto is_of = [&](const std::string& text) {
            return text.starts_with(feature + std::string("would not have been a valid polygon (")) &&
                   text.ends_with("); it is not written.");
        };
        EXPECT_EQ(std::ranges::count_if(warnings, is_of), 1) << feature << warnings.front();
    }
    EXPECT_EQ(result.report.buildings, 0);
    EXPECT_GE(result.report.counted(Reason::polygon_lost), 2);
}

}  // namespace
}  // namespace d2b::test
