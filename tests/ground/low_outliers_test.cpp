#include "ground/low_outliers.hpp"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "raster/rank_filter.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

AlignedGrid flat(float height) {
    AlignedGrid surface;
    surface.grid = MetreGrid(60, 60, height);
    return surface;
}

std::size_t outliers(const AlignedGrid& surface) {
    return find_low_outliers(surface, {}, test::threads()).size();
}

TEST(OutlierMarker, APitIsOne) {
    AlignedGrid surface = flat(30);
    surface.grid.at(20, 31) = 12;
    const std::vector<LowOutlier> low_outliers = find_low_outliers(surface, {}, test::threads());
    ASSERT_EQ(low_outliers.size(), 1U);
    EXPECT_EQ(low_outliers[0].row, 20);
    EXPECT_EQ(low_outliers[0].col, 31);
    EXPECT_EQ(low_outliers[0].limit, 25);
}

/// Cell by cell: cells 5 m below the lowest of an element of 25 cells around them, after elements of one cell
/// have closed the surface.
std::vector<std::pair<std::int32_t, std::int32_t>> pits_by_definition(const MetreGrid& grid) {
    const auto extreme = [](const MetreGrid& of, std::int32_t row, std::int32_t col, std::int32_t radius,
                            int sign) {
        float found = no_value;
        for (std::int32_t i = std::max(row - radius, 0); i <= std::min(row + radius, of.rows - 1); ++i)
            for (std::int32_t j = std::max(col - radius, 0); j <= std::min(col + radius, of.cols - 1); ++j)
                found = std::min(found, static_cast<float>(sign) * of.at(i, j));
        return static_cast<float>(sign) * found;
    };
    MetreGrid highest = grid, closed = grid;
    for (std::int32_t i = 0; i < grid.rows; ++i)
        for (std::int32_t j = 0; j < grid.cols; ++j)
            highest.at(i, j) = extreme(grid, i, j, 1, -1);
    for (std::int32_t i = 0; i < grid.rows; ++i)
        for (std::int32_t j = 0; j < grid.cols; ++j)
            closed.at(i, j) = extreme(highest, i, j, 1, 1);
    std::vector<std::pair<std::int32_t, std::int32_t>> low_outliers;
    for (std::int32_t i = 0; i < grid.rows; ++i)
        for (std::int32_t j = 0; j < grid.cols; ++j)
            if (grid.at(i, j) < extreme(closed, i, j, 25, 1) - 5)
                low_outliers.emplace_back(i, j);
    return low_outliers;
}

TEST(OutlierMarker, AreFoundInAllTilesInScanOrder) {
    AlignedGrid surface;
    surface.grid = MetreGrid(70, 1300);
    std::mt19937 random(7);
    for (float& z : surface.grid.values)
        z = random() % 700 == 0 ? static_cast<float>(random() % 20) : static_cast<float>(20 + random() % 3);
    std::vector<std::pair<std::int32_t, std::int32_t>> found;
    for (const LowOutlier& outlier : find_low_outliers(surface, {}, test::threads()))
        found.emplace_back(outlier.row, outlier.col);
    EXPECT_GT(found.size(), 50U);
    EXPECT_EQ(found, pits_by_definition(surface.grid));
}

/// Whole centimetres are compared as such, others as floats.
TEST(OutlierMarker, AreFoundWhereTheyAreJustDeepEnough) {
    std::mt19937 random(11);
    for (const float beside : {0.0F, 0.0003F})
        for (const bool deep : {true, false}) {
            AlignedGrid surface;
            surface.grid = MetreGrid(60, 60);
            for (float& z : surface.grid.values) {
                const int low = deep ? 1496 + static_cast<int>(random() % 5) : 1501;
                const int steps = random() % 300 == 0 ? low : 2000 + static_cast<int>(random() % 3);
                z = static_cast<float>(steps / 100.0) + beside;
            }
            std::vector<std::pair<std::int32_t, std::int32_t>> found;
            for (const LowOutlier& outlier : find_low_outliers(surface, {}, test::threads()))
                found.emplace_back(outlier.row, outlier.col);
            EXPECT_EQ(found, pits_by_definition(surface.grid)) << beside << " " << deep;
            EXPECT_EQ(found.empty(), !deep) << beside;
        }
}

TEST(OutlierMarker, ACourtAmongRoofsIsNone) {
    AlignedGrid surface = flat(30);
    for (std::int32_t i = 10; i < 30; ++i)
        for (std::int32_t j = 10; j < 30; ++j)
            surface.grid.at(i, j) = 45;
    surface.grid.at(16, 16) = 30;  // streets are within reach
    EXPECT_EQ(outliers(surface), 0U);
}

TEST(OutlierMarker, AWideHollowIsNone) {
    AlignedGrid surface = flat(30);
    for (std::int32_t i = 20; i < 26; ++i)
        for (std::int32_t j = 20; j < 26; ++j)
            surface.grid.at(i, j) = 20;
    EXPECT_EQ(outliers(surface), 0U);
}

TEST(OutlierMarker, APitInTheMiddleOfNothingIsNotKnownToBeOne) {
    AlignedGrid surface = flat(no_value);
    surface.grid.at(20, 20) = 12;
    EXPECT_EQ(outliers(surface), 0U);
}

}  // namespace
}  // namespace d2b::ground
