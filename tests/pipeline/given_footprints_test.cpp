#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/footprint_source.hpp"
#include "pipeline/made_town.hpp"
#include "pipeline/pipeline_case.hpp"
#include "pipeline/random_town.hpp"
#include "pipeline/run.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b::test {
namespace {

constexpr std::size_t missing = 2;

class MadeFootprints final : public FootprintSource {
  public:
    std::vector<std::vector<WorldPolygon>> footprints;
    std::string crs;

    [[nodiscard]] std::string crs_wkt() const override { return crs; }
    void for_each(const std::function<void(GivenFootprint&&)>& use) override {
        std::int64_t fid = 100;
        for (const std::vector<WorldPolygon>& polygons : footprints)
            use({fid++, polygons, {}, {}});
    }
};

/// 80 x 120 cells of 1 m. Heights above the ground, exact: a hall, a house of two heights, one that nobody
/// has mapped, and one of which half has no data.
struct FootprintScene {
    static constexpr Box hall{10, 10, 10, 20};
    static constexpr Box high{10, 50, 10, 5};
    static constexpr Box low{10, 55, 10, 5};
    static constexpr Box unmapped{40, 10, 20, 20};
    static constexpr Box half{40, 60, 10, 10};

    [[nodiscard]] static MemorySource source() {
        std::vector<double> z(std::size_t{80} * 120, 0);
        const auto fill = [&](const Box& box, double height) {
            for (int r = box.row; r < box.row + box.rows; ++r)
                for (int c = box.col; c < box.col + box.cols; ++c)
                    z[static_cast<std::size_t>(r) * 120 + static_cast<std::size_t>(c)] = height;
        };
        fill(hall, 7);
        fill(high, 12);
        fill(low, 6);
        fill(unmapped, 9);
        fill(half, 5);
        fill({40, 60, 10, 5}, std::numeric_limits<double>::quiet_NaN());
        return {80, 120, std::move(z)};
    }
};

/// Ring through columns and rows, on the map.
WorldRing ring(const std::vector<std::pair<double, double>>& corners) {
    WorldRing positions;
    for (const auto& [col, row] : corners)
        positions.push_back({600000 + col, 5800000 - row});
    return positions;
}
WorldPolygon rectangle(double col, double row, double cols, double rows) {
    return {ring({{col, row}, {col, row + rows}, {col + cols, row + rows}, {col + cols, row}}), {}};
}
WorldPolygon around(const Box& box) {
    return rectangle(box.col, box.row, box.cols, box.rows);
}

enum Given : std::size_t {
    the_hall,
    two_parts,
    with_hole,
    outside,
    crossing,
    tiny,
    nothing,
    half_known,
    shifted,
    bare
};

std::vector<std::vector<WorldPolygon>> footprints() {
    WorldPolygon holed = rectangle(50, 10, 10, 10);
    holed.interiors = {ring({{52, 12}, {56, 12}, {56, 16}, {52, 16}})};
    return {{around(FootprintScene::hall)},
            {rectangle(10, 10, 10, 10), around(FootprintScene::high)},
            {holed},
            {rectangle(500, 500, 10, 10)},
            {{ring({{10, 10}, {30, 20}, {30, 10}, {10, 20}}), {}}},
            {rectangle(70.6, 70.6, 0.3, 0.3)},
            {},
            {around(FootprintScene::half)},
            {rectangle(13, 10, 20, 10)},
            {rectangle(90, 60, 10, 10)}};
}

struct FootprintRun {
    explicit FootprintRun(std::vector<std::vector<WorldPolygon>> given = footprints()) {
        source.footprints = std::move(given);
        place_in_utm(dem, 1);
        options.ground.mode = GroundMode::none;
        options.write.footprints = "given";
        options.run.threads = 2;
    }
    void run(const detect::UnitSize& units = {}) {
        result.report = pipeline::run_in_units(options, {dem, nullptr, nullptr, nullptr, nullptr, &source},
                                               {result.sink}, {}, units);
    }
    [[nodiscard]] double number(std::size_t footprint, const std::string& field) const {
        return result.sink.number(buildings, footprint, field);
    }
    [[nodiscard]] std::int64_t whole(std::size_t footprint, const std::string& field) const {
        return result.sink.whole(buildings, footprint, field);
    }
    [[nodiscard]] bool is_null(std::size_t footprint, const std::string& field) const {
        return std::holds_alternative<std::monostate>(result.sink.value(buildings, footprint, field));
    }

