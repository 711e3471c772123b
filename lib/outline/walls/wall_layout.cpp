#include "outline/walls/wall_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b::outline {

namespace {

constexpr std::size_t most_frames = 4;
constexpr std::size_t most_singles = 3;
constexpr std::size_t steps_per_direction = 40;
constexpr std::size_t most_free_singles = 8;  // where all directions have one price
constexpr int min_rank =
    3;  // rank of walls between footprints; those of chains that stand on them are higher

/// Groups of footprints that share chains, with the contours on them. A group is named by its first contour.
class FootprintGroups {
  public:
    FootprintGroups(const WallGraph& graph, const WallCluster& cluster)
        : graph_(graph), sets_(static_cast<std::uint32_t>(cluster.contours.size())) {
        for (std::uint32_t i = 0; i < sets_.size(); ++i)
            if (cluster.contours[i].key.level > 1 && cluster.parents[i] >= 0)
                sets_.join(i, static_cast<std::uint32_t>(cluster.parents[i]));
        for (std::uint32_t c = 0; c < graph.chains.size(); ++c)
            if (graph.chains[c].rank <= WallGraph::highest_low_rank)
                unite_sides(c);
    }
    [[nodiscard]] std::uint32_t group_of(std::uint32_t chain) {
        const WallGraph::Sides& sides = graph_.sides[graph_.chains[chain].arcs.front().arc];
        return sets_.find(static_cast<std::uint32_t>(std::max(sides.left, sides.right)));
    }

  private:
    void unite_sides(std::uint32_t chain) {
        for (const ArcUse& use : graph_.chains[chain].arcs)
            for (const std::int32_t side : {graph_.sides[use.arc].left, graph_.sides[use.arc].right})
                if (side >= 0)
                    sets_.join(static_cast<std::uint32_t>(side), group_of(chain));
    }

    const WallGraph& graph_;
    DisjointSets sets_;  // of contours
};

/// A short chain does not have many directions.
std::size_t most_directions_of(const ChainFitter& chain) {
    return 1 + chain.samples().steps() / steps_per_direction;
}

std::size_t most_frames_of(const ChainFitter& chain, Walls walls) {
    return walls == Walls::right ? 1 : std::min(most_directions_of(chain), most_frames);
}

/// First chain of the outline of the footprint below the contours at an arc.
std::uint32_t footprint_chain(const WallGraph& graph, const WallCluster& cluster, std::uint32_t arc) {
    const WallGraph::Sides& sides = graph.sides[arc];
    auto contour = static_cast<std::int64_t>(std::max(sides.left, sides.right));
    while (contour >= 0 && cluster.contours[static_cast<std::size_t>(contour)].key.level > 1)
        contour = cluster.parents[static_cast<std::size_t>(contour)];
    if (contour < 0)
        return WallGraph::none;
    return graph.chain_of[graph.graph.outlines[static_cast<std::size_t>(contour)].exterior.front().arc];
}

/// Chain whose direction another chain follows: the one on which it ends, or else the outline of the
/// footprint below it. Its rank is lower.
/// @return WallGraph::none if there is none
std::uint32_t reference_chain(const WallGraph& graph, const WallCluster& cluster, std::uint32_t c) {
    const Chain& chain = graph.chains[c];
    if (chain.rank < min_rank)
        return WallGraph::none;
    std::uint32_t base = chain.closed ? WallGraph::none : graph.nodes[chain.nodes.front()].owner;
    if (base == WallGraph::none)
        base = footprint_chain(graph, cluster, chain.arcs.front().arc);
    if (base == WallGraph::none || graph.chains[base].rank >= chain.rank)
        return WallGraph::none;
    return base;
}

constexpr std::array tried_prices{1.0, 0.5, 0.25};  // prices of walls, tried in turn

}  // namespace

WallLayout::WallLayout(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                       const StopToken& stop)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      stop_(stop),
      states_(graph.chains.size()),
      positions_(graph, states_, options.shape),
      reset_(graph.nodes.size()) {
    for (std::size_t c = 0; c < states_.size(); ++c)
        states_[c].mode = ChainFitMode(graph.chains[c].steps(), graph.chains[c].closed);
}

/// Chains that are drawn for their own sake place their ends anew. Any chain that changes places the nodes on
/// it anew; the chains that end there have a higher rank and are drawn later.
std::vector<std::uint32_t> WallLayout::draw() {
    std::vector<std::uint32_t> drawn;
    if (first_)
        find_frames();
    reset_.assign(reset_.size(), 0);
    for (std::uint32_t c = 0; c < states_.size(); ++c)
        if (states_[c].pending && !graph_.chains[c].closed)
            for (const bool last : {false, true})
                reset(graph_.chains[c].end_node(last));
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        ChainState& state = states_[c];
        if (!state.pending &&
            (!std::exchange(state.ends_moved, false) || positions_.place_ends(c) == state.ends))
            continue;
        stop_.check();
        draw_chain(c);
        drawn.push_back(c);
        const Chain& chain = graph_.chains[c];
        for (std::size_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size(); ++k)
            reset(chain.nodes[k]);
    }
    first_ = false;
    return changed_arcs(drawn);
}

