#include "outline/wall_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {

WallDrawing::WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                         const StopRequest& stop)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      stop_(stop),
      states_(graph.chains.size()),
      plain_(graph.nodes.size()),
      reset_(graph.nodes.size()) {}

/// What is drawn for its own sake places its ends anew. Whatever changes places the nodes on it anew; what
/// ends there is of higher rank and has its turn later.
std::vector<std::uint32_t> WallDrawing::draw() {
    drawn_.clear();
    reset_.assign(reset_.size(), 0);
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        State& state = states_[c];
        state.waiting = state.waiting || (!first_ && state.form != state.drawn);
        if (state.waiting && !graph_.chains[c].closed)
            for (const bool last : {false, true})
                reset(end_node(graph_.chains[c], last));
    }
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        if (!states_[c].waiting && (!std::exchange(states_[c].lands, false) || ends_where_it_did(c)))
            continue;
        stop_.check();
        draw_chain(c);
        drawn_.push_back(c);
        const Chain& chain = graph_.chains[c];
        for (std::size_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size(); ++k)
            reset(chain.nodes[k]);
    }
    std::vector<std::uint32_t> changed = changed_arcs();
    first_ = false;
    return changed;
}

/// Takes a node away; all that ends there looks where to end.
void WallDrawing::reset(std::uint32_t node) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (first_ || n.owner == WallGraph::nobody || std::exchange(reset_[node], std::uint8_t{1}) != 0)
        return;
    if (states_[n.owner].drawn == Form::fitted)
        states_[n.owner].course.take_away(n.place);
    for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
        if (const std::uint32_t chain = graph_.chain_of[graph_.arc_ends[e] / 2]; chain != n.owner)
            states_[chain].lands = true;
}

bool WallDrawing::ends_where_it_did(std::uint32_t c) {
    const State& state = states_[c];
    if (state.form != state.drawn)
        return false;
    if (state.drawn == Form::traced)
        return true;
    const Chain& chain = graph_.chains[c];
    const std::optional<ChainEnds> before = state.ends;
    const std::optional<ChainEnds> now =
        state.drawn == Form::fitted
            ? land_ends(chain, moved_piece(c, 0), moved_piece(c, state.pieces.size() - 1))
            : ChainEnds{land(end_node(chain, false), {}), land(end_node(chain, true), {})};
    return now == before;
}

/// Those of all chains that have been drawn, and those beside nodes that have been placed anew.
std::vector<std::uint32_t> WallDrawing::changed_arcs() const {
    std::vector<std::uint8_t> marked(graph_.chain_of.size(), first_ ? 1 : 0);
    if (!first_)
        for (const std::uint32_t c : drawn_) {
            const Chain& chain = graph_.chains[c];
            for (const ArcUse& use : chain.arcs)
                marked[use.arc] = 1;
            for (const bool last : {false, true}) {
                const std::uint32_t node = end_node(chain, last);
                for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
                    if (reset_[node] != 0)
                        marked[graph_.arc_ends[e] / 2] = 1;
            }
        }
    std::vector<std::uint32_t> changed;
    if (drawn_.empty() && !first_)
        return changed;
    for (std::uint32_t arc = 0; arc < marked.size(); ++arc)
        if (marked[arc] != 0)
            changed.push_back(arc);
    return changed;
}

FinePoint WallDrawing::place(std::uint32_t node) const {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::nobody || states_[n.owner].drawn != Form::fitted)
        return fine(n.at);
    return states_[n.owner].course.node(n.place).value_or(fine(n.at));
}

FinePoint WallDrawing::land(std::uint32_t node, const std::optional<Line>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::nobody && states_[n.owner].drawn == Form::fitted)
        states_[n.owner].course.place(n.place, plain_[node] ? std::nullopt : wall);
    return place(node);
}

void WallDrawing::draw_chain(std::uint32_t c) {
    State& state = states_[c];
    state.waiting = false;
    state.drawn = Form::fitted;
    if (state.form == Form::fitted && fit(c))
        return;
    state.course = {};
    state.samples.reset();
    if (state.form == Form::fitted)
        simplify(c);
    state.drawn = state.form;
    if (state.form == Form::joined)
        land_traced(c);
}

/// Places the ends of a chain that is drawn as it was traced but for these.
void WallDrawing::land_traced(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    const LatticePoint origin = chain.trace.front();
    states_[c].ends = ChainEnds{land(end_node(chain, false), {}), land(end_node(chain, true), {})};
    for (const bool last : {false, true}) {
        const FinePoint landed = last ? states_[c].ends->last : states_[c].ends->first;
        const Vec moved = options_.shape.from_fine(landed, origin) -
                          options_.shape.from_fine(fine(graph_.nodes[end_node(chain, last)].at), origin);
        if (d2b::length(moved) > options_.tolerance)
            simplify(c);
    }
}

/// Lets an arc as it was traced end on what the chain ends on.
void WallDrawing::join(const Chain& chain, std::size_t k, DrawnChain& drawn) const {
    const auto land = [&](bool last) {
        FinePoint& end = last != chain.arcs[k].reversed ? drawn.vertices.back() : drawn.vertices.front();
        const FinePoint landed = place(end_node(chain, last));
        const LatticePoint origin = chain.trace.front();
        drawn.deviation = std::max(drawn.deviation, d2b::length(options_.shape.from_fine(landed, origin) -
                                                                options_.shape.from_fine(end, origin)));
        end = landed;
    };
    if (k == 0)
        land(false);
    if (k + 1 == chain.arcs.size())
        land(true);
}

void WallDrawing::arc(std::uint32_t arc, DrawnChain& drawn) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const State& state = states_[c];
    const Chain& chain = graph_.chains[c];
    const std::size_t k = graph_.place_of[arc];
    if (state.drawn != Form::fitted) {
        drawn.vertices.clear();
        for (const LatticePoint point : graph_.graph.arcs[arc])
            drawn.vertices.push_back(fine(point));
        drawn.arcs.clear();
        drawn.deviation = 0;
        if (state.drawn == Form::joined)
            join(chain, k, drawn);
        return;
    }
    state.course.arc(k, *state.samples, drawn);
    if (!chain.arcs[k].reversed)
        return;
    const auto last = static_cast<std::uint32_t>(drawn.vertices.size() - 1);
    std::reverse(drawn.vertices.begin(), drawn.vertices.end());
    for (ArcSpan& span : drawn.arcs)
        span.first = last - span.first - span.edges;
}

bool WallDrawing::simplify(std::uint32_t c) {
    State& state = states_[c];
    if (state.form == Form::traced)
        return false;
    if (!graph_.chains[c].closed && state.form == Form::fitted) {
        state.form = Form::joined;
        for (const bool last : {false, true})
            plain_[end_node(graph_.chains[c], last)] = true;
        return true;
    }
    // What a traced chain ends on is traced, too, and so on downwards.
    std::vector<std::uint32_t> open{c};
    while (!open.empty()) {
        const std::uint32_t traced = open.back();
        open.pop_back();
        if (std::exchange(states_[traced].form, Form::traced) == Form::traced)
            continue;
        const Chain& chain = graph_.chains[traced];
        if (chain.closed)
            continue;
        for (const bool last : {false, true}) {
            const std::uint32_t node = end_node(chain, last);
            plain_[node] = true;
            if (graph_.nodes[node].owner != WallGraph::nobody)
                open.push_back(graph_.nodes[node].owner);
        }
    }
    return true;
}

}  // namespace d2b
