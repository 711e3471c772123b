#include "ground/connected_ground.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "raster/rank_filter.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

/// A row of blocks of 2 m; the first is ground, the others exceed their limit.
Grid<std::uint8_t> connected_row(const std::vector<float>& heights, double slope, int steps) {
    AlignedGrid blocks;
    blocks.cell = {2, 2};
    blocks.grid = MetreGrid(1, static_cast<std::int32_t>(heights.size()));
    blocks.grid.values.assign(heights.begin(), heights.end());
    MetreGrid limits(1, blocks.grid.cols, -100.0F);
    limits.at(0, 0) = 100;
    return connected_ground(blocks, limits, slope, steps, test::threads());
}

using Row = std::vector<std::uint8_t>;

TEST(ConnectedGround, GoesUpASlopeAndStopsAtAWall) {
    // Steps of 0.5 m in 2 m are a slope of 0.25; the wall is 3 m high.
    EXPECT_EQ(connected_row({0, 0.5F, 1, 1.5F, 4.5F, 4.5F}, 0.3, 9).values, (Row{1, 1, 1, 1, 0, 0}));
    EXPECT_EQ(connected_row({0, 0.5F, 1, 1.5F, 4.5F, 4.5F}, 0.2, 9).values, (Row{1, 0, 0, 0, 0, 0}));
}

TEST(ConnectedGround, GoesNoFartherThanItsSteps) {
    EXPECT_EQ(connected_row({0, 0, 0, 0, 0}, 0.3, 2).values, (Row{1, 1, 1, 0, 0}));
}

TEST(ConnectedGround, BlocksWithoutAPointConnectNothing) {
    EXPECT_EQ(connected_row({0, 0, no_value, 0}, 0.3, 9).values, (Row{1, 1, 0, 0}));
}

TEST(ConnectedGround, TheWayRoundAWallIsFound) {
    AlignedGrid blocks;
    blocks.cell = {2, 3};
    blocks.grid = MetreGrid(3, 5, 0.0F);
    blocks.grid.at(0, 2) = blocks.grid.at(1, 2) = 9;
    MetreGrid limits(3, 5, -1.0F);
    limits.at(0, 0) = 1;
    const Row expected{1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1};
    EXPECT_EQ(connected_ground(blocks, limits, 0.3, 20, test::threads()).values, expected);
}

using Drawing = std::vector<std::string>;

constexpr float limit = 0.5F;
constexpr double any_length = 1000;

/// Blocks of 2 m, all connected ground; those above the limit were objects before. Each character is
/// a height in metres: a digit, a dot without a point, and in upper case one off the connected ground (A: 1).
struct Blocks {
    AlignedGrid surface;
    MetreGrid limits;
    Grid<std::uint8_t> ground;

    explicit Blocks(const Drawing& rows, CellSize cell = {2, 2}) {
        const auto cols = static_cast<std::int32_t>(rows[0].size());
        surface.cell = cell;
        surface.grid = MetreGrid(static_cast<std::int32_t>(rows.size()), cols);
        limits = MetreGrid(surface.grid.rows, cols, limit);
        ground = Grid<std::uint8_t>(surface.grid.rows, cols, 1);
        for (std::int32_t i = 0; i < surface.grid.rows; ++i)
            for (std::int32_t j = 0; j < cols; ++j)
                set(i, j, rows[static_cast<std::size_t>(i)].at(static_cast<std::size_t>(j)));
    }
    /// The remaining ground: #.
    [[nodiscard]] Drawing left(double largest = any_length) const {
        Grid<std::uint8_t> mask = ground;
        remove_enclosed_by_walls(surface, limits, {}, largest, mask, test::threads());
        return drawing(mask);
    }
    [[nodiscard]] Drawing before() const { return drawing(ground); }

  private:
    void set(std::int32_t i, std::int32_t j, char what) {
        const bool open = what >= 'A' && what <= 'I';
        surface.grid.at(i, j) = what == '.' ? no_value : static_cast<float>(what - (open ? 'A' - 1 : '0'));
        ground.at(i, j) = open || what == '.' ? 0 : 1;
    }
    static Drawing drawing(const Grid<std::uint8_t>& mask) {
        Drawing rows;
        for (std::int32_t i = 0; i < mask.rows; ++i) {
            rows.emplace_back();
            for (const std::uint8_t value : mask.row(i))
                rows.back() += value != 0 ? '#' : ' ';
        }
        return rows;
    }
};

TEST(WalledBack, ARoofReachedByARamp) {
    const Blocks blocks({"00000000000000",  //
                         "00000555555550",  //
                         "01234555555550",  //
                         "00000555555550",  //
                         "00000555555550",  //
                         "00000000000000"});
    // The ramp's first block has no wall on three sides, its other blocks have two each, the roof 23: 29 of
    // 32.
    const Drawing expected{"##############",  //
                           "#####        #",  //
                           "#            #",  //
                           "#####        #",  //
                           "#####        #",  //
                           "##############"};
    EXPECT_EQ(blocks.left(), expected);
}

