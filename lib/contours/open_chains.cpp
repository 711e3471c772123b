#include "contours/open_chains.hpp"

#include <algorithm>

namespace d2b::contours {

std::uint32_t OpenChains::add_node(const Corner& corner, std::uint32_t next) {
    if (free_node_ == no_index) {
        nodes_.push_back({corner, next});
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    const std::uint32_t node = free_node_;
    free_node_ = nodes_[node].next;
    nodes_[node] = {corner, next};
    return node;
}

std::uint32_t OpenChains::add_end(std::uint32_t node) {
    if (free_end_ == no_index) {
        ends_.push_back({node, no_index, nothing_outside});
        return static_cast<std::uint32_t>(ends_.size() - 1);
    }
    const std::uint32_t chain_end = free_end_;
    free_end_ = ends_[chain_end].mate;
    ends_[chain_end] = {node, no_index, nothing_outside};
    return chain_end;
}

void OpenChains::free_end(std::uint32_t chain_end) {
    ends_[chain_end].mate = free_end_;
    free_end_ = chain_end;
}

/// @param first, last nodes of a chain
OpenChains::Pair OpenChains::add_ends(std::uint32_t first, std::uint32_t last) {
    const Pair pair{add_end(first), add_end(last)};
    ends_[pair.tail].mate = pair.head;
    ends_[pair.head].mate = pair.tail;
    return pair;
}

OpenChains::Pair OpenChains::open(Corner tail, Corner head) {
    const std::uint32_t last = add_node(head, no_index);
    const std::uint32_t first = add_node(tail, last);
    return add_ends(first, last);
}

void OpenChains::extend_head(std::uint32_t chain_end, Corner turn, Corner down) {
    ChainEnd& head = ends_[chain_end];
    turn.outside = head.outside;
    const std::uint32_t last = add_node(down, no_index);
    const std::uint32_t before = add_node(turn, last);
    nodes_[head.node].next = before;
    head.node = last;
    head.outside = nothing_outside;
}

void OpenChains::extend_tail(std::uint32_t chain_end, Corner turn, Corner down) {
    ChainEnd& tail = ends_[chain_end];
    // The chain runs down -> turn -> previous first corner; the horizontal edge leads to `turn`.
    set_outside(tail.node, tail.outside);
    turn.outside = down.outside;
    down.outside = nothing_outside;
    tail.node = add_node(down, add_node(turn, tail.node));
    tail.outside = nothing_outside;
}

std::span<const Corner> OpenChains::join(std::uint32_t head, Corner turn, Corner up, std::uint32_t tail) {
    extend_head(head, turn, up);
    return connect(head, tail);
}

std::span<const Corner> OpenChains::connect(std::uint32_t head, std::uint32_t tail) {
    const std::uint32_t first = ends_[tail].node;
    const std::uint32_t last = ends_[head].node;
    set_outside(first, std::min(ends_[head].outside, ends_[tail].outside));
    const std::uint32_t other_tail = ends_[head].mate;
    const std::uint32_t other_head = ends_[tail].mate;
    free_end(head);
    free_end(tail);
    if (other_tail == tail)
        return take_ring(first, last);
    nodes_[last].next = first;
    ends_[other_tail].mate = other_head;
    ends_[other_head].mate = other_tail;
    return {};
}

OpenChains::Sides OpenChains::open_above(LatticePoint left, LatticePoint right) {
    const auto side = [this](LatticePoint at) {
        const std::uint32_t node = add_node({at}, no_index);
        return add_ends(node, node);
    };
    const Pair down = side(left);
    const Pair up = side(right);
    return {{up.tail, down.head}, {down.tail, up.head}};
}

OpenChains::Pair OpenChains::add(std::span<const Corner> corners, double tail_outside, double head_outside) {
    std::uint32_t node = add_node(corners.back(), no_index);
    const std::uint32_t last = node;
    for (std::size_t i = corners.size() - 1; i-- > 0;)
        node = add_node(corners[i], node);
    const Pair pair = add_ends(node, last);
    add_outside(pair.tail, tail_outside);
    add_outside(pair.head, head_outside);
    return pair;
}

std::uint32_t OpenChains::copy_chain(std::uint32_t tail, std::vector<Corner>& to) const {
    for (std::uint32_t node = ends_[tail].node; node != no_index; node = nodes_[node].next)
        to.push_back(nodes_[node].corner);
    return ends_[tail].mate;
}

std::span<const Corner> OpenChains::take_ring(std::uint32_t first, std::uint32_t last) {
    ring_.clear();
    for (std::uint32_t node = first; node != no_index; node = nodes_[node].next)
        ring_.push_back(nodes_[node].corner);
    nodes_[last].next = free_node_;
    free_node_ = first;
    return ring_;
}

}  // namespace d2b::contours
