#include "diagnose/search_warnings.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "detect/scene_statistics.hpp"

namespace d2b::diagnose {
namespace {

/// A search in a good surface in which nothing was found; each test spoils something.
class NothingFound : public ::testing::Test {
  protected:
    NothingFound() {
        dem_.name = "dem.tif";
        dem_.rows = dem_.window.rows = 200;
        dem_.cols = dem_.window.cols = 300;
        dem_.transform = {391000, 1, 0, 5820000, 0, -1};
        dem_.georeferenced = true;
        scene_.sides = {true, true, true};
        lie(0.1F);
        scene_.fit.add(std::vector<float>(300, 12.0F), std::vector<float>(300, 0.0F));  // trees
    }
    void lie(float height) {
        scene_.fit = detect::GroundFit(options_.detect.min_height);
        scene_.fit.add(std::vector<float>(700, height), std::vector<float>(700, 0.0F));
    }
    /// The beginning of the explanation.
    [[nodiscard]] std::string said(std::size_t length) const {
        return explain_empty_search(
                   {dem_, make_run_plan(options_, Layers::both), tally_, scene_, cell_, has_crs_})
            .substr(0, length);
    }
    /// The warnings if something was found.
    [[nodiscard]] std::string said_of_found() const {
        Context context;
        context.report.valid_points = 1000;
        warn_about_search({dem_, make_run_plan(options_, Layers::both), tally_, scene_, cell_, has_crs_},
                          true, context);
        std::string all;
        for (const std::string& one : context.report.warnings)
            all += one + "\n";
        return all;
    }
    void expect(const std::string& beginning) const { EXPECT_EQ(said(beginning.size()), beginning); }

