#include "outline/wall_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {

WallDrawing::WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options)
    : graph_(graph),
      cluster_(cluster),
      options_(options),
      states_(graph.chains.size()),
      plain_(graph.nodes.size()),
      reset_(graph.nodes.size()) {}

std::vector<std::uint32_t> WallDrawing::draw() {
    find_waiting();
    for (const std::uint32_t c : drawn_)
        draw_chain(c);
    std::vector<std::uint32_t> changed = changed_arcs();
    reset_.assign(reset_.size(), false);
    first_ = false;
    return changed;
}

/// A chain that is drawn places its ends anew, and all that ends on it is drawn again; what is drawn again
/// for that alone keeps its other end.
void WallDrawing::find_waiting() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        State& state = states_[c];
        if (!first_ && state.form == state.drawn && !state.waiting)
            continue;
        if (first_ && !state.waiting)
            continue;
        state.waiting = true;
        open.push_back(c);
        if (!graph_.chains[c].closed && !first_)
            for (const bool last : {false, true})
                reset(end_node(graph_.chains[c], last), open);
    }
    while (!open.empty()) {
        const Chain& chain = graph_.chains[open.back()];
        open.pop_back();
        for (std::size_t k = chain.closed ? 0 : 1; k + 1 < chain.nodes.size() && !first_; ++k)
            reset(chain.nodes[k], open);
    }
    drawn_.clear();
    for (std::uint32_t c = 0; c < states_.size(); ++c)
        if (states_[c].waiting)
            drawn_.push_back(c);
}

void WallDrawing::wait(std::uint32_t chain, std::vector<std::uint32_t>& open) {
    if (!std::exchange(states_[chain].waiting, true))
        open.push_back(chain);
}

void WallDrawing::reset(std::uint32_t node, std::vector<std::uint32_t>& open) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner == WallGraph::nobody || reset_[node])
        return;
    reset_[node] = true;
    if (states_[n.owner].drawn == Form::fitted)
        states_[n.owner].course.take_away(n.place);
    for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
        if (const std::uint32_t chain = graph_.chain_of[graph_.arc_ends[e] / 2]; chain != n.owner)
            wait(chain, open);
}

/// Those of all chains that have been drawn, and those beside nodes that have been placed anew.
std::vector<std::uint32_t> WallDrawing::changed_arcs() const {
    std::vector<std::uint32_t> changed;
    if (first_) {
        for (std::uint32_t arc = 0; arc < graph_.chain_of.size(); ++arc)
            changed.push_back(arc);
        return changed;
    }
    for (const std::uint32_t c : drawn_) {
        const Chain& chain = graph_.chains[c];
        for (const ArcUse& use : chain.arcs)
            changed.push_back(use.arc);
        if (!chain.closed)
            for (const bool last : {false, true}) {
                const std::uint32_t node = end_node(chain, last);
                for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e)
                    if (reset_[node])
                        changed.push_back(graph_.arc_ends[e] / 2);
            }
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
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
    for (const bool last : {false, true}) {
        const std::uint32_t node = end_node(chain, last);
        const LatticePoint origin = chain.trace.front();
        const Vec moved = options_.shape.from_fine(land(node, {}), origin) -
                          options_.shape.from_fine(fine(graph_.nodes[node].at), origin);
        if (d2b::length(moved) > options_.tolerance)
            simplify(c);
    }
}

DrawnChain WallDrawing::joined_arc(const Chain& chain, std::size_t k) const {
    DrawnChain drawn;
    const ArcUse use = chain.arcs[k];
    for (const LatticePoint point : graph_.graph.arcs[use.arc])
        drawn.vertices.push_back(fine(point));
    const auto land = [&](bool last) {
        FinePoint& end = last != use.reversed ? drawn.vertices.back() : drawn.vertices.front();
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
    return drawn;
}

DrawnChain WallDrawing::arc(std::uint32_t arc) const {
    const std::uint32_t c = graph_.chain_of[arc];
    const State& state = states_[c];
    const Chain& chain = graph_.chains[c];
    const std::size_t k = graph_.place_of[arc];
    DrawnChain drawn;
    if (state.drawn == Form::traced) {
        drawn.vertices = fine(graph_.graph.arcs[arc]);
        return drawn;
    }
    if (state.drawn == Form::joined)
        return joined_arc(chain, k);
    drawn = state.course.arc(k, *state.samples);
    if (!chain.arcs[k].reversed)
        return drawn;
    const auto last = static_cast<std::uint32_t>(drawn.vertices.size() - 1);
    std::reverse(drawn.vertices.begin(), drawn.vertices.end());
    for (ArcSpan& span : drawn.arcs)
        span.first = last - span.first - span.edges;
    return drawn;
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
