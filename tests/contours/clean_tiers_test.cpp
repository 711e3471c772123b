#include "contours/clean_tiers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace d2b::contours {
namespace {

/// Rows of columns 300 to 303, all at 1.
ElevationBand even_rows(std::int32_t first, std::int32_t rows) {
    const BandShape shape{first, rows, 4};
    return {shape, std::vector<double>(shape.size(), 1.0)};
}

/// The band with the clean elevations of the cells that were given.
ElevationBand clean_band(const CleanRows& rows, ElevationBand band) {
    rows.for_runs(band.shape, [&](const CleanRows::CleanRun& run) {
        const auto row = band.elevations.begin() + static_cast<std::ptrdiff_t>(run.row) * band.shape.cols;
        std::fill(row + run.begin, row + run.end, run.elevation);
    });
    return band;
}

TEST(CleanRows, StandForTheCellsThatWereGiven) {
    CleanRows rows(std::make_unique<MemorySpool>(), {1000, 300, 200, 4});
    // Over three slabs; in each row two cells of a region and one of another.
    BuildingCells building;
    for (std::int32_t row = 1050; row < 1150; ++row) {
        building.runs.push_back({row, 301, 304});
        for (const double z : {5.0, 5.0, 7.0})
            building.elevations.push_back(z + row);
    }
    rows.add(building);
    rows.add({{{1050, 300, 301}}, {9}});
    for (const auto& [first, count] : {std::pair{1000, 200}, std::pair{1049, 3}, std::pair{1060, 1},
                                       std::pair{1063, 2}, std::pair{1149, 51}, std::pair{1199, 1}}) {
        const ElevationBand clean = clean_band(rows, even_rows(first, count));
        for (std::int32_t r = 0; r < count; ++r) {
            const std::int32_t row = first + r;
            const bool built = row >= 1050 && row < 1150;
            EXPECT_EQ(clean.row(r)[0], row == 1050 ? 9 : 1) << row;
            EXPECT_EQ(clean.row(r)[1], built ? 5 + row : 1) << row;
            EXPECT_EQ(clean.row(r)[2], built ? 5 + row : 1) << row;
            EXPECT_EQ(clean.row(r)[3], built ? 7 + row : 1) << row;
        }
    }
    EXPECT_TRUE(clean_band(rows, even_rows(1000, 0)).elevations.empty());
}

TEST(CleanRows, KeepPointsThatAreNotValid) {
    CleanRows rows(std::make_unique<MemorySpool>(), {0, 0, 1, 4});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    rows.add({{{0, 0, 3}}, {nan, nan, 2}});
    const ElevationBand clean = clean_band(rows, {{0, 1, 4}, {3, 3, 3, 3}});
    EXPECT_TRUE(std::isnan(clean.elevations[0]));
    EXPECT_TRUE(std::isnan(clean.elevations[1]));
    EXPECT_EQ(clean.elevations[2], 2);
    EXPECT_EQ(clean.elevations[3], 3);
}

TEST(RegionOptions, ABorderCostsWhatAStripStandsOut) {
    // A strip 100 m long that stands out by 2 m, in points that are so far off, for each cell of its border.
    for (const double side : {0.25, 0.5, 1.0, 2.5, 5.0}) {
        const double wide = std::max(1.0, side);
        const double error = 100 * wide / (side * side) * 2 * 2;
        EXPECT_NEAR(region_options(2, {side, side}, 1).price, error / (100 / side), 1e-9) << side;
    }
    // Cells need not be square, nor heights be in metres.
    EXPECT_NEAR(region_options(2, {0.25, 1}, 1).price, 8, 1e-9);
    EXPECT_NEAR(region_options(2, {2.5, 2.5}, 0.3048).price, 4 / (0.3048 * 0.3048), 1e-9);
}

}  // namespace
}  // namespace d2b::contours
