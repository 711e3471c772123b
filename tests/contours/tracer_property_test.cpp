#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/random_grid.hpp"

namespace d2b::contours {
namespace {

using test::TraceSettings;

std::set<LatticePoint> distinct(const LatticeRing& ring) {
    return {ring.begin(), ring.end()};
}

void expect_simple_and_compressed(const LatticeRing& ring) {
    EXPECT_EQ(distinct(ring).size(), ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const LatticePoint a = ring[i];
        const LatticePoint b = ring[(i + 1) % ring.size()];
        const LatticePoint c = ring[(i + 2) % ring.size()];
        EXPECT_NE(a.row == b.row, a.col == b.col);
        EXPECT_NE(a.row == b.row, b.row == c.row);
    }
}

class RandomGrid : public testing::TestWithParam<unsigned> {};

TEST_P(RandomGrid, EqualsTheReference) {
    for (unsigned seed = GetParam() * 100; seed < GetParam() * 100 + 100; ++seed) {
        SCOPED_TRACE(seed);
        const test::RandomGridCase c = test::random_grid(seed);
        Context context;
        TraceSettings settings;
        settings.mode = c.mode;
        settings.rows_a_band = 1 + static_cast<std::int32_t>(seed % 15);
        settings.linked_alone = seed % 4 != 0;
        const test::ContourSet set = test::trace_grid(c.grid, c.thresholds, settings, context);
        const auto expected = test::reference_contours(c.grid, c.thresholds, c.mode);
        ASSERT_EQ(set.contours.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const Contour& contour = set.contours[i];
            EXPECT_EQ(contour.key, (ContourKey{expected[i].level, *expected[i].squares.begin()}));
            EXPECT_EQ(test::squares_inside(contour), expected[i].squares);
            EXPECT_EQ(contour.squares(), static_cast<std::int64_t>(expected[i].squares.size()));
            EXPECT_EQ(contour.exterior.points(), expected[i].exterior_points);
            EXPECT_EQ(contour.interiors.size(), expected[i].interiors);
            if (expected[i].level > 0) {
                EXPECT_EQ(set.contours[static_cast<std::size_t>(contour.parent)].key,
                          (ContourKey{expected[i].level - 1, expected[i].parent_first}));
            } else {
                EXPECT_EQ(contour.parent, -1);
            }
            expect_simple_and_compressed(contour.exterior.corners());
            for (const PackedRing& ring : contour.interiors) {
                EXPECT_LT(ring.area(), 0);
                expect_simple_and_compressed(ring.corners());
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGrid, testing::Range(0U, 20U));

}  // namespace
}  // namespace d2b::contours
