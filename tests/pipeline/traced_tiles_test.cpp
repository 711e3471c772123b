#include <array>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "pipeline/random_town.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b {
namespace {

using test::expect_same_in_tiles;
using test::MemorySource;
using test::random_town;
using test::Result;

Options thesis(TraceMode trace, int lod) {
    Options options;
    options.preset = Preset::thesis;
    options.trace.mode = trace;
    options.levels.lod = lod;
    return options;
}

class RandomTownTraced : public testing::TestWithParam<unsigned> {};

TEST_P(RandomTownTraced, InTilesIsThatOfOneRun) {
    const unsigned seed = GetParam();
    MemorySource dem = random_town(seed, {270, 330, 60, seed % 3 == 0, seed % 2 == 0});
    test::place_in_utm(dem, 1);
    Options options =
        thesis(seed % 2 == 0 ? TraceMode::points : TraceMode::cells, static_cast<int>(1 + seed % 9));
    options.filter.noise_factor = static_cast<int>(seed % 3 * 8);
    options.outline.disjoint = seed % 4 == 3;
    options.outline.simplify = seed % 5 == 4 ? 1 : 0;
    options.write.rejected = seed % 4 == 1;
    const UnitSize units{0, std::array{64, 90, 150, 300}[seed % 4]};
    Result whole;
    expect_same_in_tiles(
        {dem}, options, units,
        {std::array{1, 2, 5}[seed % 3], seed % 2 == 1, seed % 5 == 0, 1 + static_cast<int>(seed % 2)}, whole);
    EXPECT_GT(whole.report.contours, 5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTownTraced, testing::Range(0U, 12U));

/// Elevations that differ from cell to cell, so that contours touch themselves and each other everywhere.
MemorySource rough(int rows, int cols, unsigned seed) {
    std::vector<double> z;
    unsigned state = seed * 2654435761U + 1;
    for (int i = 0; i < rows * cols; ++i) {
        state = state * 1664525U + 1013904223U;
        z.push_back(state >> 28 == 0 ? std::nan("") : (state >> 20 & 15U) + 0.1);
    }
    return {rows, cols, z};
}

TEST(TracedTiles, OfContoursThatTouchAtEverySeam) {
    for (const TraceMode trace : {TraceMode::points, TraceMode::cells})
        for (const unsigned seed : {1U, 2U}) {
            SCOPED_TRACE(seed);
            MemorySource dem = rough(24, 31, seed);
            test::place_in_utm(dem, 1);
            Options options = thesis(trace, 3);
            options.filter.noise_factor = 0;
            // No tile has less than half of these rows and columns.
            for (const std::int32_t side : {5, 9}) {
                Result whole;
                expect_same_in_tiles({dem}, options, {0, side}, {1 + side % 2}, whole);
                EXPECT_GE(whole.report.contours, 50);
            }
        }
}

TEST(TracedTiles, OfOneColumnAndOfNothing) {
    const std::vector<double> nothing(9000, std::nan(""));
    for (const auto& [rows, cols, z] :
         {std::tuple{140, 1, std::vector<double>(140, 5)}, std::tuple{1, 140, std::vector<double>(140, 5)},
          std::tuple{90, 100, nothing}}) {
        MemorySource dem(rows, cols, z);
        test::place_in_utm(dem, 1);
        for (const TraceMode trace : {TraceMode::points, TraceMode::cells}) {
            Result whole;
            expect_same_in_tiles({dem}, thesis(trace, 3), {0, 64}, {1}, whole);
        }
    }
}

}  // namespace
}  // namespace d2b
