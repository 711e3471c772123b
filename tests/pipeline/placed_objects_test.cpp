#include <gtest/gtest.h>

#include "pipeline/tiles/join_tiles.hpp"

namespace d2b::tiles {
namespace {

using Labels = std::vector<Label>;

/// @param boxes that the objects fill
FoundUnit found_unit(std::vector<detect::SeenObject> objects, const std::vector<Window>& boxes,
                     detect::UnitEdges edges) {
    std::vector<LabelRun> runs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::int32_t row = boxes[i].row; row < boxes[i].end_row(); ++row)
            runs.push_back({row, boxes[i].col, boxes[i].end_col(), static_cast<Label>(i + 1)});
    return {std::move(objects), std::move(runs), std::move(edges)};
}

/// Two units side by side, each a tile, of 100 rows. Unit 0 has a building at the seam (label 2) and one
/// that lies alone (1); unit 1 sees the first as well (1), owns more of it, and has another alone (2).
class TwoTiles : public testing::Test {
  protected:
    TwoTiles() {
        detect::UnitEdges right;
        right.left = {Labels{0, 1, 1}, Labels{0, 1, 1}};
        detect::UnitEdges left;
        left.right = {Labels{0, 2, 2}, Labels{0, 2, 2}};
        // The later unit comes first, as it does where tiles have several rows of units.
        put(1, {seen(60), seen(40)}, {{0, 100, 10, 6}, {50, 150, 5, 8}}, right);
        put(0, {seen(25), seen(30)}, {{80, 10, 5, 5}, {0, 94, 10, 6}}, left);
        seams.compare_known();
        detect::UnitMerger::Merged merged = seams.merger().finish(1);
        placed.place(seams.take(), std::move(merged));
    }
    static detect::SeenObject seen(std::int64_t own_cells) {
        return {{0.9, detect::CounterEvidence::rough, own_cells}, true, 7, own_cells};
    }
    void put(std::int64_t unit, std::vector<detect::SeenObject> objects, const std::vector<Window>& boxes,
             detect::UnitEdges edges) {
        FoundUnit found = found_unit(std::move(objects), boxes, std::move(edges));
        Tally left_out;
        const UnitObjects divided = divide_objects(found, {}, left_out);
        interior.put(unit, divided);
        seams.put(unit, std::move(found), divided);
        seams.compare_known();
    }

    detect::UnitGrid units{Window{0, 0, 100, 200}, CellSize{1, 1}, 64, detect::UnitSize{0, 100}};
    TileGrid tiles{units, 1};
    InteriorObjects interior{std::make_unique<MemorySpool>(), 2};
    BorderObjects seams{2, 2};
    ObjectAssignment placed{tiles, interior, seams};
};

TEST_F(TwoTiles, TheTileWithMostOfItDrawsWhatLiesAtTheSeam) {
    ASSERT_EQ(tiles.count(), 2);
    const std::vector<AssignedObject> left = placed.of(0);
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].seen.own_cells, 25);
    EXPECT_EQ(left[0].joined, AssignedObject::none);

    // Objects in the order of the units that saw them first, with all cells and a box around both parts.
    const std::vector<AssignedObject> right = placed.of(1);
    ASSERT_EQ(right.size(), 2U);
    EXPECT_EQ(right[0].unit, 0);
    EXPECT_EQ(right[0].label, 2U);
    EXPECT_EQ(right[0].seen.own_cells, 90);
    EXPECT_EQ(right[0].box, (Window{0, 94, 10, 12}));
    EXPECT_EQ(right[1].unit, 1);
    EXPECT_EQ(right[1].label, 2U);
}

TEST_F(TwoTiles, WhatAnotherTileDrawsIsOneMoreThanTheBuildings) {
    EXPECT_EQ(placed.map_labels(0, placed.of(0)).number, (Labels{0, 1, 2}));
    EXPECT_EQ(placed.map_labels(1, placed.of(0)).number, (Labels{0, 2, 2}));
    EXPECT_EQ(placed.map_labels(0, placed.of(1)).number, (Labels{0, 3, 1}));
    EXPECT_EQ(placed.map_labels(1, placed.of(1)).number, (Labels{0, 1, 2}));
}

/// A part is known by a part of the same whole at the seam, even if another tile draws that one, and
/// otherwise by its unit; an object that is alone in its unit is a part of nothing.
TEST(ObjectAssignment, NamesWholesAcrossSeams) {
    detect::UnitGrid units{Window{0, 0, 100, 200}, CellSize{1, 1}, 64, detect::UnitSize{0, 100}};
    TileGrid tiles{units, 1};
    InteriorObjects interior{std::make_unique<MemorySpool>(), 2};
    BorderObjects seams{2, 2};
    ObjectAssignment placed{tiles, interior, seams};
    const auto seen = [](Label whole) {
        return detect::SeenObject{{0.9, detect::CounterEvidence::rough, 20, -1, whole}, true, 7, 20};
    };
    const auto put = [&](std::int64_t unit, std::vector<detect::SeenObject> objects,
                         detect::UnitEdges edges) {
        const std::vector<Window> boxes(objects.size(), Window{0, unit == 0 ? 0 : 100, 5, 4});
        FoundUnit found = found_unit(std::move(objects), boxes, std::move(edges));
        Tally uncounted;
        const UnitObjects divided = divide_objects(found, {}, uncounted);
        interior.put(unit, divided);
        seams.put(unit, std::move(found), divided);
        seams.compare_known();
    };
    detect::UnitEdges left;
    left.right = {Labels{0, 1, 1}, Labels{0, 1, 1}};
    detect::UnitEdges right;
    right.left = {Labels{0, 2, 2}, Labels{0, 2, 2}};
    put(0, {seen(1), seen(1), seen(3), seen(3), seen(5)}, left);
    put(1, {seen(2), seen(2), seen(3), seen(3), seen(4)}, right);
    detect::UnitMerger::Merged merged = seams.merger().finish(1);
    placed.place(seams.take(), std::move(merged));

    std::vector<std::int64_t> wholes;
    for (const std::int64_t tile : {0, 1})
        for (const AssignedObject& object : placed.of(tile))
            wholes.push_back(object.whole);
    // The object at the seam, the part beside it in unit 0, two parts that only unit 0 sees, one alone; then
    // the part in unit 1, and the same again.
    const std::int64_t seam = wholes.at(0);
    EXPECT_GT(seam, 0);
    ASSERT_EQ(wholes.size(), 9U);
    EXPECT_EQ(wholes[1], seam);
    EXPECT_LT(wholes[2], 0);
    EXPECT_EQ(wholes[3], wholes[2]);
    EXPECT_EQ(wholes[4], 0);
    EXPECT_EQ(wholes[5], seam);
    EXPECT_LT(wholes[6], 0);
    EXPECT_NE(wholes[6], wholes[2]);
    EXPECT_EQ(wholes[7], wholes[6]);
    EXPECT_EQ(wholes[8], 0);
}

}  // namespace
}  // namespace d2b::tiles
