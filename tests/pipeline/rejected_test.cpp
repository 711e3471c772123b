#include <map>

#include <gtest/gtest.h>

#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::MadeTown;
using test::MemorySink;
using test::MemorySource;
using test::TownRun;

constexpr std::size_t rejected = 2;  // after buildings and contours

std::map<std::string, int> reasons(const MemorySink& sink) {
    std::map<std::string, int> counts;
    for (std::size_t i = 0; i < sink.features[rejected].size(); ++i)
        ++counts[std::get<std::string>(sink.value(rejected, i, "reason"))];
    return counts;
}

void expect_all_are_there(const MemorySink& sink, const RunReport& report) {
    std::map<std::string, int> counts = reasons(sink);
    for (const Reason reason : {Reason::contour_short, Reason::contour_small, Reason::contour_on_dropped,
                                Reason::hole_short, Reason::hole_small, Reason::polygon_repaired}) {
        const auto name = std::string(reason_names[static_cast<std::size_t>(reason)]);
        EXPECT_EQ(counts[name], report.counted(reason)) << name;
    }
}

/// 16 x 16 cells of 0. A plate of 10 x 10 cells at 20 has a pit of a cell and one of 4 x 4 cells; on it
/// stands a cell at 40; beside it a cell at 20.
MemorySource plate() {
    std::vector<double> z(256, 0);
    const auto set = [&](int row, int col, int rows, int cols, double value) {
        for (int r = row; r < row + rows; ++r)
            for (int c = col; c < col + cols; ++c)
                z[static_cast<std::size_t>(r * 16 + c)] = value;
    };
    set(2, 2, 10, 10, 20);
    set(3, 3, 1, 1, 0);
    set(6, 6, 4, 4, 0);
    set(4, 10, 1, 1, 40);
    set(14, 14, 1, 1, 20);
    return {16, 16, z};
}

TEST(Rejected, WhatTheFilterTookIsThereAsItWasTraced) {
    MemorySource source = plate();
    Options options = test::cells({10, 30});
    options.filter.noise_factor = 10;
    options.write.rejected = true;
    MemorySink sink;
    const RunReport report = run(options, {source}, {sink});
    ASSERT_EQ(sink.layers.size(), 3U);
    EXPECT_EQ(sink.layers[rejected].name, "rejected");
    EXPECT_EQ(sink.layers[rejected].title, "Rejected");
    EXPECT_EQ(reasons(sink), (std::map<std::string, int>{{"contour_short", 2}, {"hole_short", 1}}));
    expect_all_are_there(sink, report);
    // In the order of keys: level 1, the hole in the plate before the cell below it; then level 2.
    const std::array<Position, 3> low{Position{3, -4}, {14, -15}, {10, -5}};
    const std::array<std::int64_t, 3> level{1, 1, 2};
    for (std::size_t i = 0; i < 3; ++i) {
        const Feature& feature = sink.features[rejected][i];
        EXPECT_EQ(sink.value(rejected, i, "id"), FieldValue{static_cast<std::int64_t>(i + 1)});
        EXPECT_EQ(sink.value(rejected, i, "level"), FieldValue{level[i]});
        EXPECT_EQ(sink.value(rejected, i, "building"), FieldValue{});
        EXPECT_EQ(sink.value(rejected, i, "contour"), FieldValue{});
        EXPECT_EQ(sink.number(rejected, i, "area_m2"), 1);
        EXPECT_EQ(sink.number(rejected, i, "perim_m"), 4);
        ASSERT_EQ(feature.parts.size(), 1U);
        const auto [x, y] = low[i];
        EXPECT_EQ(feature.parts[0].exterior, (WorldRing{{x, y + 1}, {x, y}, {x + 1, y}, {x + 1, y + 1}}))
            << i;
    }
}

TEST(Rejected, WhatStandsOnNoiseIsThereToo) {
    // A block of 4 x 4 passes 16 points; an E of ten cells on it passes 22.
    std::vector<double> z(36, 0.0);
    for (int row = 1; row <= 4; ++row)
        for (int col = 1; col <= 4; ++col)
            z[static_cast<std::size_t>(row * 6 + col)] = col == 1 || row == 1 || row == 3 ? 30 : 20;
    MemorySource source(6, 6, z);
    Options options = test::cells({10, 25});
    options.filter.noise_factor = 17;
    options.write.rejected = true;
    MemorySink sink;
    const RunReport report = run(options, {source}, {sink});
    EXPECT_EQ(reasons(sink), (std::map<std::string, int>{{"contour_short", 1}, {"contour_on_dropped", 1}}));
    EXPECT_EQ(sink.number(rejected, 0, "area_m2"), 16);
    EXPECT_EQ(sink.number(rejected, 1, "area_m2"), 10);
}

TEST(Rejected, OutlinesThatStayAsTracedNameWhatTheyAreOf) {
    TownRun town;
    town.options.write.rejected = true;
    town.options.levels.lod = 6;
    town.options.filter.noise_factor = 4;
    town.options.outline.wall_tolerance = 0.2;  // no wall comes so near to a staircase
    town.run();
    expect_all_are_there(town.sink, town.report);
    int kept = 0;
    for (const std::size_t layer : {test::buildings, test::contours})
        for (std::size_t i = 0; i < town.count(layer); ++i) {
            if (town.sink.value(layer, i, "status") != FieldValue{std::string("kept_traced")})
                continue;
            ++kept;
            const char* field = layer == test::buildings ? "building" : "contour";
            const FieldValue id = town.sink.value(layer, i, "id");
            std::size_t found = 0;
            for (std::size_t k = 0; k < town.count(rejected); ++k)
                if (town.sink.value(rejected, k, field) == id) {
                    ++found;
                    EXPECT_EQ(town.sink.value(rejected, k, "reason"),
                              FieldValue{std::string("outline_kept_traced")});
                }
            EXPECT_EQ(found, 1U) << field << ' ' << i;
        }
    EXPECT_GT(kept, 0);
    EXPECT_EQ(town.report.counted(Reason::outline_kept_traced), kept);
}

TEST(Rejected, IsNotThereUnlessItIsAskedFor) {
    TownRun town;
    town.run();
    EXPECT_EQ(town.sink.layers.size(), 2U);
}

}  // namespace
}  // namespace d2b
