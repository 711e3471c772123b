#include <map>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/random_grid.hpp"

namespace d2b::contours {
namespace {

using test::TraceGrid;
using test::TraceSettings;

/// A contour by its area: level, squares, and the squares of its parent.
using Shape = std::tuple<int, std::set<LatticePoint>, std::set<LatticePoint>, std::int64_t, double>;

std::multiset<Shape> shapes(const test::ContourSet& set,
                            const std::function<LatticePoint(LatticePoint)>& move) {
    const auto moved = [&](const Contour& contour) {
        std::set<LatticePoint> squares;
        for (const LatticePoint square : test::squares_inside(contour))
            squares.insert(move(square));
        return squares;
    };
    std::multiset<Shape> result;
    for (const Contour& contour : set.contours)
        result.emplace(contour.key.level, moved(contour),
                       contour.parent < 0 ? std::set<LatticePoint>{}
                                          : moved(set.contours[static_cast<std::size_t>(contour.parent)]),
                       contour.exterior.points(), contour.lowest_outside);
    return result;
}

LatticePoint unmoved(LatticePoint square) {
    return square;
}

TraceGrid rotated(const TraceGrid& grid) {
    TraceGrid result{grid.cols, grid.rows, {}, {}};
    for (int row = 0; row < result.rows; ++row)
        for (int col = 0; col < result.cols; ++col) {
            result.z.push_back(grid.at(grid.rows - 1 - col, row));
            if (!grid.labels.empty())
                result.labels.push_back(grid.label(grid.rows - 1 - col, row));
        }
    return result;
}

TraceGrid flipped(const TraceGrid& grid) {
    TraceGrid result{grid.rows, grid.cols, {}, {}};
    for (int row = 0; row < grid.rows; ++row)
        for (int col = 0; col < grid.cols; ++col) {
            result.z.push_back(grid.at(row, grid.cols - 1 - col));
            if (!grid.labels.empty())
                result.labels.push_back(grid.label(row, grid.cols - 1 - col));
        }
    return result;
}

TraceGrid padded(const TraceGrid& grid, int top, int left, int bottom, int right) {
    TraceGrid result{grid.rows + top + bottom, grid.cols + left + right, {}, {}};
    for (int row = 0; row < result.rows; ++row)
        for (int col = 0; col < result.cols; ++col) {
            const int r = row - top;
            const int c = col - left;
            const bool inside = r >= 0 && r < grid.rows && c >= 0 && c < grid.cols;
            result.z.push_back(inside ? grid.at(r, c) : test::nodata);
            if (!grid.labels.empty())
                result.labels.push_back(inside ? grid.label(r, c) : 1);
        }
    return result;
}

class Metamorphic : public testing::TestWithParam<unsigned> {
  protected:
    void SetUp() override {
        case_ = test::random_grid(GetParam());
        settings_.mode = case_.mode;
        settings_.noise_factor = static_cast<int>(GetParam() % 7 * 2);
    }
    test::ContourSet traced(const TraceGrid& grid) { return traced(grid, settings_); }
    test::ContourSet traced(const TraceGrid& grid, const TraceSettings& settings) {
        return test::trace_grid(grid, case_.thresholds, settings, context_);
    }
    /// Squares have one row and column less where they lie between points.
    [[nodiscard]] int less() const { return case_.mode == TraceMode::points ? 1 : 0; }

    test::RandomGridCase case_;
    TraceSettings settings_;
    Context context_;
};

TEST_P(Metamorphic, RotatingChangesOnlyPlaces) {
    const int rows = case_.grid.rows - less();
    const auto back = [&](LatticePoint s) { return LatticePoint{rows - 1 - s.col, s.row}; };
    EXPECT_EQ(shapes(traced(rotated(case_.grid)), back), shapes(traced(case_.grid), unmoved));
}

TEST_P(Metamorphic, FlippingChangesOnlyPlaces) {
    const int cols = case_.grid.cols - less();
    const auto back = [&](LatticePoint s) { return LatticePoint{s.row, cols - 1 - s.col}; };
    EXPECT_EQ(shapes(traced(flipped(case_.grid)), back), shapes(traced(case_.grid), unmoved));
}

TEST_P(Metamorphic, PaddingChangesOnlyPlaces) {
    const auto back = [](LatticePoint s) { return LatticePoint{s.row - 3, s.col - 2}; };
    EXPECT_EQ(shapes(traced(padded(case_.grid, 3, 2, 1, 4)), back), shapes(traced(case_.grid), unmoved));
}

TEST_P(Metamorphic, TheWindowsPlaceIsAddedOnce) {
    TraceSettings there = settings_;
    there.origin = {100, 2000};
    const auto back = [](LatticePoint s) { return LatticePoint{s.row - 100, s.col - 2000}; };
    EXPECT_EQ(shapes(traced(case_.grid, there), back), shapes(traced(case_.grid), unmoved));
}

TEST_P(Metamorphic, BandsOfAnyHeightGiveTheSameBytes) {
    settings_.linked_alone = false;
    const test::ContourSet whole = traced(case_.grid);
    const auto dropped = std::exchange(context_.report.dropped, {});
    for (const auto& [rows, alone] : {std::pair(1, false),
                                      {2, false},
                                      {3, false},
                                      {1, true},
                                      {2, true},
                                      {3, true},
                                      {5, true},
                                      {100, true}}) {
        TraceSettings banded = settings_;
        banded.rows_a_band = rows;
        banded.linked_alone = alone;
        const test::ContourSet set = traced(case_.grid, banded);
        EXPECT_EQ(std::exchange(context_.report.dropped, {}), dropped);
        ASSERT_EQ(set.contours.size(), whole.contours.size());
        for (std::size_t i = 0; i < set.contours.size(); ++i) {
            const Contour& a = set.contours[i];
            const Contour& b = whole.contours[i];
            EXPECT_EQ(a.key, b.key);
            EXPECT_EQ(a.parent, b.parent);
            EXPECT_EQ(a.exterior.corners(), b.exterior.corners());
            ASSERT_EQ(a.interiors.size(), b.interiors.size());
            for (std::size_t k = 0; k < a.interiors.size(); ++k)
                EXPECT_EQ(a.interiors[k].corners(), b.interiors[k].corners());
            EXPECT_TRUE(a.own.sum == b.own.sum && a.above.sum == b.above.sum);
            EXPECT_EQ(a.own.n, b.own.n);
            EXPECT_EQ(a.above.n, b.above.n);
            EXPECT_EQ(a.lowest_outside, b.lowest_outside);
        }
        EXPECT_EQ(set.roofs, whole.roofs);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Metamorphic, testing::Range(1000U, 1060U));

}  // namespace
}  // namespace d2b::contours
