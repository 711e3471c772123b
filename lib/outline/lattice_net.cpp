#include "outline/lattice_net.hpp"

#include <algorithm>
#include <utility>

namespace d2b {
namespace {

constexpr std::uint32_t sign_bit = 0x80000000U;

/// Key that sorts like the pair (first, second).
std::uint64_t sort_key(std::int32_t first, std::int32_t second) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(first) ^ sign_bit) << 32 |
           (static_cast<std::uint32_t>(second) ^ sign_bit);
}

}  // namespace

LatticeNet::LatticeNet(std::span<const Contour* const> contours, const StopRequest& stop) {
    std::vector<LatticePoint> corners;
    std::vector<std::size_t> ends;
    std::size_t count = 0;
    for (const Contour* contour : contours) {
        count += contour->exterior.corner_count();
        for (const PackedRing& ring : contour->interiors)
            count += ring.corner_count();
    }
    corners.reserve(count);
    const auto add = [&](const PackedRing& packed) {
        stop.check();
        const LatticeRing ring = packed.corners();
        corners.insert(corners.end(), ring.begin(), ring.end());
        ends.push_back(corners.size());
    };
    for (const Contour* contour : contours) {
        add(contour->exterior);
        for (const PackedRing& ring : contour->interiors)
            add(ring);
    }
    stop.check();
    const std::vector<Vertex> numbers = number_corners(corners, stop);
    stop.check();
    order_columns();
    ways_.assign(points_.size(), 0);
    vertices_.reserve(numbers.size() + numbers.size() / 4);
    first_.reserve(ends.size() + 1);
    first_.push_back(0);
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
        stop.check();
        for (std::size_t i = begin; i < end; ++i)
            append_edge(numbers[i], numbers[i + 1 < end ? i + 1 : begin]);
        first_.push_back(vertices_.size());
        begin = end;
    }
}

/// @return vertex per corner
std::vector<LatticeNet::Vertex> LatticeNet::number_corners(const std::vector<LatticePoint>& corners,
                                                           const StopRequest& stop) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(corners.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        order[i] = {sort_key(corners[i].row, corners[i].col), i};
    stop.check();
    std::sort(order.begin(), order.end());
    stop.check();
    std::vector<Vertex> numbers(corners.size());
    points_.reserve(corners.size());
    for (const auto& [place, corner] : order) {
        if (points_.empty() || points_.back() != corners[corner])
            points_.push_back(corners[corner]);
        numbers[corner] = static_cast<Vertex>(points_.size() - 1);
    }
    return numbers;
}

void LatticeNet::order_columns() {
    std::vector<std::pair<std::uint64_t, Vertex>> order(points_.size());
    for (Vertex v = 0; v < points_.size(); ++v)
        order[v] = {sort_key(points_[v].col, points_[v].row), v};
    std::sort(order.begin(), order.end());
    by_col_.resize(points_.size());
    place_in_col_.resize(points_.size());
    for (Vertex place = 0; place < order.size(); ++place) {
        by_col_[place] = order[place].second;
        place_in_col_[order[place].second] = place;
    }
}

LatticeNet::Way LatticeNet::way(Vertex from, Vertex to) const {
    if (points_[from].row == points_[to].row)
        return from < to ? Way::east : Way::west;
    return from < to ? Way::south : Way::north;
}

/// Appends all vertices from one corner to the next, exclusive.
void LatticeNet::append_edge(Vertex from, Vertex to) {
    const Way forwards = way(from, to);
    const bool along_row = points_[from].row == points_[to].row;
    const auto ahead = static_cast<std::uint8_t>(1U << static_cast<unsigned>(forwards));
    const auto behind = static_cast<std::uint8_t>(1U << (static_cast<unsigned>(forwards) ^ 2U));
    const auto next = [&](Vertex v) {
        if (along_row)
            return from < to ? v + 1 : v - 1;
        return by_col_[from < to ? place_in_col_[v] + 1 : place_in_col_[v] - 1];
    };
    for (Vertex v = from; v != to;) {
        vertices_.push_back(v);
        ways_[v] |= ahead;
        v = next(v);
        ways_[v] |= behind;
    }
}

}  // namespace d2b
