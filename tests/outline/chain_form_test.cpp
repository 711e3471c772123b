#include <gtest/gtest.h>

#include "outline/walls/chain_fitter.hpp"

namespace d2b::outline {
namespace {

std::vector<FitMode> modes_of(const ChainFitMode& mode, std::size_t steps) {
    std::vector<FitMode> modes;
    for (std::size_t step = 0; step < steps; ++step)
        modes.push_back(mode.at(step));
    return modes;
}

constexpr FitMode regularized = FitMode::regularized;
constexpr FitMode midpoint = FitMode::midpoint;
constexpr FitMode beveled = FitMode::beveled;

TEST(ChainFitMode, FollowsCloserWhereItIsAskedToWithAMargin) {
    ChainFitMode mode(8, false);
    EXPECT_TRUE(mode.tighten(3, 4, 1));
    EXPECT_EQ(modes_of(mode, 8), (std::vector<FitMode>{regularized, regularized, midpoint, midpoint, midpoint,
                                                       regularized, regularized, regularized}));
    // The margin does not go beyond an open chain's ends.
    EXPECT_TRUE(mode.tighten(7, 8, 2));
    EXPECT_EQ(modes_of(mode, 8), (std::vector<FitMode>{regularized, regularized, midpoint, midpoint, midpoint,
                                                       midpoint, midpoint, midpoint}));
    EXPECT_TRUE(mode.has_walls());
}

TEST(ChainFitMode, BringsTheLeastCloseStepsToTheNextForm) {
    ChainFitMode mode(6, false);
    EXPECT_TRUE(mode.raise(2, 3, 0, FitMode::tight));
    EXPECT_TRUE(mode.tighten(1, 4, 0));
    EXPECT_EQ(modes_of(mode, 6), (std::vector<FitMode>{regularized, midpoint, FitMode::tight, midpoint,
                                                       regularized, regularized}));
    EXPECT_EQ(mode.least(1, 4), midpoint);
    EXPECT_EQ(mode.least(2, 3), FitMode::tight);
}

TEST(ChainFitMode, EndsWithTheTraceCut) {
    ChainFitMode mode(4, true);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(mode.tighten(0, 4, 0));
    EXPECT_FALSE(mode.tighten(0, 4, 0));
    EXPECT_FALSE(mode.has_walls());
    EXPECT_EQ(modes_of(mode, 4), (std::vector<FitMode>{beveled, beveled, beveled, beveled}));
}

TEST(ChainFitMode, GoesRoundAClosedChain) {
    ChainFitMode mode(10, true);
    EXPECT_TRUE(mode.raise(9, 11, 1, beveled));  // 8 .. 11
    EXPECT_EQ(modes_of(mode, 10),
              (std::vector<FitMode>{beveled, beveled, regularized, regularized, regularized, regularized,
                                    regularized, regularized, beveled, beveled}));
    EXPECT_TRUE(mode.beveled_around(0));
    EXPECT_TRUE(mode.beveled_around(1));
    EXPECT_FALSE(mode.beveled_around(2));
    EXPECT_FALSE(mode.beveled_around(8));
    const auto stretches = mode.stretches();
    ASSERT_EQ(stretches.size(), 2U);
    EXPECT_EQ(stretches[0].first, 2U);
    EXPECT_EQ(stretches[0].last, 8U);
    EXPECT_EQ(stretches[0].mode, regularized);
    EXPECT_EQ(stretches[1].last, 12U);
    EXPECT_EQ(stretches[1].mode, beveled);
}

TEST(ChainFitMode, LeavesOutWallsThatAreTooShortBetweenOthers) {
    ChainFitMode mode(20, false);
    EXPECT_TRUE(mode.raise(5, 8, 0, midpoint));
    EXPECT_TRUE(mode.raise(11, 14, 0, midpoint));  // three steps of walls between
    const auto stretches = mode.stretches();
    ASSERT_EQ(stretches.size(), 3U);
    EXPECT_EQ(stretches[1].first, 5U);
    EXPECT_EQ(stretches[1].last, 14U);
    EXPECT_EQ(stretches[1].mode, midpoint);
}

}  // namespace
}  // namespace d2b::outline
