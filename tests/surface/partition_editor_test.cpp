#include "surface/partition_editor.hpp"

#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "outline/fine_geometry.hpp"
#include "surface/partition.hpp"

namespace d2b::surface {
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

/// Two corners and then two more: the wall between them is one, and the area between is gone.
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

/// All is as before after splits are taken back, also for later edits.
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

bool is_in_triangle(FinePoint a, FinePoint b, FinePoint c, FinePoint point) {
    const int s = outline::side(a, b, c);
    return s * outline::side(a, b, point) >= 0 && s * outline::side(b, c, point) >= 0 &&
           s * outline::side(c, a, point) >= 0;
}

/// All edges that meet a triangle or a box are found, wherever they lie.
TEST(EdgeGrid, findsAllThatMeets) {
    std::mt19937 random(7);
    const auto point = [&](std::int64_t size) {
        const auto at = [&] {
            return static_cast<std::int64_t>(random() % static_cast<unsigned>(size)) - size / 2;
        };
        return FinePoint{at(), at()};
    };
    for (const std::int64_t size : {3000, 30000, 300000}) {
        EdgeGrid grid;
        std::vector<FineSegment> edges;
        for (std::uint32_t e = 0; e < 200; ++e) {
            edges.push_back({point(size), point(size)});
            grid.add(e, edges.back().from, edges.back().to);
        }
        for (int i = 0; i < 100; ++i) {
            const FinePoint a = point(size);
            const FinePoint b = point(size);
            const FinePoint c = i % 4 == 0 ? b : point(size);
            std::set<std::uint32_t> found;
            EXPECT_TRUE(grid.all_in_triangle(a, b, c, [&](std::uint32_t e) {
                found.insert(e);
                return true;
            }));
            for (std::uint32_t e = 0; e < edges.size(); ++e)
                if (outline::segments_intersect(edges[e], {a, b}) ||
                    outline::segments_intersect(edges[e], {b, c}) ||
                    outline::segments_intersect(edges[e], {c, a}) ||
                    (outline::side(a, b, c) != 0 && is_in_triangle(a, b, c, edges[e].from))) {
                    ASSERT_TRUE(found.contains(e)) << size << ' ' << i << ' ' << e;
                }
        }
    }
}

/// A diagonal of a hundred thousand steps lies in some hundred cells, and not in the thousands of its box.
TEST(EdgeGrid, aLongEdgeIsInFewCells) {
    EdgeGrid grid;
    grid.add(0, {0, 0}, {204800, 204800});
    int met = 0;
    EXPECT_TRUE(grid.all_in_box({0, 0}, {204800, 204800}, [&](std::uint32_t) { return ++met > 0; }));
    EXPECT_GE(met, 100);
    EXPECT_LE(met, 400);
}

}  // namespace
}  // namespace d2b::surface
