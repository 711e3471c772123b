#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/random_grid.hpp"

namespace d2b::contours {
namespace {

using test::nodata;

/// Labels in blocks of random sizes, so that footprints have holes and touch each other.
test::TraceGrid labelled_noise(unsigned seed) {
    std::mt19937 random(seed);
    test::TraceGrid grid = test::random_grid(2 * seed, 18, false).grid;
    grid.labels.assign(grid.z.size(), 0);
    for (Label label = 1; label <= 3; ++label)
        for (std::size_t i = 0; i < grid.z.size(); ++i)
            if (random() % 3 != 0)
                grid.labels[i] = label;
    return grid;
}

LevelPlan footprint_plan(double ground) {
    return {0, {{}, {ground, 0.5, 1.5}, {ground, 1.5}, {ground}}, true};
}

/// Points that are not valid change sums, not outlines: the same grid with a low elevation in their place has
/// the same contours.
TEST(Footprints, AreWholeWherePointsAreNotValid) {
    std::int64_t missing = 0;
    for (unsigned seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        const test::TraceGrid grid = labelled_noise(seed);
        test::TraceGrid filled = grid;
        for (std::size_t i = 0; i < filled.z.size(); ++i)
            if (std::isnan(filled.z[i]) && filled.labels[i] != 0)
                filled.z[i] = -1;
        Context context;
        const test::ContourSet found =
            test::trace_plan(grid, footprint_plan(-9), {TraceMode::cells}, context);
        const test::ContourSet expected =
            test::trace_plan(filled, footprint_plan(-9), {TraceMode::cells}, context);
        ASSERT_EQ(found.contours.size(), expected.contours.size());
        for (std::size_t i = 0; i < found.contours.size(); ++i) {
            const Contour& contour = found.contours[i];
            EXPECT_EQ(contour.key, expected.contours[i].key);
            EXPECT_EQ(contour.label, expected.contours[i].label);
            EXPECT_EQ(contour.parent, expected.contours[i].parent);
            EXPECT_EQ(test::squares_inside(contour), test::squares_inside(expected.contours[i]));
            EXPECT_GE(expected.contours[i].own.n, contour.own.n);
            EXPECT_TRUE(contour.own.n == 0 || contour.own.lowest >= 0);  // no -1 is among them
            missing += expected.contours[i].own.n - contour.own.n;
        }
    }
    EXPECT_GT(missing, 500);
}

/// A footprint is a connected piece of its label, whatever its elevations.
TEST(Footprints, AreThePiecesOfTheirLabel) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const test::TraceGrid grid = labelled_noise(seed);
        Context context;
        const test::ContourSet set = test::trace_plan(grid, footprint_plan(1e9), {TraceMode::cells}, context);
        std::size_t covered = 0;
        for (const Contour& contour : set.contours) {
            if (contour.key.level != 1)
                continue;
            const std::set<LatticePoint> squares = test::squares_inside(contour);
            covered += squares.size();
            for (const LatticePoint s : squares) {
                EXPECT_EQ(grid.label(s.row, s.col), contour.label);
                for (const LatticePoint n : {LatticePoint{s.row + 1, s.col}, {s.row, s.col + 1}})
                    if (n.row < grid.rows && n.col < grid.cols && grid.label(n.row, n.col) == contour.label) {
                        EXPECT_EQ(squares.count(n), 1U);  // nothing of the piece is left out
                    }
            }
        }
        std::size_t labelled = 0;
        for (const Label label : grid.labels)
            labelled += label != 0 ? 1 : 0;
        EXPECT_EQ(covered, labelled) << seed;
    }
}

TEST(Footprints, DoNotCountPointsThatAreNotValid) {
    test::TraceGrid grid{4, 5, std::vector<double>(20, 3.0), std::vector<Label>(20, 0)};
    for (const std::size_t i : {6U, 7U, 8U, 11U, 12U, 13U})
        grid.labels[i] = 1;
    grid.z[6] = 8;
    grid.z[12] = nodata;
    Context context;
    const test::ContourSet set = test::trace_plan(grid, {3, {{}, {2, 5}}, true}, {TraceMode::cells}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[0].own.n, 14);
    EXPECT_EQ(set.contours[1].squares(), 6);
    EXPECT_EQ(set.contours[1].own.n, 4);
    EXPECT_EQ(set.contours[2].own.n, 1);
    EXPECT_EQ(set.roofs[0].percentiles[0], 3);  // of 8 and four times 3
}

}  // namespace
}  // namespace d2b::contours
