#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ground/connected_ground.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {
namespace {

using Drawing = std::vector<std::string>;

constexpr float limit = 0.5F;
constexpr double any_length = 1000;

/// Blocks of 2 m, all connected ground; what is higher than the limit was an object before. Each character is
/// a height in metres: a digit, a dot without a point, and in upper case what is no connected ground (A: 1).
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
    /// What is still ground: #.
    [[nodiscard]] Drawing left(double largest = any_length) const {
        Grid<std::uint8_t> mask = ground;
        remove_enclosed_by_walls(surface, limits, {}, largest, mask);
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
    // By 2.4 m: 3.6 m are the third step.
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
    // A wall above, none below: half of what is known, whatever the gaps on both sides hide.
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
    remove_enclosed_by_walls({}, {}, {}, any_length, none);
    EXPECT_EQ(none.size(), 0U);
}

}  // namespace
}  // namespace d2b::ground