/// Removes a node from its chain; the chains that end there have to be placed again.
void WallLayout::reset(std::uint32_t node) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (first_ || n.owner == WallGraph::none || std::exchange(reset_[node], std::uint8_t{1}) != 0)
        return;
    if (states_[n.owner].chain)
        states_[n.owner].polyline.remove_node(n.place);
    for (const std::uint32_t end : graph_.ends_at[node])
        if (const std::uint32_t chain = graph_.chain_of[end / 2]; chain != n.owner)
            states_[chain].ends_moved = true;
}

/// Arcs of redrawn chains and arcs at nodes that were placed anew.
std::vector<std::uint32_t> WallLayout::changed_arcs(const std::vector<std::uint32_t>& drawn) const {
    std::vector<std::uint32_t> changed;
    if (drawn.empty())
        return changed;
    std::vector<std::uint8_t> marked(graph_.chain_of.size());
    for (const std::uint32_t c : drawn) {
        const Chain& chain = graph_.chains[c];
        for (const ArcUse& use : chain.arcs)
            marked[use.arc] = 1;
        for (const bool last : {false, true})
            if (const std::uint32_t node = chain.end_node(last); reset_[node] != 0)
                for (const std::uint32_t end : graph_.ends_at[node])
                    marked[end / 2] = 1;
    }
    for (std::uint32_t arc = 0; arc < marked.size(); ++arc)
        if (marked[arc] != 0)
            changed.push_back(arc);
    return changed;
}

ChainFitter& WallLayout::fitter(std::uint32_t c) {
    ChainState& state = states_[c];
    if (!state.chain)
        state.chain = std::make_unique<ChainFitter>(graph_.chains[c], options_);
    return *state.chain;
}

void WallLayout::draw_chain(std::uint32_t c) {
    ChainState& state = states_[c];
    const Chain& chain = graph_.chains[c];
    state.pending = false;
    ChainFitter& drawn = fitter(c);
    if (state.mode.has_walls() && drawn.walls().empty())
        plan(c);
    state.ends = positions_.place_ends(c);
    state.polyline = PlacedPolyline(drawn.draw(state.mode, state.ends), chain, state.mode, drawn.samples(),
                                    options_.tolerance);
}

/// Divides a chain into walls, as few as possible within the tolerance.
void WallLayout::plan(std::uint32_t c) {
    ChainState& state = states_[c];
    const WallDirections known = directions(c);
    const bool turn_frames = graph_.chains[c].rank < min_rank;
    state.directions = known;
    for (; state.price < tried_prices.size(); ++state.price) {
        const double price = tried_prices[state.price];
        WallDirections tried = known;
        if (!state.chain->plan(price, tried, turn_frames, stop_))
            continue;
        state.directions = std::move(tried);
        if (state.chain->walls_are_near(positions_.place_ends(c)))
            return;
    }
    if (state.chain->walls().empty())
        state.mode.raise_all(FitMode::midpoint);
}

bool WallLayout::lower_price(std::uint32_t c) {
    ChainState& state = states_[c];
    if (!state.mode.has_walls() || state.price + 1 >= tried_prices.size())
        return false;
    ++state.price;
    plan(c);
    state.pending = true;
    return true;
}

void WallLayout::find_frames() {
    FootprintGroups footprints(graph_, cluster_);
    std::map<std::uint32_t, DirectionHistogram> groups;
    std::map<std::uint32_t, DirectionHistogram> tiers;  // of the same groups
    for (std::uint32_t c = 0; c < graph_.chains.size(); ++c) {
        stop_.check();
        const bool is_tier = graph_.chains[c].rank > WallGraph::highest_low_rank;
        DirectionHistogram& group = (is_tier ? tiers : groups)[footprints.group_of(c)];
        if (reference_chain(graph_, cluster_, c) == WallGraph::none) {
            DirectionHistogram::add(fitter(c).stretches(), {&group});
            continue;
        }
        DirectionHistogram own;
        DirectionHistogram::add(fitter(c).stretches(), {&own, &group});
        if (own.total() > 0)
            states_[c].main_direction = own.frames(1).front();
    }
    // Ridges and steps of a roof run as its walls do, and no crown hides them.
    constexpr double tier_weight = 0.5;
    for (const auto& [group, histogram] : tiers)
        groups[group].add(histogram, tier_weight);
    for (std::uint32_t c = 0; c < graph_.chains.size(); ++c) {
        if (reference_chain(graph_, cluster_, c) != WallGraph::none)
            continue;
        const ChainFitter& chain = fitter(c);
        // Found again, because histograms of all chains of a cluster take too much memory.
        DirectionHistogram own;
        DirectionHistogram::add(chain.stretches(), {&own});
        // A short chain says little, so that its building counts as much at least.
        constexpr double weight_of_short = 50;
        const DirectionHistogram& building = groups.at(footprints.group_of(c));
        if (building.total() > 0)
            own.add(building, (own.total() + weight_of_short) / building.total());
        own.take_walls_of(building);
        states_[c].directions.frames = own.frames(most_frames_of(chain, options_.walls));
    }
}

