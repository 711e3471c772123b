#include "outline/walls/chain_tracer.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace d2b {

void ChainTracer::trace(Chain& chain) {
    gather(chain);
    if (runs_backwards(chain)) {
        reverse(chain);
        gather(chain);
    }
    rotate(chain);
    find_nodes(chain);
    find_corners(chain);
}

void ChainTracer::gather(const Chain& chain) {
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

bool ChainTracer::runs_backwards(const Chain& chain) const {
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

}  // namespace d2b
