#include "surface/merge_near.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "surface/node_star.hpp"
#include "surface/plan_editor.hpp"

namespace d2b {
namespace {

using NodePair = std::pair<std::uint32_t, std::uint32_t>;

std::int64_t floor_divided(std::int64_t number, std::int64_t by) {
    return number / by - (number % by < 0 ? 1 : 0);
}

/// Returns pairs of nodes closer than a gap, each once, lower number first.
std::vector<NodePair> near_pairs(const std::vector<FinePoint>& nodes, const LatticeGap& gap) {
    struct Boxed {
        std::int64_t row = 0;
        std::int64_t col = 0;
        std::uint32_t node = 0;

        auto operator<=>(const Boxed&) const = default;
    };
    std::vector<Boxed> boxed;
    boxed.reserve(nodes.size());
    for (std::uint32_t node = 0; node < nodes.size(); ++node)
        boxed.push_back(
            {floor_divided(nodes[node].row, gap.rows), floor_divided(nodes[node].col, gap.cols), node});
    std::ranges::sort(boxed);
    std::vector<NodePair> pairs;
    for (const Boxed& one : boxed)
        for (std::int64_t row = one.row; row <= one.row + 1; ++row) {
            auto other = std::ranges::lower_bound(boxed, Boxed{row, one.col - 1, 0});
            for (; other != boxed.end() && other->row == row && other->col <= one.col + 1; ++other)
                if (*other > one && !gap.parts(nodes[one.node], nodes[other->node]))
                    pairs.emplace_back(std::minmax(one.node, other->node));
        }
    std::ranges::sort(pairs);
    return pairs;
}

/// Returns true if high is above low by less than a gap.
bool is_step(std::int64_t low, std::int64_t high, std::int64_t gap) {
    return low < high && high < low + gap;
}

/// Returns pairs of contours that share a node and differ in height by less than a gap, lower one first.
std::vector<std::pair<std::size_t, std::size_t>> steps_between(const NodeStars& stars, std::size_t nodes,
                                                               const std::vector<PlanContour>& contours,
                                                               std::int64_t gap) {
    std::vector<std::pair<std::size_t, std::size_t>> steps;
    for (std::uint32_t node = 0; node < nodes; ++node)
        for (const NodeArm& low : stars.around(node))
            for (const NodeArm& high : stars.around(node))
                if (low.left != open_ground && high.left != open_ground &&
                    is_step(contours[static_cast<std::size_t>(low.left)].top,
                            contours[static_cast<std::size_t>(high.left)].top, gap))
                    steps.emplace_back(low.left, high.left);
    return steps;
}

/// Returns true if any two heights differ by less than a gap, wherever they are.
bool has_step(const std::vector<PlanContour>& contours, std::int64_t gap) {
    std::vector<std::int64_t> tops;
    tops.reserve(contours.size());
    for (const PlanContour& contour : contours)
        tops.push_back(contour.top);
    std::ranges::sort(tops);
    return std::ranges::adjacent_find(
               tops, [&](std::int64_t a, std::int64_t b) { return is_step(a, b, gap); }) != tops.end();
}

}  // namespace

void merge_near_nodes(Plan& plan, const LatticeGap& gap) {
    const std::vector<NodePair> pairs = near_pairs(plan.nodes, gap);
    if (pairs.empty())
        return;
    PlanEditor editor(std::move(plan));
    for (const auto& [a, b] : pairs) {
        if (editor.degree(a) == 0 || editor.degree(b) == 0)
            continue;
        // Keep the node with more edges, if possible.
        const bool keep_first = editor.degree(a) >= editor.degree(b);
        const auto [stays, goes] = keep_first ? std::pair(a, b) : std::pair(b, a);
        if (!editor.merge(goes, stays))
            static_cast<void>(editor.merge(stays, goes));
    }
    plan = editor.plan();
}

void level_near_roofs(const Plan& plan, std::vector<PlanContour>& contours, std::int64_t gap) {
    if (!has_step(contours, gap))
        return;
    const NodeStars stars(plan);
    // Terminates, because each round raises a roof to the height of an existing one.
    for (auto steps = steps_between(stars, plan.nodes.size(), contours, gap); !steps.empty();
         steps = steps_between(stars, plan.nodes.size(), contours, gap))
        for (const auto& [low, high] : steps)
            contours[low].top = std::max(contours[low].top, contours[high].top);
}

}  // namespace d2b
