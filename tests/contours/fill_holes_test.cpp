#include <gtest/gtest.h>

#include "contours/noise.hpp"
#include "dem2buildings/error.hpp"
#include "support/trace_grid.hpp"

namespace d2b::contours {
namespace {

using test::trace_grid;
using test::TraceGrid;

/// Counts the bytes read of it.
class CountingSpool : public MemorySpool {
  public:
    explicit CountingSpool(std::size_t& bytes) : bytes_(bytes) {}
    void read(std::uint64_t begin, std::span<std::byte> bytes) const override {
        bytes_ += bytes.size();
        MemorySpool::read(begin, bytes);
    }

  private:
    std::size_t& bytes_;
};

/// A plateau of 60 on 50 with pits of 5 x 5 cells, so many a side: square holes above 59, which pass 20
/// points, in each of which a comb of the same pit goes down below 55, which passes more.
TraceGrid pits(int side) {
    const int n = 8 * side + 4;
    TraceGrid grid{n, n, std::vector<double>(static_cast<std::size_t>(n * n), 60.0), {}};
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col) {
            double& z = grid.z[static_cast<std::size_t>(row * n + col)];
            const int r = (row - 4) % 8;
            const int c = (col - 4) % 8;
            if (row < 2 || col < 2 || row >= n - 2 || col >= n - 2)
                z = 50;
            else if (row >= 4 && col >= 4 && r < 5 && c < 5)
                z = r % 2 == 0 || c == 0 ? 53 : 57;
        }
    return grid;
}

struct Reading {
    std::size_t bytes = 0;
    std::int64_t filled = 0;
    std::size_t holes = 0;
};

Reading read_of(int side, Context& context, int noise_factor = 30) {
    Reading reading;
    context.make_spool = [&] { return std::make_unique<CountingSpool>(reading.bytes); };
    const test::ContourSet set = trace_grid(pits(side), {55, 59}, {TraceMode::cells, noise_factor}, context);
    reading.filled = context.report.counted(Reason::hole_short);
    for (const Contour& contour : set.contours)
        reading.holes += contour.interiors.size();
    return reading;
}

TEST(FillHoles, StayWhereTheHoleBelowThemRemains) {
    Context context;
    const Reading found = read_of(3, context);
    // The comb passes 36 points and stays, and so does the square around it, which passes 20.
    EXPECT_EQ(found.filled, 0);
    EXPECT_EQ(found.holes, 18U);
    Context other;
    EXPECT_EQ(read_of(3, other, 37).filled, 18);
}

TEST(FillHoles, AContourIsLoadedOnceForAllOfItsHoles) {
    Context context;
    Context other;
    const Reading few = read_of(8, context);
    const Reading many = read_of(16, other);
    EXPECT_EQ(many.holes, 4 * few.holes);
    // Four times the holes are four times the bytes; contours loaded again for each were sixteen times.
    EXPECT_LT(many.bytes, 5 * few.bytes);
}

TEST(FillHoles, WhatLiesInTheBoxOfAHoleNeedNotLieInIt) {
    // A hole like a comb: a back of a row and 40 teeth of a cell. Between the teeth stand contours.
    Context context;
    const std::vector<ContourKey> keys{{1, {0, 0}}, {1, {3, 3}}, {1, {3, 5}}};
    const Hole comb{1, {2, 2}, {2, 2}, {4, 82}, Reason::hole_short};
    const Hole pit{1, {3, 85}, {3, 85}, {4, 86}, Reason::hole_short};
    const auto ring = [](std::size_t hole) {
        if (hole == 1)
            return LatticeRing{{3, 85}, {3, 86}, {4, 86}, {4, 85}};
        LatticeRing result{{2, 2}, {2, 82}, {3, 82}};
        for (int col = 81; col > 2; col -= 2)
            for (const LatticePoint p : {LatticePoint{3, col}, {4, col}, {4, col - 1}, {3, col - 1}})
                result.push_back(p);
        result.resize(result.size() - 1);
        return result;
    };
    const std::vector<bool> filled = fill_holes(keys, std::vector{comb, pit}, ring, context);
    EXPECT_EQ(filled, std::vector<bool>(2, true));
    // One in a tooth keeps the hole.
    const std::vector<ContourKey> in_a_tooth{{1, {0, 0}}, {1, {3, 2}}};
    EXPECT_FALSE(fill_holes(in_a_tooth, std::vector{comb}, ring, context)[0]);
}

TEST(FillHoles, AskWhetherToStop) {
    Context context;
    int asked = 0;
    context.stop = [&] { return ++asked > 40; };
    EXPECT_THROW(read_of(8, context), Cancelled);
}

}  // namespace
}  // namespace d2b::contours
