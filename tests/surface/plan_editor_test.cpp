#include <vector>

#include <gtest/gtest.h>

#include "surface/partition.hpp"
#include "surface/partition_editor.hpp"

namespace d2b {
namespace {

PartitionContour square(std::int64_t row, std::int64_t col, std::int64_t size) {
    return {{{{row, col}, {row + size, col}, {row + size, col + size}, {row, col + size}}, {}}, -1, 0, 1};
}

PartitionEditor editor_of(const std::vector<PartitionContour>& contours) {
    return PartitionEditor(make_partition(contours).plan);
}

std::uint32_t node_at(const PartitionEditor& editor, FinePoint point) {
    std::uint32_t node = 0;
    while (editor.at(node) != point)
        ++node;
    return node;
}

TEST(PartitionEditor, splitsAndMergesAnEdge) {
    PartitionEditor editor = editor_of({square(0, 0, 100)});
    const auto edge = editor.edge_between(node_at(editor, {0, 0}), node_at(editor, {100, 0}));
    ASSERT_TRUE(edge);
    const auto middle = editor.split(*edge, {50, 1});
    ASSERT_TRUE(middle);
    EXPECT_EQ(editor.plan().edges.size(), 5U);
    EXPECT_EQ(editor.swept(*middle, {0, 0}), 100);
    EXPECT_TRUE(editor.merge(*middle, node_at(editor, {0, 0})));
    EXPECT_EQ(editor.plan().edges.size(), 4U);
    EXPECT_EQ(editor.plan().nodes.size(), 4U);
}

TEST(PartitionEditor, splitsNoEdgeBeyondANeighbour) {
    PartitionEditor editor = editor_of({square(0, 0, 100), square(0, 110, 100)});
    const auto edge = editor.edge_between(node_at(editor, {0, 100}), node_at(editor, {100, 100}));
    ASSERT_TRUE(edge);
    EXPECT_FALSE(editor.split(*edge, {50, 110}));  // on its wall
    EXPECT_FALSE(editor.split(*edge, {50, 150}));  // within it
    EXPECT_TRUE(editor.split(*edge, {50, 109}));
}

/// The way of the edges that follow would be through the house between.
TEST(PartitionEditor, mergesNothingAcrossANeighbour) {
    PartitionEditor editor = editor_of({square(0, 0, 100), square(40, 120, 20), square(0, 160, 100)});
    const std::size_t edges = editor.plan().edges.size();
    EXPECT_FALSE(editor.merge(node_at(editor, {0, 100}), node_at(editor, {100, 160})));
    EXPECT_EQ(editor.plan().edges.size(), edges);
}

/// Two corners and then two more: the wall between them is one, and what lay between is gone.
TEST(PartitionEditor, closesAGap) {
    PartitionEditor editor = editor_of({square(0, 0, 100), square(0, 110, 100)});
    EXPECT_TRUE(editor.merge(node_at(editor, {0, 100}), node_at(editor, {0, 110})));
    EXPECT_TRUE(editor.merge(node_at(editor, {100, 100}), node_at(editor, {100, 110})));
    const auto wall = editor.edge_between(node_at(editor, {0, 110}), node_at(editor, {100, 110}));
    ASSERT_TRUE(wall);
    const PartitionEdge& edge = editor.edges()[*wall];
    EXPECT_NE(edge.left, open_ground);
    EXPECT_NE(edge.right, open_ground);
    EXPECT_NE(edge.left, edge.right);
    EXPECT_EQ(editor.plan().edges.size(), 7U);
}

/// A house of three corners is gone when two of them are one.
TEST(PartitionEditor, takesAwayWhatHasNoArea) {
    PartitionContour triangle{{{{0, 0}, {10, 0}, {10, 10}}, {}}, -1, 0, 1};
    PartitionEditor editor = editor_of({triangle});
    EXPECT_TRUE(editor.merge(node_at(editor, {0, 0}), node_at(editor, {10, 0})));
    EXPECT_TRUE(editor.plan().edges.empty());
}

/// After splits are taken back all is as before, also to what is done next.
TEST(PartitionEditor, takesSplitsBack) {
    PartitionEditor editor = editor_of({square(0, 0, 100), square(0, 110, 100)});
    const PlanarPartition before = editor.plan();
    const auto edge = editor.edge_between(node_at(editor, {0, 100}), node_at(editor, {100, 100}));
    ASSERT_TRUE(edge);
    const std::size_t nodes = editor.nodes().size();
    const auto middle = editor.split(*edge, {70, 100});
    ASSERT_TRUE(middle);
    ASSERT_TRUE(editor.split(*editor.edge_between(*middle, node_at(editor, {100, 100})), {90, 100}));
    ASSERT_TRUE(editor.split(*editor.edge_between(*middle, node_at(editor, {0, 100})), {20, 100}));
    EXPECT_EQ(editor.plan().edges.size(), before.edges.size() + 3);
    editor.undo_splits(nodes);
    EXPECT_EQ(editor.plan().nodes, before.nodes);
    EXPECT_EQ(editor.plan().edges, before.edges);
    EXPECT_TRUE(editor.take_changes().empty());
    EXPECT_TRUE(editor.merge(node_at(editor, {0, 100}), node_at(editor, {0, 110})));
    EXPECT_TRUE(editor.merge(node_at(editor, {100, 100}), node_at(editor, {100, 110})));
    EXPECT_EQ(editor.plan().edges.size(), 7U);
}

}  // namespace
}  // namespace d2b