/// Directions for planning the walls of a chain: those of the walls below it, or else of its building, and of
/// its own stretches.
WallDirections WallLayout::directions(std::uint32_t c) const {
    const ChainFitter& chain = *states_[c].chain;
    const bool right = options_.walls == Walls::right;
    WallDirections directions;
    if (const std::uint32_t base = reference_chain(graph_, cluster_, c); base != WallGraph::none) {
        constexpr double apart = 8.0 / 180 * std::numbers::pi;
        directions.frames = states_[base].directions.frames;
        directions.frames.resize(std::min(directions.frames.size(), most_frames_of(chain, options_.walls)));
        const std::optional<double> main = states_[c].main_direction;
        if (!right && main && std::ranges::none_of(directions.frames, [&](double frame) {
                return std::abs(angle_between(frame, *main)) < apart;
            }))
            directions.frames.push_back(*main);
    } else {
        directions.frames = states_[c].directions.frames;
    }
    constexpr double min_length = 5;        // cells
    constexpr double min_tolerances = 2.4;  // 6 m with the usual tolerance
    if (!right)
        directions.single = single_directions(
            chain.stretches(), directions.frames, std::max(min_length, min_tolerances * options_.tolerance),
            options_.walls == Walls::free ? most_free_singles
                                          : std::min(most_directions_of(chain), most_singles));
    if (graph_.chains[c].rank < min_rank)
        align_frames(chain.stretches(), directions.frames);
    return directions;
}

void WallLayout::arc(std::uint32_t arc, ChainPolyline& drawn) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const std::size_t k = graph_.index_in_chain[arc];
    states_[c].polyline.extract(k, k + 1, drawn);
    if (!graph_.chains[c].arcs[k].reversed)
        return;
    const auto last = static_cast<std::uint32_t>(drawn.vertices.size() - 1);
    std::reverse(drawn.vertices.begin(), drawn.vertices.end());
    std::reverse(drawn.steps.begin(), drawn.steps.end());
    for (CircularArc& span : drawn.arcs)
        span.first = last - span.first - span.edges;
}

bool WallLayout::extract(const ArcUse& first, const ArcUse& last, bool whole, ChainPolyline& drawn) const {
    const std::uint32_t c = graph_.chain_of[first.arc];
    const Chain& chain = graph_.chains[c];
    const std::size_t k = graph_.index_in_chain[first.arc];
    const bool against = chain.arcs[k].reversed != first.reversed;
    const std::size_t from = against ? graph_.index_in_chain[last.arc] : k;
    const std::size_t to = against ? k : graph_.index_in_chain[last.arc];
    const PlacedPolyline& polyline = states_[c].polyline;
    if (whole)
        polyline.whole(drawn);
    else
        polyline.extract(from, to + 1, drawn);
    return against;
}

bool WallLayout::tighten(std::uint32_t c, std::size_t first, std::size_t last, std::size_t margin) {
    const bool closer = states_[c].mode.tighten(first, last, margin);
    states_[c].pending = states_[c].pending || closer;
    return closer;
}

bool WallLayout::use_trace(std::uint32_t c, std::size_t first, std::size_t last, std::size_t margin) {
    const bool closer = states_[c].mode.raise(first, last, margin, FitMode::beveled);
    states_[c].pending = states_[c].pending || closer;
    return closer;
}

bool WallLayout::tighten_at(std::uint32_t node, std::size_t margin) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::none || positions_.at(node) == fine(n.at))
        return false;
    const std::uint32_t step = graph_.chains[n.owner].node_steps[n.place];
    return tighten(n.owner, step, step + 1, margin);
}

std::vector<WallLayout::Wall> WallLayout::walls_along(std::uint32_t arc) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const ChainWalls& segments = states_[c].chain->walls();
    const std::vector<std::uint32_t>& steps = graph_.chains[c].node_steps;
    const std::size_t k = graph_.index_in_chain[arc];
    std::vector<Wall> walls;
    for (const std::size_t i : segments.movable_walls(steps[k], steps[k + 1], stop_))
        if (const WallSegment segment = segments.segment(i);
            mode(c).at((segment.first + segment.last) / 2) == FitMode::regularized)
            walls.push_back({c, i});
    return walls;
}

double WallLayout::length(Wall wall) const {
    return states_[wall.chain].chain->walls().length(wall.segment);
}

void WallLayout::shift(Wall wall, double cells) {
    ChainState& state = states_[wall.chain];
    state.chain->shift(wall.segment, cells);
    state.pending = true;
}

}  // namespace d2b::outline
