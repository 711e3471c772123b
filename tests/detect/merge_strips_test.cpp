#include "detect/merge_strips.hpp"

#include <gtest/gtest.h>

#include "detect/label_rows.hpp"

namespace d2b {
namespace {

SeenObject seen(double confidence, std::int64_t own_cells) {
    return {{confidence, Doubt::rough, 1000}, confidence >= 0.5, 100 * confidence, own_cells};
}

using Row = std::vector<Label>;

TEST(StripMerger, OneStripIsAsItWas) {
    StripMerger merger;
    const std::vector<SeenObject> objects{seen(0.9, 10), seen(0.8, 20), seen(0.2, 30)};
    EXPECT_EQ(merger.add(objects), 0U);
    const StripMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.buildings, 2U);
    ASSERT_EQ(merged.objects.size(), 3U);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 3}));
    EXPECT_EQ(merged.objects[1].object.confidence, 0.8);
    EXPECT_EQ(merged.objects[1].object.cells, 20);
}

TEST(StripMerger, WhoOwnsMoreOfItSaysWhatItIs) {
    StripMerger merger;
    EXPECT_EQ(merger.add(std::vector{seen(0.3, 10), seen(0.9, 4)}), 0U);
    EXPECT_EQ(merger.add(std::vector{seen(0.7, 90), seen(0.1, 80)}), 2U);
    merger.compare(Row{0, 1, 1, 1, 0, 2, 2}, Row{0, 3, 3, 3, 0, 4, 4});
    const StripMerger::Merged merged = merger.finish(1);
    ASSERT_EQ(merged.objects.size(), 2U);
    EXPECT_EQ(merged.buildings, 1U);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 1, 2}));
    EXPECT_EQ(merged.objects[0].object.confidence, 0.7);
    EXPECT_EQ(merged.objects[0].own_cells, 100);
    EXPECT_EQ(merged.objects[1].object.confidence, 0.1);
    EXPECT_EQ(merged.objects[1].own_cells, 84);
}

TEST(StripMerger, AFewCellsOfANeighbourDoNotJoinIt) {
    StripMerger merger;
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 50)});
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 50)});
    // The border between the two lies a cell farther to the right in the lower strip.
    merger.compare(Row{1, 1, 1, 1, 2, 2, 2, 2}, Row{3, 3, 3, 3, 3, 4, 4, 4});
    const StripMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.number, (Row{0, 1, 2, 1, 2}));
}

TEST(StripMerger, SetsGrowOverSeveralSeams) {
    StripMerger merger;
    for (int strip = 0; strip < 3; ++strip)
        merger.add(std::vector{seen(0.9, 20), seen(0.8, 10)});
    merger.compare(Row{1, 0, 2}, Row{3, 0, 3});  // a courtyard is open above
    merger.compare(Row{3, 3, 0}, Row{5, 5, 0});
    const StripMerger::Merged merged = merger.finish(1);
    EXPECT_EQ(merged.number, (Row{0, 1, 1, 1, 2, 1, 3}));
    EXPECT_EQ(merged.objects[0].own_cells, 20 + 10 + 20 + 20);
}

TEST(StripMerger, SliversAreLeftOut) {
    StripMerger merger;
    merger.add(std::vector{seen(0.9, 50), seen(0.9, 0), seen(0.9, 9)});
    const StripMerger::Merged merged = merger.finish(10);
    EXPECT_EQ(merged.number, (Row{0, 1, 0, 0}));
    EXPECT_EQ(merged.objects.size(), 1U);
}

TEST(LabelRows, ComeBackWithOtherNumbers) {
    LabelRows rows(std::make_unique<MemorySpool>());
    Grid<Label> grid(6, 5);
    grid.values = {9, 9, 9, 9, 9, 0, 1, 1, 2, 0, 0, 0, 0, 0, 0, 3, 3, 3, 3, 3, 2, 0, 2, 0, 1, 9, 9, 9, 9, 9};
    Executor threads(2);
    rows.append(grid, {1, 3}, threads);
    rows.append(grid, {3, 5}, threads);
    rows.renumber({0, 7, 0, 9});
    Row all(20, 77);
    rows.read(0, 5, all);
    EXPECT_EQ(all, (Row{0, 7, 7, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9, 9, 9, 0, 0, 0, 0, 7}));
    Row last(10, 77);
    rows.read(2, 5, last);
    EXPECT_EQ(last, (Row{9, 9, 9, 9, 9, 0, 0, 0, 0, 7}));
}

}  // namespace
}  // namespace d2b
