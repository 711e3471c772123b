#include "core/lattice.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

// An L of three squares: (0,0), (1,0), (1,1); counter-clockwise with y up: down the left side first.
const LatticeRing l_shape{{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};

TEST(PackedRing, GivesItsCornersBack) {
    const PackedRing ring(l_shape);
    EXPECT_EQ(ring.corners(), l_shape);
    EXPECT_EQ(ring.corner_count(), 6U);
    EXPECT_EQ(ring.points(), 8);
    EXPECT_EQ(ring.area(), 3);
    EXPECT_EQ(ring.box().low, (LatticePoint{0, 0}));
    EXPECT_EQ(ring.box().high, (LatticePoint{2, 2}));
}

TEST(PackedRing, StartsAtTheFirstCornerWhateverTheRotation) {
    for (std::size_t shift = 0; shift < l_shape.size(); ++shift) {
        LatticeRing rotated(l_shape.begin() + static_cast<std::ptrdiff_t>(shift), l_shape.end());
        rotated.insert(rotated.end(), l_shape.begin(), l_shape.begin() + static_cast<std::ptrdiff_t>(shift));
        EXPECT_EQ(PackedRing(rotated).corners(), l_shape);
    }
}

TEST(PackedRing, InteriorRingsRunTheOtherWay) {
    const LatticeRing hole{{3, 5}, {3, 9}, {7, 9}, {7, 5}};
    const PackedRing ring(hole);
    EXPECT_EQ(ring.area(), -16);
    EXPECT_EQ(ring.corners(), hole);
}

TEST(PackedRing, KeepsStepsOfEverySize) {
    for (const std::int32_t size : {1, 63, 64, 65, 8191, 8192, 1000000, 2000000000}) {
        const LatticeRing outline{{-5, -7}, {size - 5, -7}, {size - 5, size - 7}, {-5, size - 7}};
        const PackedRing ring(outline);
        EXPECT_EQ(ring.corners(), outline) << size;
        EXPECT_EQ(ring.area(), static_cast<std::int64_t>(size) * size) << size;
        EXPECT_EQ(ring.points(), 4LL * size) << size;
    }
}

TEST(Contains, LooksAtTheSquaresCentre) {
    EXPECT_TRUE(contains(l_shape, {0, 0}));
    EXPECT_TRUE(contains(l_shape, {1, 0}));
    EXPECT_TRUE(contains(l_shape, {1, 1}));
    EXPECT_FALSE(contains(l_shape, {0, 1}));
    EXPECT_FALSE(contains(l_shape, {-1, 0}));
    EXPECT_FALSE(contains(l_shape, {1, 2}));
    EXPECT_FALSE(contains(l_shape, {1, -1}));
}

}  // namespace
}  // namespace d2b
