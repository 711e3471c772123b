#include "outline/walls/wall_graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/for_rings.hpp"

namespace d2b::outline {

/// Normalizes the order of the arcs of chains and derives their traces, nodes and steps. The result does not
/// depend on the division of a chain into arcs.
class ChainTracer {
  public:
    /// @param graph with arcs and their end nodes
    explicit ChainTracer(const WallGraph& graph) : graph_(graph) {}
    /// @param chain its arcs in either direction, starting anywhere
    void trace(Chain& chain);

  private:
    void collect_points(const Chain& chain);
    [[nodiscard]] bool is_reversed(const Chain& chain) const;
    static void reverse(Chain& chain);
    void rotate(Chain& chain);
    void find_nodes(Chain& chain);
    void find_corners(Chain& chain);

    const WallGraph& graph_;
    std::vector<LatticePoint> points_;  // without repetition if the chain is closed
    std::vector<std::size_t> begins_;   // index in points_ at which each arc begins
    std::vector<std::uint32_t> steps_;  // number of steps before each point, and in total
    std::size_t start_ = 0;             // index of the point at which the trace begins
};

void ChainTracer::trace(Chain& chain) {
    collect_points(chain);
    if (is_reversed(chain)) {
        reverse(chain);
        collect_points(chain);
    }
    rotate(chain);
    find_nodes(chain);
    find_corners(chain);
}

void ChainTracer::collect_points(const Chain& chain) {
    points_.clear();
    begins_.clear();
    for (const ArcUse& use : chain.arcs) {
        const Arc& arc = graph_.graph.arcs[use.arc];
        begins_.push_back(points_.size());
        if (use.reversed)
            points_.insert(points_.end(), arc.rbegin(), arc.rend() - 1);
        else
            points_.insert(points_.end(), arc.begin(), arc.end() - 1);
    }
    const ArcUse& last = chain.arcs.back();
    const Arc& arc = graph_.graph.arcs[last.arc];
    if (!chain.closed)
        points_.push_back(last.reversed ? arc.front() : arc.back());
    start_ =
        chain.closed
            ? static_cast<std::size_t>(std::min_element(points_.begin(), points_.end()) - points_.begin())
            : 0;
}

bool ChainTracer::is_reversed(const Chain& chain) const {
    const std::size_t n = points_.size();
    // From its first corner in scan order, a ring of normal orientation runs along the row.
    if (chain.closed)
        return points_[start_ + 1 < n ? start_ + 1 : 0].row != points_[start_].row;
    return std::pair(points_[n - 1], points_[n - 2]) < std::pair(points_[0], points_[1]);
}

void ChainTracer::reverse(Chain& chain) {
    std::reverse(chain.arcs.begin(), chain.arcs.end());
    for (ArcUse& use : chain.arcs)
        use.reversed = !use.reversed;
}

/// Rotates the arcs of a closed chain so that the first one to begin at or after the start comes first.
void ChainTracer::rotate(Chain& chain) {
    const std::size_t n = points_.size();
    steps_.clear();
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        steps_.push_back(sum);
        const LatticePoint next = points_[i + 1 < n ? i + 1 : 0];
        if (chain.closed || i + 1 < n)
            sum += static_cast<std::uint32_t>(std::abs(next.row - points_[i].row) +
                                              std::abs(next.col - points_[i].col));
    }
    steps_.push_back(sum);
    if (!chain.closed)
        return;
    const auto first = std::lower_bound(begins_.begin(), begins_.end(), start_);
    const auto shift = first != begins_.end() ? first - begins_.begin() : 0;
    std::rotate(chain.arcs.begin(), chain.arcs.begin() + shift, chain.arcs.end());
    std::rotate(begins_.begin(), begins_.begin() + shift, begins_.end());
}

void ChainTracer::find_nodes(Chain& chain) {
    const std::uint32_t steps = steps_.back();
    chain.nodes.reserve(chain.arcs.size() + 1);
    chain.node_steps.reserve(chain.arcs.size() + 1);
    for (std::size_t k = 0; k < chain.arcs.size(); ++k) {
        const ArcUse use = chain.arcs[k];
        chain.nodes.push_back(graph_.ends[use.arc][use.reversed ? 1 : 0]);
        const std::size_t begin = begins_[k];
        chain.node_steps.push_back(steps_[begin] + (begin < start_ ? steps : 0) - steps_[start_]);
    }
    const ArcUse& last = chain.arcs.back();
    chain.nodes.push_back(graph_.ends[last.arc][last.reversed ? 0 : 1]);
    chain.node_steps.push_back(chain.closed ? chain.node_steps.front() + steps : steps);
}

