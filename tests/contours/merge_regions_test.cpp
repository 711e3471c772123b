#include "contours/merge_regions.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace d2b::contours {
namespace {

constexpr double hole = -1;  // of a picture: no cell of the building
constexpr double no_point = std::numeric_limits<double>::quiet_NaN();
using Picture = std::vector<std::vector<double>>;

BuildingCells cells_of(const Picture& picture, std::int32_t row = 0, std::int32_t col = 0) {
    BuildingCells cells;
    for (const std::vector<double>& line : picture) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            if (line[c] == hole)
                continue;
            const std::int32_t at = col + static_cast<std::int32_t>(c);
            if (c > 0 && line[c - 1] != hole)
                ++cells.runs.back().end;
            else
                cells.runs.push_back({row, at, at + 1});
            cells.elevations.push_back(line[c]);
        }
        ++row;
    }
    return cells;
}

/// The mean of each cell's region.
std::vector<double> means(const TierRegions& regions) {
    std::vector<double> result;
    for (const std::uint32_t region : regions.of_cell)
        result.push_back(regions.regions[region].mean);
    return result;
}

TEST(MergeRegions, OneRoofIsOneRegion) {
    const TierRegions found = merge_regions(cells_of({{5, 5.1, 4.9}, {5.1, 4.9, 5}}), {1, 1});
    ASSERT_EQ(found.regions.size(), 1U);
    EXPECT_EQ(found.regions[0].points, 6);
    EXPECT_NEAR(found.regions[0].mean, 5, 1e-12);
}

TEST(MergeRegions, RoofsStayApartAndWhatAWallSmearsJoinsOne) {
    const Picture picture(4, {5, 5, 5, 8, 10, 10, 10});
    EXPECT_EQ(merge_regions(cells_of(picture), {0.5, 1}).regions.size(), 3U);
    const TierRegions clean = merge_regions(cells_of(picture), {0.5, 2});
    ASSERT_EQ(clean.regions.size(), 2U);
    EXPECT_EQ(clean.regions[0].points, 12);
    EXPECT_EQ(clean.regions[0].mean, 5);
    EXPECT_EQ(clean.regions[1].points, 16);  // the column of 8 is closer to the higher roof
    EXPECT_EQ(clean.regions[1].mean, 9.5);
}

TEST(MergeRegions, ASmallRegionIsChargedWithABorderOfItsOwn) {
    // Two cells by two that stand out by 2 from sixty: 4 * 60 / 64 * 4 = 15 are added by joining them, for 8
    // of border and the charge of each region.
    Picture picture(8, std::vector<double>(8, 5));
    for (const std::size_t row : {3U, 4U})
        for (const std::size_t col : {3U, 4U})
            picture[row][col] = 7;
    EXPECT_EQ(merge_regions(cells_of(picture), {1.8, 1}).regions.size(), 2U);
    EXPECT_EQ(merge_regions(cells_of(picture), {1.9, 1}).regions.size(), 1U);
    EXPECT_EQ(merge_regions(cells_of(picture), {0.74, 1, 12}).regions.size(), 2U);
    EXPECT_EQ(merge_regions(cells_of(picture), {0.76, 1, 12}).regions.size(), 1U);
}

TEST(MergeRegions, AStripStaysWhereItStandsOutByMoreThanThePrice) {
    // Two cells wide and very long beside a wide roof: two cells of d^2 each for a cell of border.
    const auto regions = [](double d) {
        std::vector<double> line(60, 10.0);
        line[0] = line[1] = 10 + d;
        return merge_regions(cells_of(Picture(60, line)), {2, 2}).regions.size();
    };
    EXPECT_EQ(regions(0.9), 1U);
    EXPECT_EQ(regions(1.1), 2U);
}

TEST(MergeRegions, AChimneyBelongsToItsRoof) {
    Picture picture(7, std::vector<double>(7, 10.0));
    picture[3][3] = 15;
    const TierRegions found = merge_regions(cells_of(picture), {1, 2});
    ASSERT_EQ(found.regions.size(), 1U);
    EXPECT_NEAR(found.regions[0].mean, 10 + 5.0 / 49, 1e-12);
}

TEST(MergeRegions, WhatIsSeparateStaysSeparate) {
    const TierRegions found = merge_regions(cells_of({{5, 5, hole, 5, 5}, {5, 5, hole, 5, 5}}), {1e9, 2});
    ASSERT_EQ(found.regions.size(), 2U);
    EXPECT_EQ(found.of_cell, (std::vector<std::uint32_t>{0, 0, 1, 1, 0, 0, 1, 1}));
}

TEST(MergeRegions, PointsThatAreNotValidHaveNoSay) {
    const TierRegions found = merge_regions(cells_of({{5, no_point, 5}, {5, 5, 5}}), {1, 2});
    ASSERT_EQ(found.regions.size(), 1U);
    EXPECT_EQ(found.regions[0].points, 5);
    EXPECT_EQ(found.regions[0].mean, 5);
    const TierRegions none = merge_regions(cells_of({{no_point, no_point}}), {1, 2});
    ASSERT_EQ(none.regions.size(), 1U);
    EXPECT_EQ(none.regions[0].points, 0);
    EXPECT_TRUE(merge_regions({}, {1, 2}).regions.empty());
}

TEST(MergeRegions, APlaceDoesNotMatter) {
    Picture picture;
    for (int r = 0; r < 20; ++r) {
        picture.emplace_back();
        for (int c = 0; c < 30; ++c)
            picture.back().push_back((r * 7 + c * 3) % 11 == 0 ? hole : 10 + c / 10 * 3 + r * c % 5 * 0.2);
    }
    const TierRegions here = merge_regions(cells_of(picture), {1, 2});
    const TierRegions there = merge_regions(cells_of(picture, 1000, -5), {1, 2});
    EXPECT_EQ(here.of_cell, there.of_cell);
    EXPECT_EQ(means(here), means(there));
    const std::vector<double> tiers = means(here);
    EXPECT_GE(std::set<double>(tiers.begin(), tiers.end()).size(), 3U);
}

TEST(MergeRegions, CanBeStopped) {
    EXPECT_THROW((void)merge_regions(cells_of({{1, 2}}), {1, 2}, StopToken([] { return true; })), Cancelled);
}

}  // namespace
}  // namespace d2b::contours
