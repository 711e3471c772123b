#include <vector>

#include <gtest/gtest.h>

#include "ground/opening.hpp"

namespace d2b::ground {
namespace {

constexpr std::int16_t highest_step = no_value_of<std::int16_t>;
constexpr std::int16_t lowest_step = -highest_step;

using Steps = std::vector<std::int16_t>;

Steps opened(Steps row, Extremum first, std::int32_t radius) {
    OpeningBuffers<std::int16_t> room;
    open_row(std::span(row), first, radius, room);
    return row;
}

TEST(RowOpening, TakesOffWhatALineDoesNotFitInto) {
    EXPECT_EQ(opened({1, 1, 5, 5, 1, 1, 7, 7, 7, 1}, Extremum::lowest, 1),
              Steps({1, 1, 1, 1, 1, 1, 7, 7, 7, 1}));
}

TEST(RowOpening, FillsWhatALineDoesNotFitIntoTheOtherWayRound) {
    EXPECT_EQ(opened({9, 9, 5, 5, 9, 9, 7, 7, 7, 9}, Extremum::highest, 1),
              Steps({9, 9, 9, 9, 9, 9, 7, 7, 7, 9}));
}

TEST(RowOpening, OfLinesThatAreWideMoreThanARowIsTheLowest) {
    EXPECT_EQ(opened({4, 3, 8, 6}, Extremum::lowest, 20), Steps({3, 3, 3, 3}));
}

TEST(RowOpening, LinesWithoutAValueAreNotTheHighest) {
    EXPECT_EQ(opened({highest_step, highest_step, highest_step, highest_step, 2, 3}, Extremum::lowest, 1),
              Steps({lowest_step, lowest_step, 2, 2, 2, 2}));
    EXPECT_EQ(opened({lowest_step, lowest_step, lowest_step, lowest_step, 2, 3}, Extremum::highest, 1),
              Steps({highest_step, highest_step, 2, 2, 2, 3}));
}

TEST(RowOpening, TurnsNoOtherValues) {
    Steps row{highest_step, lowest_step, 4};
    swap_neutral(std::span(row), Extremum::lowest);
    EXPECT_EQ(row, Steps({lowest_step, lowest_step, 4}));
    swap_neutral(std::span(row), Extremum::highest);
    EXPECT_EQ(row, Steps({highest_step, highest_step, 4}));
}

TEST(RowOpening, GapsStayGaps) {
    const Steps surface{highest_step, 3, highest_step};
    Steps row{1, 2, 3};
    keep_gaps(std::span(surface), std::span(row));
    EXPECT_EQ(row, Steps({highest_step, 2, highest_step}));
}

}  // namespace
}  // namespace d2b::ground