void ChainTracer::find_corners(Chain& chain) {
    const std::size_t n = points_.size();
    chain.trace.reserve(n);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = start_ + k < n ? start_ + k : start_ + k - n;
        const LatticePoint at = points_[i];
        const LatticePoint before = points_[i > 0 ? i - 1 : n - 1];
        const LatticePoint after = points_[i + 1 < n ? i + 1 : 0];
        const bool end = !chain.closed && (k == 0 || k + 1 == n);
        if (end || (before.row == at.row) != (after.row == at.row))
            chain.trace.push_back(at);
    }
}

namespace {

class Builder {
  public:
    Builder(const WallCluster& cluster, WallGraph& result, const StopToken& stop)
        : cluster_(cluster), walls_(result), stop_(stop), tracer_(result) {}
    void find_sides();
    void find_nodes();
    void pair_ends();
    void find_chains();
    void find_owners();
    void find_components();

  private:
    static constexpr std::uint32_t none = WallGraph::none;

    [[nodiscard]] std::size_t arcs() const { return walls_.graph.arcs.size(); }
    [[nodiscard]] std::uint32_t node_of(std::uint32_t end) const { return walls_.ends[end / 2][end % 2]; }
    [[nodiscard]] int higher_side(const Chain& chain) const;
    [[nodiscard]] double mean_step(const Chain& chain) const;
    void walk(std::uint32_t from_end);

    const WallCluster& cluster_;
    WallGraph& walls_;
    const StopToken& stop_;
    ChainTracer tracer_;
    std::vector<std::uint32_t> mate_;  // per arc end: the arc end that continues the chain
};

/// Lowest and highest contours on one side of an arc.
struct SideContours {
    std::int32_t lowest = -1;
    std::int32_t highest = -1;
    int lowest_level = std::numeric_limits<int>::max();
    int highest_level = -1;

    void add(std::int32_t contour, int level) {
        if (level < lowest_level) {
            lowest = contour;
            lowest_level = level;
        }
        if (level > highest_level) {
            highest = contour;
            highest_level = level;
        }
    }
};

void Builder::find_sides() {
    std::vector<std::array<SideContours, 2>> users(arcs());
    for (std::size_t c = 0; c < cluster_.contours.size(); ++c) {
        stop_.check();
        const int level = cluster_.contours[c].key.level;
        const auto add = [&](const std::vector<ArcUse>& ring) {
            for (const ArcUse& use : ring)
                users[use.arc][use.reversed ? 1 : 0].add(static_cast<std::int32_t>(c), level);
        };
        for_rings(walls_.graph.outlines[c], add);
    }
    walls_.sides.reserve(arcs());
    walls_.ranks.reserve(arcs());
    for (const auto& [left, right] : users) {
        const bool left_is_low = left.lowest_level <= right.lowest_level;
        const SideContours& low = left_is_low ? left : right;
        const std::int32_t below = cluster_.parents[static_cast<std::size_t>(low.lowest)];
        walls_.sides.push_back(
            {left.highest < 0 ? below : left.highest, right.highest < 0 ? below : right.highest});
        walls_.ranks.push_back(2 * low.lowest_level + (left.lowest_level == right.lowest_level ? 1 : 0));
    }
}

void Builder::find_nodes() {
    std::vector<LatticePoint> points;
    for (const Arc& arc : walls_.graph.arcs) {
        points.push_back(arc.front());
        points.push_back(arc.back());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const LatticePoint point : points)
        walls_.nodes.push_back({point});
    const auto node = [&](LatticePoint point) {
        return static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), point) -
                                          points.begin());
    };
    for (const Arc& arc : walls_.graph.arcs)
        walls_.ends.push_back({node(arc.front()), node(arc.back())});
    walls_.ends_at = GroupedIndices(points.size(), [&](const auto& add) {
        for (std::uint32_t end = 0; end < 2 * arcs(); ++end)
            add(node_of(end), end);
    });
}

/// A chain continues through a node if exactly two of the arcs with the lowest rank meet there.
void Builder::pair_ends() {
    mate_.assign(2 * arcs(), none);
    for (std::uint32_t n = 0; n < walls_.nodes.size(); ++n) {
        stop_.check();
        const auto ends = walls_.ends_at[n];
        const auto rank = [&](std::uint32_t e) { return walls_.ranks[e / 2]; };
        int lowest = rank(ends.front());
        for (const std::uint32_t e : ends)
            lowest = std::min(lowest, rank(e));
        std::vector<std::uint32_t> first;
        for (const std::uint32_t e : ends)
            if (rank(e) == lowest)
                first.push_back(e);
        if (first.size() != 2)
            continue;
        mate_[first[0]] = first[1];
        mate_[first[1]] = first[0];
    }
}