TEST(WalledBack, ATerraceThatGoesOnLevelOnOneSideStays) {
    Blocks blocks({"00000000",  //
                   "00555555",  //
                   "00555555",  //
                   "00555555",  //
                   "00555555",  //
                   "00000000"});
    // Its right half was no object: three walls of four.
    for (std::int32_t i = 1; i < 5; ++i)
        blocks.limits.at(i, 6) = blocks.limits.at(i, 7) = 100;
    EXPECT_EQ(blocks.left(), blocks.before());
}

TEST(WalledBack, TheShareIsExceededNotReached) {
    // Five by five blocks have twenty sides; behind two, or one of them, it goes on level.
    const auto piece = [](std::int32_t level) {
        Blocks blocks({"0000000",  //
                       "0555550",  //
                       "0555550",  //
                       "0555550",  //
                       "0555550",  //
                       "0555550",  //
                       "0000000"});
        for (std::int32_t i = 1; i <= level; ++i) {
            blocks.surface.grid.at(i, 6) = 5;
            blocks.limits.at(i, 6) = 100;
        }
        return blocks;
    };
    EXPECT_EQ(piece(2).left(), piece(2).before());
    const Drawing one = piece(1).left();
    EXPECT_EQ(one[0], "#######");
    for (std::size_t i = 1; i < 6; ++i)
        EXPECT_EQ(one[i], "#     #") << i;
}

/// A pyramid of 15 by 15 blocks, its top seven steps above its border, with objects from 2.7 m on.
Blocks pyramid(float step) {
    Blocks blocks(Drawing(15, std::string(15, '0')));
    for (std::int32_t i = 0; i < 15; ++i)
        for (std::int32_t j = 0; j < 15; ++j) {
            blocks.surface.grid.at(i, j) =
                step * static_cast<float>(7 - std::max(std::abs(i - 7), std::abs(j - 7)));
            blocks.limits.at(i, j) = 2.7F;
        }
    return blocks;
}

TEST(WalledBack, AHillStays) {
    // Within two blocks it falls by less than a wall's 1.5 m.
    EXPECT_EQ(pyramid(0.6F).left(), pyramid(0.6F).before());
    // Rises by 2.4 m: 3.6 m are the third step.
    const Drawing steep = pyramid(1.2F).left();
    EXPECT_EQ(steep[2], "###############");
    for (std::size_t i = 3; i < 12; ++i)
        EXPECT_EQ(steep[i], "###         ###") << i;
}

TEST(WalledBack, LongPiecesStay) {
    const Drawing roof{"00000",  //
                       "05550",  //
                       "05550",  //
                       "00000"};
    const Drawing taken{"#####",  //
                        "#   #",  //
                        "#   #",  //
                        "#####"};
    const Blocks square(roof);
    EXPECT_EQ(square.left(6), taken);
    EXPECT_EQ(square.left(5.9), square.before());
    const Blocks wide(roof, {3, 2});
    EXPECT_EQ(wide.left(9), taken);
    EXPECT_EQ(wide.left(8.9), wide.before());
    const Blocks high(roof, {1, 6});
    EXPECT_EQ(high.left(12), taken);
    EXPECT_EQ(high.left(11.9), high.before());
}

TEST(WalledBack, AWallTwoBlocksAwayCounts) {
    // A block of 4 m between roof and ground is no connected ground.
    const Blocks two({"0000000",  //
                      "0DDDDD0",  //
                      "0D555D0",  //
                      "0D555D0",  //
                      "0D555D0",  //
                      "0DDDDD0",  //
                      "0000000"});
    for (std::size_t i = 2; i < 5; ++i)
        EXPECT_EQ(two.left()[i], "#     #") << i;
    const Blocks three({"000000000",  //
                        "0DDDDDDD0",  //
                        "0DDDDDDD0",  //
                        "0DD555DD0",  //
                        "0DD555DD0",  //
                        "0DD555DD0",  //
                        "0DDDDDDD0",  //
                        "0DDDDDDD0",  //
                        "000000000"});
    EXPECT_EQ(three.left(), three.before());
}

TEST(WalledBack, WallsMayRiseBeyond) {
    const Blocks low_roof({"IIIII",  //
                           "I555I",  //
                           "I555I",  //
                           "IIIII"});
    const Drawing nothing(4, "     ");
    EXPECT_EQ(low_roof.left(), nothing);
    const Blocks parapet({"FFFFF",  // by 1 m: no wall
                          "F555F",  //
                          "F555F",  //
                          "FFFFF"});
    EXPECT_EQ(parapet.left(), parapet.before());
}

