#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "outline/walls/chain_fitter.hpp"

namespace d2b::outline {
namespace {

using Points = std::vector<std::pair<double, double>>;  // row, column

/// A stretch of an open chain, and the line drawn for it.
struct Case {
    std::vector<LatticePoint> trace;
    std::vector<std::uint32_t> nodes;
    double tolerance = 1;

    [[nodiscard]] Points draw(FitMode mode) const {
        const TraceSums samples(trace, false, {});
        std::vector<std::uint32_t> steps{0};
        steps.insert(steps.end(), nodes.begin(), nodes.end());
        steps.push_back(static_cast<std::uint32_t>(samples.steps()));
        const StepMidpoints midpoints(samples, steps, tolerance);
        ChainPolyline chain;
        chain.vertices.push_back(fine(trace.front()));
        chain.steps.push_back(0);
        const FinePoint end = fine(trace.back());
        midpoints.append({0, samples.steps(), mode}, &end, chain);
        Points points;
        for (const FinePoint p : chain.vertices)
            points.emplace_back(static_cast<double>(p.row) / FinePoint::steps,
                                static_cast<double>(p.col) / FinePoint::steps);
        return points;
    }
};

/// A staircase from (0, 0) to (n, n), a step along a row and a step along a column in turn.
std::vector<LatticePoint> staircase(std::int32_t n) {
    std::vector<LatticePoint> trace{{0, 0}};
    for (std::int32_t i = 0; i < n; ++i) {
        trace.push_back({i, i + 1});
        trace.push_back({i + 1, i + 1});
    }
    return trace;
}

TEST(StepMidpoints, AStaircaseIsAStraightLine) {
    // Its corners are 0.71 from the line between its ends, 0.35 from that through the middles of its steps.
    const Points drawn = Case{staircase(12), {}}.draw(FitMode::midpoint);
    ASSERT_EQ(drawn.size(), 4U);  // with a piece at either end, since the ends of the chain are corners
    EXPECT_EQ(drawn.front(), (std::pair{0.0, 0.0}));
    EXPECT_EQ(drawn.back(), (std::pair{12.0, 12.0}));
    EXPECT_EQ(drawn[1].second - drawn[1].first, drawn[2].second - drawn[2].first);
}

TEST(StepMidpoints, CutFormsCutTheCornersOfStaircasesAlone) {
    // Ten cells along a row, a corner, three down, then two steps of a staircase.
    const Case steps{{{0, 0}, {0, 10}, {3, 10}, {3, 11}, {4, 11}, {4, 14}}, {}};
    EXPECT_EQ(steps.draw(FitMode::beveled), (Points{{0, 0}, {0, 10}, {2.5, 10}, {4, 11.5}, {4, 14}}));
    // A niche of two cells is none.
    const std::vector<LatticePoint> niche{{0, 0}, {0, 4}, {2, 4}, {2, 6}, {0, 6}, {0, 9}};
    EXPECT_EQ((Case{niche, {}}.draw(FitMode::beveled)),
              (Points{{0, 0}, {0, 4}, {2, 4}, {2, 6}, {0, 6}, {0, 9}}));
}

TEST(StepMidpoints, NodesStayInCutForms) {
    const Case plain{staircase(3), {}};
    const Case with_node{staircase(3), {3}};  // at (1, 2)
    const auto has = [](const Points& points) {
        return std::count(points.begin(), points.end(), std::pair(1.0, 2.0)) == 1;
    };
    EXPECT_FALSE(has(plain.draw(FitMode::beveled)));
    EXPECT_TRUE(has(with_node.draw(FitMode::beveled)));
}

TEST(StepMidpoints, ATightToleranceKeepsTheTrace) {
    const Case tight{staircase(3), {}, 0.3};
    EXPECT_EQ(tight.draw(FitMode::beveled), (Points{{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}}));
    EXPECT_FALSE(StepMidpoints::can_bevel(1, 0.3));
    EXPECT_TRUE(StepMidpoints::can_bevel(1, 0.5));
}

}  // namespace
}  // namespace d2b::outline