/// Side of the chain on which contours of its level lie; equal for all of its arcs.
int Builder::higher_side(const Chain& chain) const {
    const auto own = [&](std::int32_t contour) {
        return contour >= 0 &&
               2 * cluster_.contours[static_cast<std::size_t>(contour)].key.level >= chain.rank - 1;
    };
    const ArcUse first = chain.arcs.front();
    const WallGraph::Sides& sides = walls_.sides[first.arc];
    return (own(sides.left) - own(sides.right)) * (first.reversed ? -1 : 1);
}

double Builder::mean_step(const Chain& chain) const {
    double squares = 0;
    double steps = 0;
    for (std::size_t k = 0; k < chain.arcs.size(); ++k) {
        const WallGraph::Sides& sides = walls_.sides[chain.arcs[k].arc];
        if (sides.left < 0 || sides.right < 0)
            continue;
        const double step = cluster_.tiers[static_cast<std::size_t>(sides.left)] -
                            cluster_.tiers[static_cast<std::size_t>(sides.right)];
        if (std::isnan(step))
            continue;
        const double length = chain.node_steps[k + 1] - chain.node_steps[k];
        squares += length * step * step;
        steps += length;
    }
    return steps > 0 ? std::sqrt(squares / steps) : 0;
}

/// @param from_end arc end at which the chain begins
void Builder::walk(std::uint32_t from_end) {
    stop_.check();
    Chain chain;
    chain.rank = walls_.ranks[from_end / 2];
    std::uint32_t end = from_end;
    do {
        chain.arcs.push_back({end / 2, end % 2 == 1});
        walls_.chain_of[end / 2] = static_cast<std::uint32_t>(walls_.chains.size());
        end = mate_[end ^ 1U];
    } while (end != none && end != from_end);
    chain.closed = end == from_end;
    tracer_.trace(chain);
    chain.higher = higher_side(chain);
    chain.step = mean_step(chain);
    for (std::uint32_t k = 0; k < chain.arcs.size(); ++k)
        walls_.index_in_chain[chain.arcs[k].arc] = k;
    walls_.chains.push_back(std::move(chain));
}

void Builder::find_chains() {
    walls_.chain_of.assign(arcs(), none);
    walls_.index_in_chain.resize(arcs());
    std::vector<std::uint32_t> order(arcs());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return walls_.ranks[a] < walls_.ranks[b]; });
    // Chains with ends start at an end; the remaining arcs of a rank form rings.
    for (std::size_t i = 0; i < order.size();) {
        std::size_t next = i;
        for (; next < order.size() && walls_.ranks[order[next]] == walls_.ranks[order[i]]; ++next)
            for (const std::uint32_t end : {2 * order[next], 2 * order[next] + 1})
                if (mate_[end] == none && walls_.chain_of[order[next]] == none)
                    walk(end);
        for (; i < next; ++i)
            if (walls_.chain_of[order[i]] == none)
                walk(2 * order[i]);
    }
}

void Builder::find_owners() {
    for (std::uint32_t c = 0; c < walls_.chains.size(); ++c) {
        const Chain& chain = walls_.chains[c];
        for (std::uint32_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size(); ++k) {
            walls_.nodes[chain.nodes[k]].owner = c;
            walls_.nodes[chain.nodes[k]].place = k;
        }
    }
}

void Builder::find_components() {
    DisjointSets components(static_cast<std::uint32_t>(walls_.chains.size()));
    for (std::uint32_t n = 0; n < walls_.nodes.size(); ++n) {
        const auto ends = walls_.ends_at[n];
        for (const std::uint32_t end : ends)
            components.join(walls_.chain_of[ends.front() / 2], walls_.chain_of[end / 2]);
    }
    DisjointSets::Numbers numbers = components.numbered();
    walls_.component_of = std::move(numbers.of);
    walls_.arcs_of = GroupedIndices(numbers.count, [&](const auto& add) {
        for (std::uint32_t arc = 0; arc < arcs(); ++arc)
            add(walls_.component_of[walls_.chain_of[arc]], arc);
    });
}

}  // namespace

WallGraph build_wall_graph(const WallCluster& cluster, const StopToken& stop) {
    WallGraph walls;
    walls.graph = build_arc_graph(NodedRings(cluster.contours, stop), stop);
    Builder builder(cluster, walls, stop);
    for (const auto part : {&Builder::find_sides, &Builder::find_nodes, &Builder::pair_ends,
                            &Builder::find_chains, &Builder::find_owners, &Builder::find_components}) {
        stop.check();
        (builder.*part)();
    }
    return walls;
}

}  // namespace d2b::outline
