#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "diagnose/parcel_fit.hpp"

namespace d2b {
namespace {

DetectOptions by_lots() {
    DetectOptions options;
    options.split_by = "lots";
    return options;
}

/// Of a thousand square metres, and 300 metres of cuts with walls beside them.
ParcelReport usual() {
    ParcelReport report;
    report.cut_length_m = 400;
    report.beside_length_m = 300;
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
                    .starts_with("cuts by 'lots' run 2.3 m beside walls (the median of 300 m)"));
    EXPECT_EQ(misplaced_warning(report, {2, 2, 1}, by_lots()), "");  // hardly more than a cell
    report.cut_length_m = 1000;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");  // by chance
    report.beside_length_m = 140;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
    report.median_distance_m = std::numeric_limits<double>::quiet_NaN();
    report.beside_length_m = 0;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
}

/// Where it is known how they would fit, that is said, and not what is beside them.
TEST(ParcelDoubt, SaysHowParcelsHaveToBeMoved) {
    ParcelReport report = usual();
    report.fitting_move = {-1, 0};
    report.median_distance_m = 2.25;
    EXPECT_EQ(misplaced_warning(report, {}, by_lots()), "");
    report.fitting_move = {-3, 4};
    EXPECT_EQ(
        misplaced_warning(report, {}, by_lots()),
        "parcels of 'lots' lie 5 m beside the walls as a whole: they fit best if they are moved 3 m to the "
        "left and 4 m down on the raster; compare them with the buildings, and move them where that is so");
    EXPECT_EQ(misplaced_warning(report, {4, 4, 1}, by_lots()), "");  // hardly more than a cell
    report.fitting_move = {0, -2.5};
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
    report.several_m2 = 10;
    EXPECT_EQ(overlap_warning(report, by_lots()), "");
    report.several_m2 = 120;
    EXPECT_TRUE(
        overlap_warning(report, by_lots())
            .starts_with("12 % of what parcels of 'lots' hold of buildings lies in more than one of them"));
    report.invalid_m2 = 40;
    EXPECT_TRUE(validity_warning(report, by_lots())
                    .starts_with("parcels of 'lots' that are not valid hold 40 m2 of buildings"));
}

TEST(ParcelFit, AddsUpAndIsReportedInMetres) {
    ParcelFit fit;
    fit.cells = 400;
    fit.inside = 300;
    fit.cuts = 100;
    fit.distances[5] = 30;
    ParcelFit more;
    more.distances[12] = 20;
    more.several = 8;
    fit.merge(more);
    const ParcelReport report = parcel_report(fit, {0.5, 0.5, 1});
    EXPECT_EQ(report.building_m2, 100);
    EXPECT_EQ(report.inside_m2, 75);
    EXPECT_EQ(report.several_m2, 2);
    EXPECT_NEAR(report.cut_length_m, 39.3, 0.1);
    EXPECT_NEAR(report.beside_length_m, 19.6, 0.1);
    EXPECT_NEAR(report.median_distance_m, 0.5, 1e-9);
    EXPECT_TRUE(std::isnan(parcel_report({}, {}).median_distance_m));
}

}  // namespace
}  // namespace d2b