    DemInfo dem_;
    Options options_;
    Tally tally_;
    detect::SceneStatistics scene_;
    CellSize cell_;
    bool has_crs_ = true;
};

TEST_F(NothingFound, WhereNothingElseIsKnown) {
    expect(
        "nothing that rises by more than 2 m above the ground is as smooth and wide as a roof; cells should "
        "be "
        "at most 1 m wide, or 2.5 m for large buildings, and -write_canopy shows everything that rises");
}

TEST_F(NothingFound, ASideWithoutACell) {
    dem_.bytes = true;
    options_.ground.terrain = "t.tif";
    scene_.sides.terrain = false;
    expect("the terrain 't.tif' has no valid cell");
    scene_.sides = {true, false, true};
    expect("the mask '' has no cell");
    scene_.sides = {true, true, false};
    expect("'dem.tif' has byte values");  // an NDVI hides nothing
}

TEST_F(NothingFound, APicture) {
    lie(0);
    dem_.bands = 3;
    expect("'dem.tif' has 3 bands, like a picture");
}

TEST_F(NothingFound, DegreesAndSmallExtents) {
    dem_.transform = {13, 1e-5, 0, 52, 0, -1e-5};
    cell_ = {1e-5, 1e-5};
    has_crs_ = false;
    expect("'dem.tif' has no CRS, and its coordinates look like degrees");
    has_crs_ = true;
    expect("'dem.tif' covers 0.003 m x 0.002 m");
}

TEST_F(NothingFound, AGroundThatCannotBeRight) {
    lie(-43);
    options_.ground.mode = GroundMode::given;
    expect("the terrain '' lies 43 m above the surface");
}

TEST_F(NothingFound, ATerrainModelUnlessAnOptionHidesMore) {
    lie(0);
    tally_.count(Reason::building_small, 3);
    expect("none of the cells of 'dem.tif' rise by more than 2 m");
    options_.filter.min_area_m2 = 500;
    expect("-min_area 500 leaves 3 out; a smaller value may show them");
}

TEST_F(NothingFound, ABuildingThatIsTakenForTheGround) {
    lie(0);
    expect(
        "none of the cells of 'dem.tif' rise by more than 2 m above their surroundings, as in a terrain "
        "model "
        "(DTM), which has no buildings; give the surface model (DSM), or a larger -max_building_width if a "
        "building is wider than 60 m");
    options_.ground.max_building_width = 200;
    EXPECT_EQ(said(1000).find("-max_building_width"), std::string::npos) << "the raster is no wider";
}

/// Heights above the ground in whole metres, with NoData as ground.
TEST_F(NothingFound, BytesInPiecesAreNoPicture) {
    scene_.islands = {.cells = 1000, .narrow = 900, .islands = 4, .largest = 300};
    dem_.bytes = true;
    lie(9);
    expect("'dem.tif' has elevations in 4 pieces");
    EXPECT_NE(said_of_found().find("-ground none"), std::string::npos);
    EXPECT_EQ(said_of_found().find("byte values"), std::string::npos);
    dem_.bands = 3;
    expect("'dem.tif' has 3 bands of byte values");
}

TEST_F(NothingFound, RoofsAloneLieAboveTheTerrain) {
    options_.ground.mode = GroundMode::given;
    options_.ground.terrain = "t.tif";
    scene_.islands = {.cells = 1000, .narrow = 900, .islands = 4, .largest = 300};
    lie(9);
    EXPECT_EQ(said_of_found(), "");
    lie(43);
    EXPECT_EQ(said_of_found().find("Only 0 % of the cells lie within 2 m of the terrain 't.tif'"), 0U);
    lie(-43);
    EXPECT_EQ(said_of_found().find("The terrain 't.tif' lies 43 m above the surface"), 0U);
    lie(9);
    scene_.islands.narrow = 400;
    EXPECT_EQ(said_of_found().find("Only 0 % of the cells lie within 2 m of the terrain 't.tif'"), 0U);
}

TEST_F(NothingFound, WhatOptionsLeaveOut) {
    tally_.count(Reason::building_small, 12);
    tally_.count(Reason::building_low, 3);
    tally_.count(Reason::building_not_tall, 4);
    tally_.count(Reason::building_doubtful, 5);
    options_.detect.min_building_height = 0;
    expect(
        "-min_area 30 leaves 12 out, -min_height 2 leaves 3 out, -min_building_height 0 leaves 4 out, "
        "-min_confidence 0.5 leaves 5 out; a smaller "
        "value may show them");
    scene_.slope.add(0.6, 0);
    expect("100 % of the ground of 'dem.tif' is steeper than 40 %");
    options_.detect.min_height = 10;
    expect("-min_height 10 leaves 3 out; a smaller value may show them");
}

TEST_F(NothingFound, WhatIsExcluded) {
    tally_.count(Reason::building_small, 12);
    tally_.count(Reason::building_excluded, 4);
    options_.detect.exclude = "water.gpkg";
    expect(
        "-exclude 'water.gpkg' leaves out 4 of 4 buildings that were found; check that its polygons are "
        "bridges, water and the like");
}

TEST(GroundSlope, IsToldWhereMostOfItIsSteep) {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    detect::GroundSlope slope;
    EXPECT_EQ(slope_warning(slope, "p.tif"), "") << "nothing is known";
    slope.add(0.41, 0);
    slope.add(0.3, -0.3);  // 0.42 along its steepest line
    slope.add(not_known, 7);
    slope.add(0.39, 0);
    slope.add(0, 0);
    EXPECT_EQ(slope.cells, 4);
    EXPECT_EQ(slope_warning(slope, "p.tif"), "") << "half of it";
    slope.add(0, -2);
    EXPECT_EQ(
        slope_warning(slope, "p.tif"),
        "60 % of the ground of 'p.tif' is steeper than 40 %, where buildings can hardly be told from the "
        "slope; give a terrain model with -ground, and check the units of elevations and coordinates "
        "(-zunit)");
}

TEST(GroundSlope, IsOfEverySixteenthRowOfItsCells) {
    constexpr std::int32_t rows = 5000;
    constexpr std::int32_t cols = 60;
    MetreGrid ground(rows, cols);
    for (std::int32_t r = 0; r < rows; ++r)
        for (std::int32_t c = 0; c < cols; ++c)
            ground.at(r, c) = static_cast<float>((r + c * c) % 11) * 0.13F;
    detect::GroundSlope slope;
    Executor threads(2);
    detect::add_slope(ground, {1, 1}, 3, {10, 5, rows - 10, cols - 5}, slope, threads);
    std::int64_t cells = 0;
    std::int64_t steep = 0;
    for (std::int32_t r = 10; r < rows - 1; ++r)
        if ((r + 3) % 16 == 0)
            for (std::int32_t c = 5; c < cols - 1; ++c) {
                ++cells;
                const float down = ground.at(r + 1, c) - ground.at(r, c);
                const float across = ground.at(r, c + 1) - ground.at(r, c);
                steep += across * across + down * down > 0.16F ? 1 : 0;
            }
    EXPECT_EQ(slope.cells, cells);
    EXPECT_EQ(slope.steep_cells, steep);
    EXPECT_GT(steep, 0);
    EXPECT_LT(steep, cells);
}

}  // namespace
}  // namespace d2b::diagnose
