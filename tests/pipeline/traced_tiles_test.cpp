#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <tuple>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "pipeline/random_town.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b {
namespace {

using test::expect_same_in_tiles;
using test::MemorySource;
using test::random_town;
using test::Result;
using test::some_plan;
using test::StepsInTiles;
using test::TemporaryFolder;

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
    if (seed % 6 == 2)
        dem.edit().transform = {600000, 0.8, -0.6, 5800000, -0.6, -0.8};
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

TEST(TracedTiles, OfRotatedGridsDegreesAndWindows) {
    MemorySource dem = random_town(5, {150, 170, 20, true, true});
    dem.edit().transform = {600000, 0.8, -0.6, 5800000, -0.6, -0.8};
    dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    dem.edit().window = {7, 11, 130, 150};
    Result rotated;
    expect_same_in_tiles({dem}, thesis(TraceMode::points, 4), {0, 50}, {1, true}, rotated);
    EXPECT_GT(rotated.report.contours, 5);
    dem.edit().transform = {9, 1.5e-5, 0, 52, 0, -9e-6};
    dem.edit().crs_wkt = Crs("EPSG:4326").wkt();
    Result degrees;
    expect_same_in_tiles({dem}, thesis(TraceMode::cells, 4), {0, 50}, {2}, degrees);
    EXPECT_GT(degrees.report.contours, 5);
}

TEST(TracedTiles, RefuseLinesThatAreDamaged) {
    MemorySource dem = random_town(5, {150, 170, 20, true, true});
    test::place_in_utm(dem, 1);
    const TemporaryFolder folder;
    Result result;
    StepsInTiles steps({dem}, thesis(TraceMode::points, 4), {folder.path(), some_plan, 1, {0, 80}});
    steps.run({1}, result);
    const std::filesystem::path file = folder.path() / "draw" / "1";
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(-1, std::ios::end);
    bytes.put('\x55');
    bytes.close();
    Result again;
    try {
        steps.merge(again);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "'" + file.string() +
                      "' is damaged: its bytes are not those that were written; delete it and run 'draw' of "
                      "tile 1 again.");
    }
    EXPECT_FALSE(again.sink.finished);
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
