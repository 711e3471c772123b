#include "ground/outliers.hpp"

#include <gtest/gtest.h>

#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

AlignedGrid flat(float height) {
    AlignedGrid surface;
    surface.grid = MetreGrid(60, 60, height);
    return surface;
}

int outliers(const AlignedGrid& surface) {
    const MetreGrid limits = outlier_limits(surface, {});
    int found = 0;
    for (std::size_t k = 0; k < limits.size(); ++k)
        found += surface.grid.values[k] < limits.values[k] ? 1 : 0;
    return found;
}

TEST(Outliers, APitIsOne) {
    AlignedGrid surface = flat(30);
    surface.grid.at(20, 20) = 12;
    EXPECT_EQ(outlier_limits(surface, {}).at(20, 20), 25);
    EXPECT_EQ(outliers(surface), 1);
}

TEST(Outliers, AShallowPitIsNone) {
    AlignedGrid surface = flat(30);
    surface.grid.at(20, 20) = 26;
    EXPECT_EQ(outliers(surface), 0);
}

TEST(Outliers, ACourtAmongRoofsIsNone) {
    AlignedGrid surface = flat(30);
    for (std::int32_t i = 10; i < 30; ++i)
        for (std::int32_t j = 10; j < 30; ++j)
            surface.grid.at(i, j) = 45;
    surface.grid.at(16, 16) = 30;  // streets are within reach
    EXPECT_EQ(outliers(surface), 0);
}

TEST(Outliers, AWideHollowIsNone) {
    AlignedGrid surface = flat(30);
    for (std::int32_t i = 20; i < 26; ++i)
        for (std::int32_t j = 20; j < 26; ++j)
            surface.grid.at(i, j) = 20;
    EXPECT_EQ(outliers(surface), 0);
}

TEST(Outliers, APitInTheMiddleOfNothingIsNotKnownToBeOne) {
    AlignedGrid surface = flat(no_value);
    surface.grid.at(20, 20) = 12;
    EXPECT_EQ(outliers(surface), 0);
}

}  // namespace
}  // namespace d2b::ground
