#include <gtest/gtest.h>

#include "detect/threshold_scale.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

/// Ground, and from column 10 on a roof 6 m above it, over a ramp of so many cells.
MetreGrid wall(std::int32_t ramp) {
    MetreGrid surface(20, 30, 100.0F);
    for (std::int32_t r = 0; r < 20; ++r)
        for (std::int32_t c = 10 - ramp; c < 30; ++c)
            surface.at(r, c) =
                100 + 6 * std::min(1.0F, static_cast<float>(c - (9 - ramp)) / static_cast<float>(ramp + 1));
    return surface;
}

double sharpness_of(const MetreGrid& surface) {
    Mask roof(20, 30);
    for (std::int32_t r = 0; r < 20; ++r)
        std::fill(roof.row(r).begin() + 10, roof.row(r).end(), std::uint8_t{1});
    return step_sharpness(surface, roof, test::threads());
}

TEST(StepSharpness, IsTheShareOfTheFirstCellInThree) {
    EXPECT_EQ(sharpness_of(wall(0)), 1.0);
    EXPECT_NEAR(sharpness_of(wall(1)), 1.0 / 2, 1e-3);
    EXPECT_NEAR(sharpness_of(wall(2)), 1.0 / 3, 1e-3);
    EXPECT_NEAR(sharpness_of(wall(5)), 1.0 / 3, 1e-3) << "farther than three cells it does not look";
}

TEST(StepSharpness, OneWhereNothingFallsOrIsKnown) {
    EXPECT_EQ(sharpness_of(MetreGrid(20, 30, 7.0F)), 1.0);
    EXPECT_EQ(sharpness_of(MetreGrid(20, 30, test::unknown)), 1.0);
    EXPECT_EQ(step_sharpness(MetreGrid(), Mask(), test::threads()), 1.0);
    MetreGrid gaps = wall(0);
    for (std::int32_t r = 0; r < 20; ++r)
        gaps.at(r, 9) = test::unknown;
    EXPECT_EQ(sharpness_of(gaps), 0.0) << "what is not valid is no fall";
}

}  // namespace
}  // namespace d2b
