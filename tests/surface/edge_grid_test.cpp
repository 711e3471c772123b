#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "outline/fine_geometry.hpp"
#include "surface/partition_editor.hpp"

namespace d2b {
namespace {

bool is_in_triangle(FinePoint a, FinePoint b, FinePoint c, FinePoint point) {
    const int s = side(a, b, c);
    return s * side(a, b, point) >= 0 && s * side(b, c, point) >= 0 && s * side(c, a, point) >= 0;
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
            grid.add(e, edges.back().a, edges.back().b);
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
                if (segments_intersect(edges[e], {a, b}) || segments_intersect(edges[e], {b, c}) ||
                    segments_intersect(edges[e], {c, a}) ||
                    (side(a, b, c) != 0 && is_in_triangle(a, b, c, edges[e].a))) {
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
}  // namespace d2b