    MemorySource dem = FootprintScene::source();
    MadeFootprints source;
    Options options;
    Result result;
};

struct Measured : FootprintRun {
    explicit Measured(std::vector<std::vector<WorldPolygon>> given = footprints(),
                      const detect::UnitSize& units = {})
        : FootprintRun(std::move(given)) {
        run(units);
    }
};

/// The values are worked out by hand.
TEST(GivenFootprints, haveTheHeightsOfTheirCells) {
    const Measured run;
    EXPECT_EQ(run.whole(the_hall, "n_cells"), 200);
    for (const char* field : {"height", "p50", "p70", "p90", "p95"})
        EXPECT_EQ(run.number(the_hall, field), 7) << field;
    EXPECT_EQ(run.number(the_hall, "ground"), 0);
    EXPECT_EQ(run.number(the_hall, "roof"), 7);
    EXPECT_EQ(run.whole(the_hall, "num_floors"), 2);
    EXPECT_NEAR(run.number(the_hall, "area_m2"), 200, 0.2);  // on the ellipsoid
    EXPECT_NEAR(run.number(the_hall, "volume_m3"), 1400, 1.4);
    EXPECT_NEAR(run.number(the_hall, "perim_m"), 60, 0.06);
    EXPECT_EQ(run.number(the_hall, "nodata"), 0);
    EXPECT_EQ(run.number(the_hall, "seen"), 1);
    EXPECT_EQ(run.number(the_hall, "tree"), 0);
    EXPECT_EQ(run.number(the_hall, "shift_m"), 0);
    EXPECT_EQ(run.whole(the_hall, "at_edge"), 0);
    EXPECT_EQ(run.whole(the_hall, "n_levels"), 1);
    EXPECT_EQ(run.whole(the_hall, "n_parts"), 1);
    EXPECT_EQ(std::get<std::string>(run.result.sink.value(buildings, the_hall, "status")), "given");
}

/// 100 cells of 7 m and 50 of 12 m; those of the hall count for both.
TEST(GivenFootprints, mayOverlapAndHaveParts) {
    const Measured run;
    EXPECT_EQ(run.whole(two_parts, "n_cells"), 150);
    EXPECT_EQ(run.number(two_parts, "p50"), 7);
    EXPECT_EQ(run.number(two_parts, "p70"), 12);
    EXPECT_NEAR(run.number(two_parts, "volume_m3"), 100 * 7 + 50 * 12, 1.3);
    EXPECT_EQ(run.whole(two_parts, "has_parts"), 1);
    EXPECT_EQ(run.number(the_hall, "p50"), 7);
}

/// Without the hole 38 cells of 12 m and 46 of 6 m are left.
TEST(GivenFootprints, mayHaveHoles) {
    const Measured run;
    EXPECT_EQ(run.whole(with_hole, "n_cells"), 84);
    EXPECT_EQ(run.number(with_hole, "p50"), 6);
    EXPECT_EQ(run.number(with_hole, "p70"), 12);
    EXPECT_NEAR(run.number(with_hole, "area_m2"), 84, 0.1);
    EXPECT_NEAR(run.number(with_hole, "volume_m3"), 38 * 12 + 46 * 6, 1);
    EXPECT_EQ(run.whole(with_hole, "n_levels"), 2);
}

TEST(GivenFootprints, comeBackOnceEachAlsoWithoutHeights) {
    const Measured run;
    ASSERT_EQ(run.result.sink.features[buildings].size(), footprints().size());
    for (std::size_t i = 0; i < footprints().size(); ++i) {
        EXPECT_EQ(run.whole(i, "id"), static_cast<std::int64_t>(i) + 1);
        EXPECT_EQ(run.result.sink.features[buildings][i].parts.size(), footprints()[i].size());
    }
    for (const Given footprint : {outside, tiny, nothing})
        for (const char* field : {"p50", "height", "min_height", "ground", "seen", "n_points", "num_floors"})
            EXPECT_TRUE(run.is_null(footprint, field)) << footprint << field;
    EXPECT_NEAR(run.number(outside, "area_m2"), 100, 0.1);
    const FootprintReport& report = *run.result.report.footprints;
    EXPECT_EQ(report.given, 10);
    EXPECT_EQ(report.measured, 7);
    EXPECT_EQ(report.outside, 1);
    EXPECT_EQ(report.without_cell, 1);
    EXPECT_EQ(report.without_polygon, 1);
    EXPECT_EQ(report.without_data, 0);
    EXPECT_EQ(report.invalid, 1);
    EXPECT_EQ(report.flat, 1);
    EXPECT_EQ(report.missing, 1);
    // The contours of what is missing are not written, and not counted.
    std::int64_t written = 0;
    for (const LevelReport& level : run.result.report.levels)
        written += level.contours;
    EXPECT_GT(written, 0);
    EXPECT_EQ(written, run.result.report.contours);
}

/// Its lines cross in the middle of the hall; the repaired copy has two triangles of 50 m2.
TEST(GivenFootprints, thatAreInvalidAreMeasuredOnARepairedCopy) {
    const Measured run;
    EXPECT_NEAR(run.number(crossing, "area_m2"), 100, 0.1);
    EXPECT_EQ(run.number(crossing, "p50"), 7);
    EXPECT_EQ(run.result.sink.features[buildings][crossing].parts[0].exterior,
              footprints()[crossing][0].exterior);
    ASSERT_FALSE(run.result.report.warnings.empty());
    EXPECT_EQ(
        run.result.report.warnings.front().find(
            "1 footprint is not valid, written as given and measured on a repaired copy: feature 104 (Self-"),
        0U)
        << run.result.report.warnings.front();
}

TEST(GivenFootprints, knowTheirShareWithoutData) {
    const Measured run;
    EXPECT_EQ(run.whole(half_known, "n_points"), 50);
    EXPECT_EQ(run.number(half_known, "nodata"), 0.5);
    EXPECT_EQ(run.number(half_known, "p50"), 5);
    EXPECT_EQ(run.number(half_known, "seen"), 0.5);
}

/// Three of its 20 columns lie beside the hall.
TEST(GivenFootprints, knowHowFarTheyMustMove) {
    const Measured run;
    EXPECT_EQ(run.number(shifted, "seen"), 0.85);
    EXPECT_NEAR(run.number(shifted, "shift_m"), 3, 0.003);
    EXPECT_EQ(run.number(bare, "seen"), 0);
    EXPECT_EQ(run.number(bare, "p50"), 0);
    EXPECT_TRUE(run.is_null(bare, "shift_m"));
}

TEST(GivenFootprints, leaveTheOthersToTheLayerMissing) {
    const Measured run;
    ASSERT_EQ(run.result.sink.layers[missing].name, "missing");
    ASSERT_EQ(run.result.sink.features[missing].size(), 1U);
    EXPECT_NEAR(run.result.sink.number(missing, 0, "area_m2"), 400, 4);
    EXPECT_EQ(run.result.sink.number(missing, 0, "p50"), 9);
}

/// A footprint of less than half of an object does not cover it. Four objects are found without footprints.
TEST(GivenFootprints, coverObjectsByHalf) {
    const Box& box = FootprintScene::unmapped;
    EXPECT_EQ(Measured({{rectangle(box.col, box.row, 9, box.rows)}}).result.report.footprints->missing, 4);
    EXPECT_EQ(Measured({{rectangle(box.col, box.row, 11, box.rows)}}).result.report.footprints->missing, 3);
}

TEST(GivenFootprints, cutContoursOff) {
    const Measured run;
    double hall_area = 0;
    double crossing_area = 0;
    for (std::size_t i = 0; i < run.result.sink.features[contours].size(); ++i) {
        const std::int64_t building = run.result.sink.whole(contours, i, "bldg_id");
        ASSERT_GT(building, 0);
        if (run.result.sink.whole(contours, i, "level") != 1)
            continue;
        const double area = area_of(run.result.sink.features[contours][i].parts);
        hall_area += building == the_hall + 1 ? area : 0;
        crossing_area += building == crossing + 1 ? area : 0;
    }
    EXPECT_NEAR(hall_area, 200, 1e-6);
    EXPECT_GT(crossing_area, 80);
    EXPECT_LT(crossing_area, 100);
}

/// The seams of units pass through the buildings.
TEST(GivenFootprints, doNotDependOnUnits) {
    const Measured whole;
    const Measured divided(footprints(), {.most_whole = 100, .most_side = 24});
    for (std::size_t layer = 0; layer < whole.result.sink.features.size(); ++layer) {
        ASSERT_EQ(whole.result.sink.features[layer].size(), divided.result.sink.features[layer].size());
        for (std::size_t i = 0; i < whole.result.sink.features[layer].size(); ++i)
            EXPECT_EQ(whole.result.sink.features[layer][i].values,
                      divided.result.sink.features[layer][i].values)
                << layer << " " << i;
    }
}

/// Seams of tiles pass through the buildings and the footprints.
TEST(GivenFootprints, areThoseOfOneRunInTiles) {
    for (const std::int32_t side : {1, 2})
        for (const bool roofs : {false, true}) {
            FootprintRun run;
            run.options.write.roofs = roofs;
            run.options.write.doubtful = roofs;
            if (roofs)
                run.options.levels.interval = 5;
            const detect::UnitSize units{.most_whole = 100, .most_side = 24};
            run.run(units);
            const TemporaryFolder folder;
            StepsInTiles steps({run.dem, nullptr, nullptr, nullptr, nullptr, &run.source}, run.options,
                               {folder.path(), some_plan, side, units});
            EXPECT_GT(steps.count(), 3);
            Result tiles;
            steps.run({side, side == 2, side == 1, 2}, tiles);
            expect_same(tiles, run.result);
            EXPECT_EQ(tiles.report.footprints->given, 10);
            EXPECT_EQ(tiles.report.footprints->missing, 1);
        }
}

/// Another source is one that the tiles have not measured.
TEST(GivenFootprints, areRefusedInTilesIfTheyChange) {
    FootprintRun run;
    const TemporaryFolder folder;
    StepsInTiles steps({run.dem, nullptr, nullptr, nullptr, nullptr, &run.source}, run.options,
                       {folder.path(), some_plan, 1, {}});
    steps.plan();
    steps.find(0);
    steps.join();
    steps.draw(0);
    run.source.footprints.resize(two_parts);
    Result tiles;
    EXPECT_EQ(refusal([&] { steps.merge(tiles); }),
              "The footprints have changed since the plan was made; plan again, with a new work folder.");
}

/// No unit sees all of the town, and many footprints overlap.
TEST(GivenFootprints, ofARandomTownAreThoseOfOneRunInTiles) {
    std::vector<std::vector<WorldPolygon>> given;
    for (int i = 0; i < 60; ++i)
        given.push_back({rectangle(i * 37 % 320 - 4.3, i * 53 % 260 - 4.6, 6 + i * 7 % 41, 5 + i * 11 % 53)});
    MemorySource dem = random_town(2, {270, 330, 60, true, true});
    place_in_utm(dem, 1);
    MadeFootprints source;
    source.footprints = given;
    Options options;
    options.ground.max_building_width = 10;  // units see 50 cells around
    options.write.footprints = "given";
    options.write.roofs = true;
    const Sources sources{dem, nullptr, nullptr, nullptr, nullptr, &source};
    const detect::UnitSize units{0, 64};
    Result whole;
    whole.report = pipeline::run_in_units(options, sources, {whole.sink}, {}, units);
    EXPECT_GT(whole.report.footprints->missing, 3);
    const TemporaryFolder folder;
    StepsInTiles steps(sources, options, {folder.path(), some_plan, 1, units});
    EXPECT_GT(steps.count(), 20);
    Result tiles;
    steps.run({1, true, false, 2}, tiles);
    expect_same(tiles, whole);
}

/// Nothing is found beside them, and the thresholds are those of the whole raster.
TEST(GivenFootprints, mayCoverAllThatIsFound) {
    FootprintRun run({{rectangle(0, 0, 120, 80)}});
    run.options.levels.interval = 5;
    run.run();
    EXPECT_EQ(run.result.report.footprints->missing, 0);
    EXPECT_EQ(run.whole(0, "n_levels"), 3);  // the ground, 5 m and 10 m
}

/// Footprints in degrees are measured at the same place, and all layers are in their CRS.
TEST(GivenFootprints, mayBeInAnotherCrs) {
    FootprintRun run;
    CoordinateTransform to_degrees(Crs("EPSG:25832"), Crs("EPSG:4326"), ring({{0, 0}, {120, 80}}));
    for (std::vector<WorldPolygon>& polygons : run.source.footprints)
        for (WorldPolygon& polygon : polygons) {
            to_degrees.apply(polygon.exterior);
            for (WorldRing& hole : polygon.interiors)
                to_degrees.apply(hole);
        }
    run.source.crs = Crs("EPSG:4326").wkt();
    run.run();
    EXPECT_EQ(run.whole(the_hall, "n_cells"), 200);
    EXPECT_EQ(run.number(the_hall, "p50"), 7);
    EXPECT_NEAR(run.number(the_hall, "area_m2"), 200, 0.2);
    EXPECT_EQ(run.whole(with_hole, "n_cells"), 84);
    EXPECT_EQ(run.result.sink.provenance.crs_wkt, run.source.crs);
    for (const Feature& contour : run.result.sink.features[contours])
        EXPECT_LT(std::abs(contour.parts[0].exterior[0].x), 180);
}

/// Those of the house of two heights are flat; the invalid one has two triangles.
TEST(GivenFootprints, haveRoofs) {
    FootprintRun run;
    run.options.write.roofs = true;
    run.run();
    EXPECT_EQ(std::get<std::string>(run.result.sink.value(buildings, the_hall, "roof_type")), "flat");
    EXPECT_NEAR(run.number(the_hall, "ridge_z"), 7, 0.01);
    EXPECT_NEAR(run.number(the_hall, "flat_m2"), 200, 0.3);
    EXPECT_TRUE(run.is_null(outside, "roof_type"));
    double hall_area = 0;
    double crossing_area = 0;
    ASSERT_EQ(run.result.sink.layers[3].name, "roofs");
    for (std::size_t i = 0; i < run.result.sink.features[3].size(); ++i) {
        const std::int64_t building = run.result.sink.whole(3, i, "bldg_id");
        const double area = run.result.sink.number(3, i, "area_m2");
        hall_area += building == the_hall + 1 ? area : 0;
        crossing_area += building == crossing + 1 ? area : 0;
    }
    EXPECT_NEAR(hall_area, 200, 0.2);
    EXPECT_NEAR(crossing_area, 100, 0.2);
}

TEST(GivenFootprints, haveNoRoofsFarBeyondTheRaster) {
    FootprintRun run({{rectangle(13, 10, 20, 10)}, {rectangle(-2000, -2000, 4000, 4000)}});
    run.options.write.roofs = true;
    run.run();
    EXPECT_FALSE(run.is_null(0, "roof_type"));
    EXPECT_TRUE(run.is_null(1, "roof_type"));
    EXPECT_FALSE(run.is_null(1, "p50"));
    for (std::size_t i = 0; i < run.result.sink.features[3].size(); ++i)
        EXPECT_EQ(run.result.sink.whole(3, i, "bldg_id"), 1);
}

/// Rough cells beside the buildings look like trees.
TEST(GivenFootprints, knowTheirTrees) {
    TownRun town;
    MadeFootprints source;
    const auto in_town = [](const Box& box) {
        return WorldPolygon{{{double(box.col), double(MadeTown::rows - box.row)},
                             {double(box.col), double(MadeTown::rows - box.row - box.rows)},
                             {double(box.col + box.cols), double(MadeTown::rows - box.row - box.rows)},
                             {double(box.col + box.cols), double(MadeTown::rows - box.row)}},
                            {}};
    };
    town.dem.edit().transform = {0, 1, 0, MadeTown::rows, 0, -1};
    source.footprints = {{in_town(MadeTown::wood)}, {in_town(MadeTown::flat)}};
    town.options.write.footprints = "given";
    const RunReport report =
        run(town.options, {town.dem, nullptr, nullptr, nullptr, nullptr, &source}, {town.sink});
    EXPECT_EQ(report.footprints->measured, 2);
    EXPECT_GT(town.sink.number(buildings, 0, "tree"), 0.5);
    EXPECT_LT(town.sink.number(buildings, 1, "tree"), 0.02);
    EXPECT_NEAR(town.sink.number(buildings, 1, "p50"), MadeTown::flat_height, 0.4);
}

}  // namespace
}  // namespace d2b::test
