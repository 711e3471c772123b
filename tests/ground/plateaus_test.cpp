#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ground/connected_ground.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {
namespace {

using Drawing = std::vector<std::string>;

constexpr double unbounded = 1000;

/// Blocks of 2 m; each character is a height in metres, a dot has no point. All are connected ground, and
/// what is higher than 7 m was an object before.
AlignedGrid heights(const Drawing& rows) {
    AlignedGrid blocks;
    blocks.cell = {2, 2};
    blocks.grid =
        MetreGrid(static_cast<std::int32_t>(rows.size()), static_cast<std::int32_t>(rows.at(0).size()));
    for (std::size_t i = 0; i < blocks.grid.size(); ++i) {
        const char height = rows[i / rows[0].size()].at(i % rows[0].size());
        blocks.grid.values[i] = height == '.' ? no_value : static_cast<float>(height - '0');
    }
    return blocks;
}

Mask roofs_of(const AlignedGrid& blocks, double largest = unbounded) {
    return enclosed_plateaus(blocks, MetreGrid(blocks.grid.rows, blocks.grid.cols, 7),
                             Mask(blocks.grid.rows, blocks.grid.cols, 1), {}, largest);
}

Drawing picture(const Mask& mask) {
    Drawing rows;
    for (std::int32_t row = 0; row < mask.rows; ++row) {
        rows.emplace_back();
        for (const std::uint8_t value : mask.row(row))
            rows.back() += value != 0 ? '#' : ' ';
    }
    return rows;
}

const Drawing hall{"0000000000",  //
                   "0888888880",  //
                   "0888888880",  //
                   "0666666660",  //
                   "0000000000"};

TEST(Plateaus, OfARoofTheLowerPartsBelongToIt) {
    // The lower strip was no object, and is a step of half a metre below the rest.
    AlignedGrid blocks = heights(hall);
    for (float& z : blocks.grid.row(3))
        z = z == 6 ? 6.5F : z;
    for (const std::int32_t row : {1, 2})
        for (float& z : blocks.grid.row(row))
            z = z == 8 ? 7.05F : z;
    EXPECT_EQ(picture(roofs_of(blocks)), (Drawing{"          ",  //
                                                  " ######## ",  //
                                                  " ######## ",  //
                                                  " ######## ",  //
                                                  "          "}));
    // From 0.85 m on it is another roof: 0.3 times a diagonal.
    for (float& z : blocks.grid.row(3))
        z = z == 6.5F ? 6.1F : z;
    EXPECT_EQ(picture(roofs_of(blocks))[2], " ######## ");
    EXPECT_EQ(picture(roofs_of(blocks))[3], "          ") << "not above its limit";
}

TEST(Plateaus, WhatWasNoObjectIsNotLookedAt) {
    EXPECT_EQ(picture(enclosed_plateaus(heights(hall), MetreGrid(5, 10, 9), Mask(5, 10, 1), {}, unbounded)),
              Drawing(5, "          "));
    EXPECT_EQ(picture(enclosed_plateaus(heights(hall), MetreGrid(5, 10, 7), Mask(5, 10), {}, unbounded)),
              Drawing(5, "          "))
        << "nor what is no connected ground";
}

TEST(Plateaus, NotLongerThanTheWidestBuilding) {
    EXPECT_EQ(picture(roofs_of(heights(hall), 16))[1], " ######## ");
    EXPECT_EQ(picture(roofs_of(heights(hall), 15.9))[1], "          ");
}

TEST(Plateaus, AWayDownMakesItGround) {
    // Down the right side in steps of half a metre to a street that is longer than any roof.
    AlignedGrid blocks;
    blocks.cell = {2, 2};
    blocks.grid = MetreGrid(12, 60);
    for (std::int32_t row = 2; row < 10; ++row)
        for (std::int32_t col = 2; col < 10; ++col)
            blocks.grid.at(row, col) = 8;
    const Mask walled = roofs_of(blocks, 100);
    EXPECT_EQ(std::count(walled.values.begin(), walled.values.end(), 1), 64);
    for (std::int32_t col = 10; col < 26; ++col)
        blocks.grid.at(5, col) = 8 - 0.5F * static_cast<float>(col - 9);
    const Mask with_way = roofs_of(blocks, 100);
    EXPECT_EQ(std::count(with_way.values.begin(), with_way.values.end(), 1), 0);
}

TEST(Plateaus, MoreThanNineTenthsOfTheBorderFall) {
    // Six by six blocks have 24 sides. Behind so many of them something stands that is as high as a parapet.
    const auto beside = [](std::int32_t parapets) {
        AlignedGrid blocks;
        blocks.cell = {2, 2};
        blocks.grid = MetreGrid(12, 12);
        for (std::int32_t row = 3; row < 9; ++row)
            for (std::int32_t col = 3; col < 9; ++col)
                blocks.grid.at(row, col) = 8;
        for (std::int32_t i = 0; i < parapets; ++i)
            blocks.grid.at(2, 3 + i) = blocks.grid.at(1, 3 + i) = 9;
        const Mask roofs = roofs_of(blocks);
        return roofs.at(5, 5);
    };
    EXPECT_EQ(beside(2), 1);  // 22 of 24 are 0.917
    EXPECT_EQ(beside(3), 0);  // 21 are 0.875
}

TEST(Plateaus, WhatReachesTheRastersBorderMayGoOn) {
    EXPECT_EQ(picture(roofs_of(heights({"0000",  //
                                        "0088",  //
                                        "0088",  //
                                        "0000"}))),
              Drawing(4, "    "));
    // A gap in the data is no border; the rest falls.
    EXPECT_EQ(picture(roofs_of(heights({"000000",  //
                                        "00888.",  //
                                        "00888.",  //
                                        "000000"}))),
              (Drawing{"      ", "  ### ", "  ### ", "      "}));
    EXPECT_EQ(enclosed_plateaus({}, {}, {}, {}, unbounded).size(), 0U);
}

TEST(Plateaus, DoNotDependOnWhereTheyAreEntered) {
    AlignedGrid blocks = heights(hall);
    AlignedGrid turned = blocks;
    std::reverse(turned.grid.values.begin(), turned.grid.values.end());
    Mask back = roofs_of(turned);
    std::reverse(back.values.begin(), back.values.end());
    EXPECT_EQ(picture(back), picture(roofs_of(blocks)));
}

}  // namespace
}  // namespace d2b::ground