TEST(WalledBack, WhatReachesTheRastersBorderMayGoOn) {
    // Two of its ten sides are the border of the raster, the others walls.
    const Blocks cut({"005500",  //
                      "005500",  //
                      "005500",  //
                      "000000"});
    EXPECT_EQ(cut.left(), cut.before());
    // Two of 24.
    const Blocks street({"0055000000000",  //
                         "0055555555550",  //
                         "0000000000000"});
    EXPECT_EQ(street.left(), (Drawing{"##  #########",  //
                                      "##          #",  //
                                      "#############"}));
    const Blocks all({"555", "555"});
    EXPECT_EQ(all.left(), all.before()) << "nothing is known about its border";
}

TEST(WalledBack, BlocksWithoutAPointAreNoBorder) {
    const Blocks shore({"00000",  //
                        "0555.",  //
                        "0555.",  //
                        "00000"});
    EXPECT_EQ(shore.left(), (Drawing{"#####", "#    ", "#    ", "#####"}));
    // A wall above, none below: half of the known border, whatever the gaps on both sides hide.
    Blocks wharf({".0.",  //
                  ".5.",  //
                  ".5.",  //
                  ".5.",  //
                  ".4."});
    wharf.limits.at(4, 1) = 100;
    EXPECT_EQ(wharf.left(), wharf.before());
}

TEST(WalledBack, PiecesAreJudgedOneByOne) {
    // A roof beside a slope, which touch at a corner.
    const Blocks blocks({"00000000",  //
                         "05500000",  //
                         "05500000",  //
                         "00011111",  //
                         "00011111"});
    EXPECT_EQ(blocks.left(), (Drawing{"########",  //
                                      "#  #####",  //
                                      "#  #####",  //
                                      "########",  //
                                      "########"}));
}

TEST(WalledBack, WhereNothingWasConnectedNothingChanges) {
    const Blocks roof({"00000",  //
                       "0EEE0",  //
                       "0EEE0",  //
                       "00000"});
    EXPECT_EQ(roof.left(), roof.before());
    Blocks ground({"00000",  //
                   "05550",  //
                   "00000"});
    std::fill(ground.limits.values.begin(), ground.limits.values.end(), 5.0F);
    EXPECT_EQ(ground.left(), ground.before()) << "high, but never an object";
    Grid<std::uint8_t> none;
    remove_enclosed_by_walls({}, {}, {}, any_length, none, test::threads());
    EXPECT_EQ(none.size(), 0U);
}

/// A roof on a street at 0 m, in blocks of 2 m, with walls on three sides. At its fourth it meets a yard that
/// is as high.
/// @param slope of the roof along its columns @param left columns of street at the left of the roof
/// @return number of its blocks that stay ground
std::int64_t blocks_left(std::int32_t rows, std::int32_t cols, float slope, const Rules& rules,
                         std::int32_t left = 5) {
    AlignedGrid surface;
    surface.cell = {2, 2};
    surface.grid = MetreGrid(rows + 10, cols + left + 5);
    MetreGrid limits(surface.grid.rows, surface.grid.cols, 1);
    for (std::int32_t r = 5; r < rows + 8; ++r)
        for (std::int32_t c = left; c < cols + left; ++c) {
            surface.grid.at(r, c) = 5 + 2 * slope * static_cast<float>(c - left);
            if (r >= rows + 5)
                limits.at(r, c) = 100;
        }
    Mask ground(surface.grid.rows, surface.grid.cols, 1);
    remove_enclosed_by_walls(surface, limits, rules, any_length, ground, test::threads());
    return std::ranges::count(ground.values, std::uint8_t{1}) - static_cast<std::int64_t>(ground.size()) +
           std::int64_t{rows} * cols;
}

TEST(WalledBack, ALargeLevelRoofWithThreeWallsOnCoarseCells) {
    const Rules coarse = rules_for({2, 2});
    // 40 of 60 sides are walls, more than 0.6; 800 m2.
    EXPECT_EQ(blocks_left(10, 20, 0, coarse), 0);
    EXPECT_EQ(blocks_left(10, 20, 0.04F, coarse), 0);
    EXPECT_EQ(blocks_left(10, 20, 0.06F, coarse), 200) << "a terrace";
    EXPECT_EQ(blocks_left(10, 20, 0, rules_for({1, 1})), 200) << "fine cells";
    EXPECT_EQ(blocks_left(7, 20, 0, coarse), 140) << "560 m2, 34 of 54 sides";
    EXPECT_EQ(blocks_left(8, 20, 0, coarse), 0) << "640 m2, 36 of 56 sides";
    EXPECT_EQ(blocks_left(5, 40, 0, coarse), 200) << "50 of 90 sides";
    EXPECT_EQ(blocks_left(30, 15, 0, coarse, 0), 0)
        << "45 of 60 sides, and 30 that the border of the raster cuts";
    EXPECT_EQ(blocks_left(10, 20, 0, coarse, 0), 200) << "30 of 50 sides";
}

constexpr double unbounded = 1000;

/// Blocks of 2 m; each character is a height in metres, a dot has no point. All are connected ground, and
/// those above 7 m were objects before.
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
    // Another roof begins at 0.85 m: 0.3 times a diagonal.
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
