#include "outline/wall_graph.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace d2b {
namespace {

class Builder {
  public:
    Builder(const std::vector<Contour>& contours, WallGraph& result) : contours_(contours), walls_(result) {}
    void find_sides();
    void find_nodes();
    void find_mates();
    void find_chains();
    void find_owners();
    void find_parts();

  private:
    static constexpr std::uint32_t nobody = WallGraph::nobody;

    [[nodiscard]] std::size_t arcs() const { return walls_.graph.arcs.size(); }
    [[nodiscard]] std::uint32_t node_of(std::uint32_t end) const { return walls_.ends[end / 2][end % 2]; }
    void walk(std::uint32_t from_end);
    void add_trace(Chain& chain) const;

    const std::vector<Contour>& contours_;
    WallGraph& walls_;
    std::vector<std::uint32_t> mate_;  // of an arc end: the one that it goes on with
};

/// What uses an arc on one side.
struct Users {
    std::int64_t lowest = -1;
    std::int64_t highest = -1;

    void add(std::int64_t contour, const std::vector<Contour>& contours) {
        const auto level = [&](std::int64_t c) { return contours[static_cast<std::size_t>(c)].key.level; };
        if (lowest < 0 || level(contour) < level(lowest))
            lowest = contour;
        if (highest < 0 || level(contour) > level(highest))
            highest = contour;
    }
};

void Builder::find_sides() {
    std::vector<std::array<Users, 2>> users(arcs());
    const auto add = [&](const std::vector<ArcUse>& ring, std::size_t contour) {
        for (const ArcUse& use : ring)
            users[use.arc][use.reversed ? 1 : 0].add(static_cast<std::int64_t>(contour), contours_);
    };
    for (std::size_t c = 0; c < contours_.size(); ++c) {
        add(walls_.graph.outlines[c].exterior, c);
        for (const auto& ring : walls_.graph.outlines[c].interiors)
            add(ring, c);
    }
    const auto level = [&](const Users& side) {
        return side.lowest < 0 ? std::numeric_limits<int>::max()
                               : contours_[static_cast<std::size_t>(side.lowest)].key.level;
    };
    for (const auto& [left, right] : users) {
        const int lowest = std::min(level(left), level(right));
        const std::int64_t below =
            contours_[static_cast<std::size_t>(level(left) == lowest ? left.lowest : right.lowest)].parent;
        walls_.sides.push_back(
            {left.highest < 0 ? below : left.highest, right.highest < 0 ? below : right.highest});
        walls_.ranks.push_back(2 * lowest + (level(left) == level(right) ? 1 : 0));
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
    walls_.first_end.assign(points.size() + 1, 0);
    for (const Arc& arc : walls_.graph.arcs) {
        walls_.ends.push_back({node(arc.front()), node(arc.back())});
        for (const std::uint32_t n : walls_.ends.back())
            ++walls_.first_end[n + 1];
    }
    std::partial_sum(walls_.first_end.begin(), walls_.first_end.end(), walls_.first_end.begin());
    walls_.arc_ends.resize(2 * arcs());
    std::vector<std::uint32_t> next = walls_.first_end;
    for (std::uint32_t end = 0; end < 2 * arcs(); ++end)
        walls_.arc_ends[next[node_of(end)]++] = end;
}

/// Through a node goes a chain where exactly two of the arcs that are drawn first there meet.
void Builder::find_mates() {
    mate_.assign(2 * arcs(), nobody);
    for (std::size_t n = 0; n < walls_.nodes.size(); ++n) {
        const auto begin = walls_.arc_ends.begin() + walls_.first_end[n];
        const auto end = walls_.arc_ends.begin() + walls_.first_end[n + 1];
        const auto rank = [&](std::uint32_t e) { return walls_.ranks[e / 2]; };
        int lowest = rank(*begin);
        for (auto e = begin; e != end; ++e)
            lowest = std::min(lowest, rank(*e));
        std::vector<std::uint32_t> first;
        for (auto e = begin; e != end; ++e)
            if (rank(*e) == lowest)
                first.push_back(*e);
        if (first.size() != 2)
            continue;
        mate_[first[0]] = first[1];
        mate_[first[1]] = first[0];
    }
}

void Builder::add_trace(Chain& chain) const {
    for (const ArcUse& use : chain.arcs) {
        const Arc& arc = walls_.graph.arcs[use.arc];
        chain.begins.push_back(static_cast<std::uint32_t>(chain.trace.size()));
        chain.nodes.push_back(walls_.ends[use.arc][use.reversed ? 1 : 0]);
        if (use.reversed)
            chain.trace.insert(chain.trace.end(), arc.rbegin(), arc.rend() - 1);
        else
            chain.trace.insert(chain.trace.end(), arc.begin(), arc.end() - 1);
    }
    const ArcUse& last = chain.arcs.back();
    chain.nodes.push_back(walls_.ends[last.arc][last.reversed ? 0 : 1]);
    chain.begins.push_back(static_cast<std::uint32_t>(chain.trace.size()));
    if (!chain.closed)
        chain.trace.push_back(walls_.nodes[chain.nodes.back()].at);
}

/// @param from_end where the chain begins
void Builder::walk(std::uint32_t from_end) {
    Chain chain;
    chain.rank = walls_.ranks[from_end / 2];
    std::uint32_t end = from_end;
    do {
        chain.arcs.push_back({end / 2, end % 2 == 1});
        walls_.chain_of[end / 2] = static_cast<std::uint32_t>(walls_.chains.size());
        end = mate_[end ^ 1U];
    } while (end != nobody && end != from_end);
    chain.closed = end == from_end;
    add_trace(chain);
    walls_.chains.push_back(std::move(chain));
}

void Builder::find_chains() {
    walls_.chain_of.assign(arcs(), nobody);
    std::vector<std::uint32_t> order(arcs());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return walls_.ranks[a] < walls_.ranks[b]; });
    // Chains with ends begin at one; what is left of a rank are rings.
    for (std::size_t i = 0; i < order.size();) {
        std::size_t next = i;
        for (; next < order.size() && walls_.ranks[order[next]] == walls_.ranks[order[i]]; ++next)
            for (const std::uint32_t end : {2 * order[next], 2 * order[next] + 1})
                if (mate_[end] == nobody && walls_.chain_of[order[next]] == nobody)
                    walk(end);
        for (; i < next; ++i)
            if (walls_.chain_of[order[i]] == nobody)
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

void Builder::find_parts() {
    std::vector<std::uint32_t> up(walls_.chains.size());
    std::iota(up.begin(), up.end(), 0U);
    const auto find = [&](std::uint32_t c) {
        while (up[c] != c) {
            up[c] = up[up[c]];
            c = up[c];
        }
        return c;
    };
    for (std::size_t n = 0; n < walls_.nodes.size(); ++n)
        for (std::uint32_t e = walls_.first_end[n] + 1; e < walls_.first_end[n + 1]; ++e) {
            const std::uint32_t a = find(walls_.chain_of[walls_.arc_ends[e - 1] / 2]);
            const std::uint32_t b = find(walls_.chain_of[walls_.arc_ends[e] / 2]);
            up[std::max(a, b)] = std::min(a, b);
        }
    walls_.part_of.resize(up.size());
    for (std::uint32_t c = 0; c < up.size(); ++c)
        walls_.part_of[c] = find(c) == c ? walls_.parts++ : walls_.part_of[find(c)];
}

}  // namespace

WallGraph build_wall_graph(const std::vector<Contour>& contours) {
    WallGraph walls;
    walls.graph = build_arc_graph(contours);
    Builder builder(contours, walls);
    builder.find_sides();
    builder.find_nodes();
    builder.find_mates();
    builder.find_chains();
    builder.find_owners();
    builder.find_parts();
    return walls;
}

}  // namespace d2b
