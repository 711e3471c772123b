#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "outline/wall_drawing.hpp"

namespace d2b {
namespace {

/// Chains are known by their first edges.
using ChainKey = std::tuple<LatticePoint, LatticePoint, std::uint32_t>;

std::vector<ChainKey> keys_of(const WallGraph& graph) {
    std::vector<ChainKey> keys;
    keys.reserve(graph.chains.size());
    for (std::uint32_t c = 0; c < graph.chains.size(); ++c)
        keys.emplace_back(graph.chains[c].trace[0], graph.chains[c].trace[1], c);
    std::sort(keys.begin(), keys.end());
    return keys;
}

}  // namespace

/// What ends on a chain that is drawn anew is drawn anew.
bool WallDrawing::can_adopt(const Chain& chain, const std::vector<bool>& adopted) const {
    return chain.closed || std::ranges::all_of(std::array{false, true}, [&](bool last) {
               const std::uint32_t owner = graph_.nodes[end_node(chain, last)].owner;
               return owner == WallGraph::nobody || adopted[owner];
           });
}

void WallDrawing::adopt(WallDrawing&& low) {
    const std::vector<ChainKey> keys = keys_of(low.graph_);
    std::vector<bool> adopted(states_.size());
    for (std::uint32_t c = 0; c < states_.size(); ++c) {
        const Chain& chain = graph_.chains[c];
        const auto key =
            std::lower_bound(keys.begin(), keys.end(), ChainKey{chain.trace[0], chain.trace[1], 0});
        if (key == keys.end() || std::get<0>(*key) != chain.trace[0] || std::get<1>(*key) != chain.trace[1])
            continue;
        const Chain& same = low.graph_.chains[std::get<2>(*key)];
        if (chain.rank != same.rank || chain.trace != same.trace || chain.closed != same.closed ||
            !can_adopt(chain, adopted))
            continue;
        adopt_chain(c, low, std::get<2>(*key));
        adopted[c] = true;
    }
}

void WallDrawing::adopt_chain(std::uint32_t c, WallDrawing& low, std::uint32_t low_chain) {
    State& state = states_[c];
    state = std::move(low.states_[low_chain]);
    const Chain& chain = graph_.chains[c];
    const Chain& same = low.graph_.chains[low_chain];
    const Course low_course = std::move(state.course);
    state.course = {};
    if (state.drawn == Form::fitted)
        state.course = Course(low_course.drawn(), chain, *state.samples, options_.shape);
    // Its nodes are nodes here as well, at the same steps.
    std::size_t k = 0;
    for (std::size_t of_low = 0; of_low < same.nodes.size(); ++of_low) {
        const bool last = of_low + 1 == same.nodes.size();
        if (chain.closed && last)
            break;
        while (k + 1 < chain.nodes.size() && chain.node_steps[k] != same.node_steps[of_low])
            ++k;
        plain_[chain.nodes[k]] = low.plain_[same.nodes[of_low]];
        if (state.drawn == Form::fitted && low_course.node(of_low) &&
            chain.node_steps[k] == same.node_steps[of_low])
            state.course.place_as(k, low_course, of_low);
    }
}

}  // namespace d2b
