#include "detect/morphology.hpp"

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::drawing;
using test::drawn;

using Offsets = std::vector<std::pair<std::int32_t, std::int32_t>>;  // rows down, columns to the right

Offsets offsets_within(double radius, const CellSize& cell) {
    if (radius < cell.across || radius < cell.down)
        return {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    Offsets result;
    for (std::int32_t r = -40; r <= 40; ++r)
        for (std::int32_t c = -40; c <= 40; ++c)
            if (r * r * cell.down * cell.down + c * c * cell.across * cell.across <= radius * radius + 1e-6)
                result.emplace_back(r, c);
    return result;
}

/// Cells for which `chosen` holds at all offsets; beyond the border are the nearest cells.
Mask where_all(const Mask& mask, const Offsets& offsets, int sign, std::uint8_t value) {
    Mask result(mask.rows, mask.cols);
    for (std::int32_t r = 0; r < mask.rows; ++r)
        for (std::int32_t c = 0; c < mask.cols; ++c) {
            bool all = true;
            for (const auto& [down, right] : offsets)
                all = all && mask.at(std::clamp(r + sign * down, 0, mask.rows - 1),
                                     std::clamp(c + sign * right, 0, mask.cols - 1)) == value;
            result.at(r, c) = all ? 1 : 0;
        }
    return result;
}

Mask opened_by_definition(const Mask& mask, double radius, const CellSize& cell) {
    const Offsets offsets = offsets_within(radius, cell);
    Mask result = where_all(where_all(mask, offsets, 1, 1), offsets, -1, 0);
    for (std::uint8_t& value : result.values)
        value ^= 1;
    return result;
}

TEST(Morphology, OpenedAndErodedByDefinition) {
    std::mt19937 random(5);
    const std::vector<CellSize> sizes{{1, 1}, {0.5, 0.5}, {0.5, 1}, {1, 0.4}, {2, 2}, {1, 1.6}, {0.3, 0.25}};
    for (unsigned i = 0; i < 210; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 30);
        const auto cols = static_cast<std::int32_t>(1 + random() % 40);
        const Mask mask = i % 3 == 0 ? test::random_mask(rows, cols, 95, random)
                                     : test::random_blocks(rows, cols, 30, random);
        const CellSize& cell = sizes[i % sizes.size()];
        for (const double radius : {1.5, 3.0, 1.0}) {
            ASSERT_EQ(drawing(open_mask(mask, radius, cell, test::threads())),
                      drawing(opened_by_definition(mask, radius, cell)))
                << i << " radius " << radius;
            ASSERT_EQ(drawing(erode(mask, radius, cell, test::threads())),
                      drawing(where_all(mask, offsets_within(radius, cell), 1, 1)))
                << i << " radius " << radius;
        }
    }
}

TEST(Morphology, OpeningCutsBridgesAndKeepsHouses) {
    const Mask mask = drawn({"..........",  //
                             ".####.####",  //
                             ".#########",  //
                             ".####.####",  //
                             ".####.####",  //
                             ".....#....",  //
                             ".....#...."});
    EXPECT_EQ(drawing(open_mask(mask, 1.5, {1, 1}, test::threads())), drawing(drawn({"..........",  //
                                                                                     ".####.####",  //
                                                                                     ".####.####",  //
                                                                                     ".####.####",  //
                                                                                     ".####.####",  //
                                                                                     "..........",  //
                                                                                     ".........."})));
    // Two by two cells where a cell is larger than the radius.
    EXPECT_EQ(drawing(open_mask(drawn({"###.", "##..", "...#", "..##"}), 1.5, {2, 2}, test::threads())),
              drawing(drawn({"##..", "##..", "...#", "..##"})))
        << "the corner continues beyond the border";
    EXPECT_EQ(open_mask(Mask(), 1.5, {1, 1}, test::threads()).size(), 0U);
}

TEST(Morphology, DiskOfThreeCells) {
    const Element element = disk_element(1.5, {0.5, 0.5});
    ASSERT_EQ(element.size(), 7U);
    // 3² = 9: half widths are the whole parts of the roots of 9 - down².
    const std::vector<std::int32_t> half{0, 2, 2, 3, 2, 2, 0};
    for (std::size_t i = 0; i < half.size(); ++i) {
        EXPECT_EQ(element[i].down, static_cast<std::int32_t>(i) - 3);
        EXPECT_EQ(element[i].left, -half[i]);
        EXPECT_EQ(element[i].right, half[i]);
    }
}

TEST(Morphology, GrownByNeighbours) {
    std::mt19937 random(6);
    for (int i = 0; i < 100; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 20);
        const auto cols = static_cast<std::int32_t>(1 + random() % 40);
        const Mask within = test::random_mask(rows, cols, 70, random);
        const Mask mask = test::random_mask(rows, cols, 10, random);
        Mask expected = mask;
        for (int step = 0; step < 3; ++step) {
            ASSERT_EQ(drawing(dilate_within(mask, within, step, test::threads())), drawing(expected))
                << i << " step " << step;
            Mask next = expected;
            for (std::int32_t r = 0; r < rows; ++r)
                for (std::int32_t c = 0; c < cols; ++c)
                    for (const auto& [y, x] : {std::pair{r - 1, c}, {r + 1, c}, {r, c - 1}, {r, c + 1}})
                        if (expected.holds(y, x) && expected.at(y, x) != 0 && within.at(r, c) != 0)
                            next.at(r, c) = 1;
            expected = next;
        }
    }
}

}  // namespace
}  // namespace d2b
