#include "trace/arms.hpp"

#include <algorithm>

namespace d2b {

std::uint32_t Arms::add_node(const Corner& corner, std::uint32_t next) {
    if (free_node_ == no_index) {
        nodes_.push_back({corner, next});
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    const std::uint32_t node = free_node_;
    free_node_ = nodes_[node].next;
    nodes_[node] = {corner, next};
    return node;
}

std::uint32_t Arms::add_arm(std::uint32_t node) {
    if (free_arm_ == no_index) {
        arms_.push_back({node, no_index, nothing_outside});
        return static_cast<std::uint32_t>(arms_.size() - 1);
    }
    const std::uint32_t arm = free_arm_;
    free_arm_ = arms_[arm].mate;
    arms_[arm] = {node, no_index, nothing_outside};
    return arm;
}

void Arms::free_arm(std::uint32_t arm) {
    arms_[arm].mate = free_arm_;
    free_arm_ = arm;
}

Arms::Pair Arms::open(Corner tail, Corner head) {
    const std::uint32_t last = add_node(head, no_index);
    const std::uint32_t first = add_node(tail, last);
    const Pair pair{add_arm(first), add_arm(last)};
    arms_[pair.tail].mate = pair.head;
    arms_[pair.head].mate = pair.tail;
    return pair;
}

void Arms::extend_head(std::uint32_t arm, Corner turn, Corner down) {
    Arm& head = arms_[arm];
    turn.outside = head.outside;
    const std::uint32_t last = add_node(down, no_index);
    const std::uint32_t before = add_node(turn, last);
    nodes_[head.node].next = before;
    head.node = last;
    head.outside = nothing_outside;
}

void Arms::extend_tail(std::uint32_t arm, Corner turn, Corner down) {
    Arm& tail = arms_[arm];
    // The chain runs down -> turn -> previous first corner; the horizontal edge leads to `turn`.
    set_outside(tail.node, tail.outside);
    turn.outside = down.outside;
    down.outside = nothing_outside;
    tail.node = add_node(down, add_node(turn, tail.node));
    tail.outside = nothing_outside;
}

std::span<const Corner> Arms::join(std::uint32_t head, Corner turn, Corner up, std::uint32_t tail) {
    extend_head(head, turn, up);
    return connect(head, tail);
}

std::span<const Corner> Arms::connect(std::uint32_t head, std::uint32_t tail) {
    const std::uint32_t first = arms_[tail].node;
    const std::uint32_t last = arms_[head].node;
    set_outside(first, std::min(arms_[head].outside, arms_[tail].outside));
    const std::uint32_t other_tail = arms_[head].mate;
    const std::uint32_t other_head = arms_[tail].mate;
    free_arm(head);
    free_arm(tail);
    if (other_tail == tail)
        return take_ring(first, last);
    nodes_[last].next = first;
    arms_[other_tail].mate = other_head;
    arms_[other_head].mate = other_tail;
    return {};
}

Arms::Sides Arms::open_above(LatticePoint left, LatticePoint right) {
    const auto side = [this](LatticePoint at) {
        const std::uint32_t node = add_node({at}, no_index);
        const Pair pair{add_arm(node), add_arm(node)};
        arms_[pair.tail].mate = pair.head;
        arms_[pair.head].mate = pair.tail;
        return pair;
    };
    const Pair down = side(left);
    const Pair up = side(right);
    return {{up.tail, down.head}, {down.tail, up.head}};
}

Arms::Pair Arms::add(std::span<const Corner> corners, double tail_outside, double head_outside) {
    std::uint32_t node = add_node(corners.back(), no_index);
    const std::uint32_t last = node;
    for (std::size_t i = corners.size() - 1; i-- > 0;)
        node = add_node(corners[i], node);
    const Pair pair{add_arm(node), add_arm(last)};
    arms_[pair.tail].mate = pair.head;
    arms_[pair.head].mate = pair.tail;
    pass(pair.tail, tail_outside);
    pass(pair.head, head_outside);
    return pair;
}

std::uint32_t Arms::copy_chain(std::uint32_t tail, std::vector<Corner>& to) const {
    for (std::uint32_t node = arms_[tail].node; node != no_index; node = nodes_[node].next)
        to.push_back(nodes_[node].corner);
    return arms_[tail].mate;
}

std::span<const Corner> Arms::take_ring(std::uint32_t first, std::uint32_t last) {
    ring_.clear();
    for (std::uint32_t node = first; node != no_index; node = nodes_[node].next)
        ring_.push_back(nodes_[node].corner);
    nodes_[last].next = free_node_;
    free_node_ = first;
    return ring_;
}

}  // namespace d2b
