#include "diagnose/warnings.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "detect/parcel_fit.hpp"
#include "detect/scene_statistics.hpp"
#include "diagnose/search_warnings.hpp"

namespace d2b::diagnose {
namespace {

/// Fit of so many cells of a height above the ground, and so many of another.
detect::GroundFit heights(int bare, float low, int raised, float high, double min_height = 2) {
    detect::GroundFit fit(min_height);
    std::vector<float> surface(static_cast<std::size_t>(bare), low);
    surface.resize(static_cast<std::size_t>(bare + raised), high);
    fit.add(surface, std::vector<float>(surface.size(), 0.0F));
    return fit;
}

std::string doubt(const detect::GroundFit& fit, GroundMode mode) {
    return ground_warning(fit, mode, mode == GroundMode::given ? "dtm.tif" : "");
}

TEST(GroundDoubt, NoneOfATown) {
    for (const GroundMode mode : {GroundMode::automatic, GroundMode::given, GroundMode::none}) {
        EXPECT_EQ(doubt(heights(600, 0.1F, 400, 12), mode), "");
        EXPECT_EQ(doubt(heights(50, 0.1F, 950, 12), mode), "") << "5 % are enough";
        EXPECT_EQ(doubt(heights(600, -1.9F, 400, 12), mode), "");
        EXPECT_EQ(doubt(detect::GroundFit(2), mode), "") << "nothing is known";
    }
}

TEST(GroundDoubt, ATerrainThatIsTooHigh) {
    EXPECT_EQ(doubt(heights(600, -43.1F, 400, -31), GroundMode::given),
              "the terrain 'dtm.tif' lies 43 m above the surface where nothing stands on it (median); check "
              "whether both have the same unit and vertical datum");
}

TEST(GroundDoubt, ATerrainThatIsTooLow) {
    EXPECT_EQ(
        doubt(heights(600, 43.1F, 400, 55), GroundMode::given),
        "only 0 % of the cells lie within 2 m of the terrain 'dtm.tif', above which the surface lies 43 m "
        "(median); check whether both have the same unit and vertical datum");
    EXPECT_EQ(doubt(heights(600, 5.1F, 400, 55, 10), GroundMode::given),
              "the terrain 'dtm.tif' lies 5.1 m below the surface where nothing stands on it (median); check "
              "whether both have the same unit and vertical datum");
}

TEST(GroundDoubt, ElevationsTakenAsHeights) {
    EXPECT_EQ(doubt(heights(0, 0, 1000, 248.1F), GroundMode::none),
              "-ground none takes elevations as heights above the ground, and their median is 248 m; give a "
              "terrain model with -ground, or leave -ground out to have the ground estimated");
}

TEST(GroundDoubt, DepthsTakenAsHeights) {
    EXPECT_EQ(
        doubt(heights(990, -30.1F, 10, 3), GroundMode::none)
            .find(
                "-ground none takes elevations as heights above the ground, and their median is -30 m where "
                "they are low; "),
        0U);
}

TEST(GroundDoubt, NextToNoGroundToEstimateFrom) {
    EXPECT_EQ(doubt(heights(3, 0, 997, 9), GroundMode::automatic),
              "only 0.3 % of the cells lie within 2 m of the ground that was estimated; give a terrain model "
              "with -ground, or use a larger part of the raster");
}

TEST(SurfaceDoubt, OfATerrainModel) {
    EXPECT_EQ(
        surface_warning(heights(1000, 0.1F, 0, 0), "dem.tif"),
        "none of the cells of 'dem.tif' rise by more than 2 m above their surroundings, as in a terrain "
        "model (DTM), which has no buildings; give the surface model (DSM)");
    EXPECT_EQ(surface_warning(heights(10000, 0.1F, 9, 3), "dem.tif").find("less than 0.1 % of the cells"),
              0U);
    EXPECT_EQ(surface_warning(heights(10000, 0.1F, 100, 3), "dem.tif"), "");
    EXPECT_EQ(surface_warning(detect::GroundFit(2), "dem.tif"), "");
}

TEST(SideDoubt, OfWhatHasNoValidCell) {
    Options options;
    options.ground.terrain = "t.tif";
    options.detect.mask = "m.tif";
    options.detect.ndvi = "n.tif";
    EXPECT_EQ(empty_auxiliary_warning({}, options), "");
    EXPECT_EQ(ndvi_warning({}, options), "");
    EXPECT_EQ(
        empty_auxiliary_warning({false, true, true}, options),
        "the terrain 't.tif' has no valid cell over the DEM; give one of the same place with -ground, or "
        "leave -ground out to have the ground estimated");
    EXPECT_EQ(
        empty_auxiliary_warning({true, false, true}, options),
        "the mask 'm.tif' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that "
        "marks where buildings may be");
    EXPECT_EQ(ndvi_warning({true, true, false}, options),
              "the NDVI 'n.tif' has no valid cell over the DEM, so it shows no plants; give one of the same "
              "place with -ndvi");
}

DemInfo raster(const AffineTransform& transform) {
    DemInfo dem;
    dem.name = "dem.tif";
    dem.rows = 300;
    dem.cols = 400;
    dem.window = {0, 0, 300, 400};
    dem.transform = transform;
    dem.georeferenced = true;
    return dem;
}

TEST(PictureDoubt, ThreeBandsOrBytes) {
    DemInfo dem = raster({0, 1, 0, 0, 0, -1});
    EXPECT_EQ(picture_warning(dem), "");
    dem.bands = 2;
    EXPECT_EQ(picture_warning(dem), "");
    dem.bytes = true;
    EXPECT_EQ(picture_warning(dem),
              "'dem.tif' has byte values, like a picture or a hillshade; give a surface model (DSM), or "
              "choose the band of "
              "its elevations with -b");
    dem.bands = 3;
    EXPECT_EQ(picture_warning(dem).find("'dem.tif' has 3 bands of byte values, like a picture"), 0U);
    dem.bytes = false;
    EXPECT_EQ(picture_warning(dem).find("'dem.tif' has 3 bands, like a picture"), 0U);
}

TEST(DegreesDoubt, SmallCellsWithin180WithoutACrs) {
    const DemInfo dem = raster({13.4, 1e-5, 0, 52.5, 0, -1e-5});
    EXPECT_EQ(degrees_warning(dem, false),
              "'dem.tif' has no CRS, and its coordinates look like degrees, but were taken as metres; give "
              "-a_srs EPSG:4326 if they are degrees, else their CRS");
    EXPECT_EQ(degrees_warning(dem, true), "");
    EXPECT_EQ(degrees_warning(raster({13.4, 0.5, 0, 52.5, 0, -0.5}), false), "") << "a local system";
    EXPECT_EQ(degrees_warning(raster({181, 1e-5, 0, 52.5, 0, -1e-5}), false), "");
    EXPECT_EQ(degrees_warning(raster({13.4, 1e-5, 0, 90.1, 0, -1e-5}), false), "");
    DemInfo pixels = dem;
    pixels.georeferenced = false;
    EXPECT_EQ(degrees_warning(pixels, false), "");
}

TEST(ExtentDoubt, LessThanABuilding) {
    EXPECT_EQ(extent_warning("dem.tif", 100, 50), "");
    EXPECT_EQ(extent_warning("dem.tif", 0.0512, 0.2),
              "'dem.tif' covers 0.0512 m x 0.2 m, which is less than a building; give the right CRS with "
              "-a_srs, or a larger part of the raster");
    EXPECT_NE(extent_warning("dem.tif", 1000, 2), "") << "a strip";
    EXPECT_NE(extent_warning("dem.tif", 5, 5), "");
}

TEST(SamplingDoubt, IsNoneOfADenseScan) {
    EXPECT_EQ(sparse_points_warning({}, 0.5), "");
    EXPECT_EQ(blur_warning({}, 0.5), "") << "nothing is known";
    const SamplingReport good{0.08, 2.5, 2.5, {}};
    EXPECT_EQ(sparse_points_warning(good, 1), "");
    EXPECT_EQ(blur_warning(good, 1), "");
}

TEST(SamplingDoubt, IsOfThinPoints) {
    EXPECT_EQ(sparse_points_warning({0.197, 1.62, 0.8, {}}, 2.5),
              "points are sparse: about 1.6 per cell of 2.5 m, and none in 20 % of the cells, so "
              "roofs look rough, small houses may be missed, and crowns taken for houses; use a denser scan, "
              "or check the objects that -write_doubtful writes");
}

TEST(SamplingDoubt, IsOfSmearedWalls) {
    EXPECT_EQ(blur_warning({0, {}, 4.42, {}}, 2),
              "walls are blurred: they extend over 4.4 cells (8.8 m), as in surfaces from satellites or with "
              "cells finer than their data, so narrower gaps and courtyards are closed, and corners and "
              "small houses are lost; use a surface whose walls extend over at most two cells");
}

TEST(SamplingDoubt, IsOfRoundedElevations) {
    const auto doubt = [](double step, double metres) {
        SamplingReport report;
        report.value_step = step;
        return rounding_warning(report, metres);
    };
    EXPECT_EQ(rounding_warning({}, 1), "");
    EXPECT_EQ(doubt(0.01, 1), "");
    EXPECT_EQ(doubt(0.25, 1), "");
    EXPECT_EQ(doubt(1, 0.3048), "") << "a foot";
    EXPECT_NE(doubt(2, 0.3048), "");
    EXPECT_NE(doubt(50, 0.01), "");
    EXPECT_EQ(
        doubt(0.5, 1),
        "elevations are rounded to steps of 0.5 m, so a roof may be as rough as a crown, and low buildings, "
        "small parts and heights are uncertain by as much; use elevations that are rounded to centimetres, "
        "or not at all");
}

TEST(ScaleDoubt, CellsWiderThanThreeMetres) {
    EXPECT_EQ(coarse_cells_warning(0.5), "");
    EXPECT_EQ(coarse_cells_warning(3), "");
    EXPECT_EQ(coarse_cells_warning(30.94),
              "the cells are 30.9 m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m "
              "may do");
}

TEST(ScaleDoubt, SurfacesInAProjectionThatChangesAreas) {
    for (const double scale : {0.991, 1.0, 1.009})
        EXPECT_EQ(surface_scale_warning("UTM", scale), "");
    EXPECT_NE(surface_scale_warning("UTM", 0.98), "");
    EXPECT_EQ(
        surface_scale_warning("WGS 84 / Pseudo-Mercator", 2.4512),
        "-surface: 'WGS 84 / Pseudo-Mercator' shows areas here 2.45 times as large as on the ground, and "
        "heights stay as they are, so blocks have other proportions and volumes than the buildings; give "
        "a CRS of the area with -t_srs, such as its UTM zone");
}

TEST(ScaleDoubt, RoofsOfWhichMoreThanHalfIsDoubtful) {
    RoofReport roofs;
    EXPECT_EQ(doubtful_roofs_warning(roofs), "");
    roofs.area_m2 = 1000;
    roofs.doubtful_area_m2 = 500;
    EXPECT_EQ(doubtful_roofs_warning(roofs), "");
    roofs.doubtful_area_m2 = 620;
    EXPECT_EQ(doubtful_roofs_warning(roofs),
              "62 % of the area of roofs is doubtful, because faces are too narrow for the cells or no plane "
              "suits their points; use a finer raster, or leave -roofs out");
    roofs.level = true;
    EXPECT_EQ(
        doubtful_roofs_warning(roofs),
        "all faces of roofs are level and doubtful, because blurred walls mean blurred ridges, which have "
        "no slopes to trust; use a sharper surface, or leave -roofs out");
}

TEST(ScaleDoubt, WallsOverMoreThanTwoAndAHalfCellsAreBlurred) {
    SamplingReport report;
    EXPECT_FALSE(is_blurred(report));
    report.edge_width_cells = 2.5;
    EXPECT_FALSE(is_blurred(report));
    report.edge_width_cells = 2.6;
    EXPECT_TRUE(is_blurred(report));
}

TEST(ScaleDoubt, ToleranceOfMoreThanAHundredCells) {
    EXPECT_EQ(tolerance_warning(0, 0.5), "");
    EXPECT_EQ(tolerance_warning(50, 0.5), "");
    EXPECT_EQ(tolerance_warning(60, 0.5),
              "-simplify 60 is 120 cells wide, which leaves little of a building; it is in units of the "
              "input's CRS");
}

const std::string fine_cells =
    ", because straight walls would have left the trace or met a neighbour; -write_rejected shows these "
    "outlines, and a larger -regularize_tolerance may straighten more";

TEST(TracedDoubt, FromFivePerCentOfTheBuildingsOn) {
    EXPECT_EQ(traced_warning({}, {}, true, 0.5), "") << "nothing was written";
    EXPECT_EQ(traced_warning({950, 0, 50}, {}, true, 0.5), "");
    EXPECT_EQ(traced_warning({900, 40, 60}, {}, true, 0.5),
              "6 % of the length of the buildings' outlines keeps the staircase of the cells" + fine_cells);
    EXPECT_EQ(traced_warning({930, 60, 10}, {}, true, 0.5),
              "7 % of the length of the buildings' outlines has no straight walls" + fine_cells);
    EXPECT_EQ(traced_warning({930, 60, 10}, {}, false, 0.5), "") << "-simplify draws no walls";
    EXPECT_EQ(traced_warning({30, 0, 970}, {30, 0, 970}, true, 2.5),
              "97 % of the length of the buildings' outlines keeps the staircase of the cells, because walls "
              "cannot be seen in cells of 2.5 m; use a finer raster, or a larger -regularize_tolerance");
}

TEST(TracedDoubt, FromNinetyPerCentOfTheContoursOnWhereTheyAreAlone) {
    EXPECT_EQ(traced_warning({950, 0, 50}, {0, 0, 1000}, true, 0.5), "");
    EXPECT_EQ(traced_warning({}, {60, 40, 900}, true, 0.5), "");
    EXPECT_EQ(traced_warning({}, {60, 30, 910}, true, 0.5),
              "91 % of the length of the contours' outlines keeps the staircase of the cells" + fine_cells);
}

DetectOptions by_lots() {
    DetectOptions options;
    options.split_by = "lots";
    return options;
}

/// Report of a thousand square metres, and 300 metres of cuts with walls beside them.
ParcelReport usual() {
    ParcelReport report;
    report.cut_length_m = 400;
    report.near_wall_length_m = 300;
    report.median_distance_m = 0.5;
    report.building_m2 = report.inside_m2 = 1000;
    return report;
}

TEST(ParcelDoubt, IsNoneWhereParcelsLieAsTheyUsuallyDo) {
    for (const std::string& doubt :
         {misplaced_warning(usual(), {}, by_lots()), overlap_warning(usual(), by_lots()),
          validity_warning(usual(), by_lots())})
        EXPECT_EQ(doubt, "");
}

TEST(ParcelDoubt, IsOfParcelsThatLieBesideWalls) {
    ParcelReport report = usual();
    report.median_distance_m = 2.25;
    EXPECT_TRUE(misplaced_warning(report, {}, by_lots())
                    .starts_with("cuts by 'lots' run 2.3 m off walls (the median over 300 m of cuts)"));
    EXPECT_EQ(misplaced_warning(report, {2, 2, 1}, by_lots()), "");  // hardly more than a cell
    report.cut_length_m = 1000;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");  // by chance
    report.near_wall_length_m = 140;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
    report.median_distance_m = std::numeric_limits<double>::quiet_NaN();
    report.near_wall_length_m = 0;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
}

/// Names the move that would make parcels fit, and not the edges beside them.
TEST(ParcelDoubt, SaysHowParcelsHaveToBeMoved) {
    ParcelReport report = usual();
    report.best_offset = {-1, 0};
    report.median_distance_m = 2.25;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
    report.best_offset = {-3, 4};
    EXPECT_EQ(
        misplaced_warning(report, {}, by_lots()),
        "parcels of 'lots' lie 5 m off the walls as a whole: they fit best if they are moved 3 m to the left "
        "and 4 m down on the raster; compare them with the buildings, and move them if that is right");
    EXPECT_EQ(misplaced_warning(report, {4, 4, 1}, by_lots()), "");  // hardly more than a cell
    report.best_offset = {0, -2.5};
    EXPECT_NE(misplaced_warning(report, {}, by_lots()).find("are moved 2.5 m up on"), std::string::npos);
}

TEST(ParcelDoubt, IsOfParcelsElsewhere) {
    const std::string said =
        "no parcel of 'lots' touches a building, so none was cut; give the parcels of the same place";
    EXPECT_EQ(misplaced_warning({}, {}, by_lots()), said);
    ParcelReport lines;
    lines.cut_length_m = 5;
    EXPECT_EQ(misplaced_warning(lines, {}, by_lots()), "");
}

TEST(ParcelDoubt, IsOfOverlapsAndInvalidPolygons) {
    ParcelReport report = usual();
    report.overlap_m2 = 10;
    EXPECT_EQ(overlap_warning(report, by_lots()), "");
    report.overlap_m2 = 120;
    EXPECT_TRUE(
        overlap_warning(report, by_lots())
            .starts_with("12 % of the building area in parcels of 'lots' lies in more than one parcel"));
    report.invalid_m2 = 40;
    EXPECT_TRUE(validity_warning(report, by_lots())
                    .starts_with("parcels of 'lots' that are invalid hold 40 m2 of buildings"));
}

TEST(ParcelFit, AddsUpAndIsReportedInMetres) {
    detect::ParcelFit fit;
    fit.cells = 400;
    fit.inside = 300;
    fit.cuts = 100;
    fit.distances[5] = 30;
    detect::ParcelFit more;
    more.distances[12] = 20;
    more.several = 8;
    fit.merge(more);
    const ParcelReport report = detect::parcel_report(fit, {0.5, 0.5, 1});
    EXPECT_EQ(report.building_m2, 100);
    EXPECT_EQ(report.inside_m2, 75);
    EXPECT_EQ(report.overlap_m2, 2);
    EXPECT_NEAR(report.cut_length_m, 39.3, 0.1);
    EXPECT_NEAR(report.near_wall_length_m, 19.6, 0.1);
    EXPECT_NEAR(report.median_distance_m, 0.5, 1e-9);
    EXPECT_TRUE(std::isnan(detect::parcel_report({}, {}).median_distance_m));
}

TEST(UnitMemory, IsToldWhereItIsMoreThanUsual) {
    EXPECT_EQ(unit_memory_notice({48 << 20, 300, 60}), "");
    // 20 bytes a point.
    EXPECT_EQ(unit_memory_notice({53'687'091, 300, 60}),
              "ground and buildings are searched in up to 54 million points at a time, because each part of "
              "the raster has a margin of 300 m (five times -max_building_width 60), which takes "
              "some 1 GiB of memory");
    EXPECT_EQ(unit_memory_notice({1 << 30, 7.5, {}}),
              "ground and buildings are searched in up to 1074 million points at a time, because each part "
              "of the raster has a margin of 7.5 m, which takes some 20 GiB of memory");
}

TEST(UnitMemory, IsRefusedWhereItIsTooMuch) {
    EXPECT_EQ(unit_memory_refusal({1 << 30, 3000, 600}), "");
    EXPECT_EQ(unit_memory_refusal({2'000'000'000, 25000, 5000}),
              "Ground and buildings would be searched in 2000 million points at a time, because each part of "
              "the raster has a margin of 25000 m (five times -max_building_width 5000), which "
              "takes some 37 GiB of memory; more than 1074 million points exceed the limit, so give a "
              "smaller -max_building_width.");
    EXPECT_EQ(unit_memory_refusal({2'000'000'000, 300, {}}),
              "Ground and buildings would be searched in 2000 million points at a time, because each part of "
              "the raster has a margin of 300 m, which takes some 37 GiB of memory; more than "
              "1074 million points exceed the limit, so make the cells larger with gdalwarp -tr.");
}

TEST(Words, NumbersForPeople) {
    EXPECT_EQ(rounded(42.9), "43");
    EXPECT_EQ(rounded(2.5), "2.5");
    EXPECT_EQ(rounded(-0.26), "-0.3");
    EXPECT_EQ(percent(0.123), "12 %");
    EXPECT_EQ(percent(0.0123), "1.2 %");
    EXPECT_EQ(percent(1), "100 %");
    EXPECT_EQ(percent(0), "0 %");
    EXPECT_EQ(percent(1e-7), "less than 0.1 %");
}

TEST(Words, ACauseByItself) {
    EXPECT_EQ(as_sentence("only few"), "Only few.");
    EXPECT_EQ(as_sentence("'a.tif' is one"), "'a.tif' is one.");
    EXPECT_EQ(as_sentence("-ground none"), "-ground none.");
}

/// Report of a raster of elevations from 100 to 120.
RunReport report() {
    RunReport report;
    report.input = "dem";
    report.valid_points = 9;
    report.minimum = 100;
    report.maximum = 120;
    return report;
}

contours::LevelPlan thresholds(std::vector<double> values) {
    contours::LevelPlan plan;
    plan.thresholds = {{}, std::move(values)};
    return plan;
}

TEST(EmptyResult, SaysWhatExplainsMost) {
    RunReport nothing = report();
    nothing.valid_points = 0;
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, nothing),
              "'dem' has no valid point; the layers are empty");
    RunReport flat = report();
    flat.maximum = 100;
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, flat),
              "all valid points of 'dem' have the same elevation; no building was found");
    EXPECT_EQ(explain_empty_result(thresholds({}), 0, {}, report()),
              "no threshold lies between the lowest and the highest elevation; no building was found");
    DemInfo picture;
    picture.name = "dem";
    picture.bands = 3;
    EXPECT_TRUE(explain_empty_result(thresholds({110}), 0, picture, report())
                    .starts_with("no building was found: 'dem' has 3 bands, like a picture"));
    EXPECT_EQ(explain_empty_result(thresholds({110}), 0, {}, report()),
              "no building was found; a smaller -nf or -min_area, or more levels, may show some");
}

TEST(EmptyResult, LeavesToTheSearchWhatItKnowsBetter) {
    contours::LevelPlan footprints = thresholds({});
    footprints.footprints = true;
    EXPECT_EQ(explain_empty_result(footprints, 0, {}, report()), "");
    EXPECT_EQ(explain_empty_result(thresholds({110}), 1, {}, report()), "");
}

}  // namespace
}  // namespace d2b::diagnose
