#include "outline/walls/middles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace d2b {
namespace {

constexpr double middles_reach = 0.6;     // cells
constexpr double close_reach = 0.45;      // cells
constexpr std::size_t longest_line = 64;  // candidates that an edge may span
constexpr std::size_t vain = 8;           // consecutive edges that do not fit before the search stops
constexpr double price_of_vertex = 20;    // square cells: prefers fewer vertices, then closer ones
constexpr double too_far = std::numeric_limits<double>::infinity();

bool is_turn(double turn) {
    return std::abs(turn) > 0.5;  // cross product of unit steps in a cell of area 1: -1, 0 or 1
}

}  // namespace

Middles::Middles(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                 const std::vector<std::uint32_t>& node_steps, double tolerance)
    : samples_(samples),
      shape_(shape),
      origin_(origin),
      node_steps_(node_steps),
      tolerance_(tolerance),
      cuts_corners_(cuts_corners(shape, tolerance)) {}

/// Turn before a step; 0 at the ends of an open chain.
double Middles::turn(std::size_t step) const {
    const std::size_t n = samples_.steps();
    if (!samples_.closed() && (step == 0 || step >= n))
        return 0;
    return cross(unit(step + (samples_.closed() ? n : 0) - 1), unit(step));
}

/// Nodes of a closed chain may have steps beyond its first lap.
bool Middles::is_node(std::size_t step) const {
    const std::size_t n = samples_.steps();
    const auto stands = [&](std::size_t s) {
        return std::ranges::binary_search(node_steps_, static_cast<std::uint32_t>(s));
    };
    return samples_.closed() ? stands(step % n) || stands(step % n + n) : stands(step);
}

/// Returns true if a lattice corner may be a vertex: any corner except those of staircases, which alternate
/// between left and right turns.
bool Middles::stays(std::size_t step, Form form) const {
    if (form == Form::cut && is_node(step))
        return true;
    const double here = turn(step);
    if (!is_turn(here))
        return false;
    if (form == Form::cut && !cuts_corners_)
        return true;
    const std::size_t n = samples_.steps();
    const std::size_t before = samples_.closed() ? step + n - 1 : step - 1;
    return !(turn(before % (samples_.closed() ? n : n + 1)) * here < -0.25 || turn(step + 1) * here < -0.25);
}

std::vector<Middles::Candidate> Middles::candidates(const ChainForm::Stretch& stretch) const {
    const bool whole = samples_.closed() && stretch.last - stretch.first == samples_.steps();
    std::vector<Candidate> points;
    points.reserve(stretch.last - stretch.first + 8);
    for (std::size_t k = stretch.first; k < stretch.last; ++k) {
        if ((k > stretch.first || whole) && stays(k, stretch.form))
            points.push_back({samples_.at(k), k, true, stretch.form == Form::cut && is_node(k)});
        points.push_back({0.5 * (samples_.at(k) + samples_.at(k + 1)), k, false, false});
    }
    return points;
}

/// Sum of squared distances between the corners of the trace and the edge joining two candidates.
double Middles::error(const Candidate& from, const Candidate& to, double limit) const {
    double sum = 0;
    samples_.for_corners(from.step + 1, to.step, [&](std::size_t, Vec corner) {
        const double square = square_distance(corner, from.place, to.place);
        sum = square > limit * limit ? too_far : sum + square;
        return sum < too_far;
    });
    return sum;
}

/// Selects the fewest candidates, and among these the closest, whose edges stay within a limit of the trace,
/// by dynamic programming. Keeps the first and the last one.
void Middles::thin(std::vector<Candidate>& points, double limit) const {
    struct State {
        double cost = too_far;
        std::size_t from = 0;
    };
    std::vector<State> states(points.size());
    states[0].cost = 0;
    for (std::size_t to = 1; to < points.size(); ++to) {
        std::size_t in_vain = 0;
        for (std::size_t from = to; from-- > 0 && to - from <= longest_line && in_vain < vain;) {
            // Consecutive candidates may always be joined, because the trace between them is a corner being
            // cut off.
            const double squares = from + 1 == to ? 0 : error(points[from], points[to], limit);
            if (squares == too_far) {
                ++in_vain;
                continue;
            }
            const double cost = states[from].cost + price_of_vertex + squares;
            if (cost < states[to].cost)
                states[to] = {cost, from};
        }
    }
    std::vector<Candidate> left;
    for (std::size_t at = points.size() - 1; at > 0; at = states[at].from)
        left.push_back(points[at]);
    left.push_back(points.front());
    points.assign(left.rbegin(), left.rend());
}

/// Removes candidates on the line between their neighbours.
void Middles::straighten(std::vector<Candidate>& points) {
    std::vector<Candidate> left;
    left.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool inner = i > 0 && i + 1 < points.size() && !points[i].kept;
        if (inner && std::abs(cross(points[i].place - left.back().place,
                                    points[i + 1].place - points[i].place)) < 1e-9)
            continue;
        left.push_back(points[i]);
    }
    points = std::move(left);
}

void Middles::append(const ChainForm::Stretch& stretch, const FinePoint* end, DrawnChain& chain) const {
    std::vector<Candidate> points = candidates(stretch);
    const bool whole = samples_.closed() && stretch.last - stretch.first == samples_.steps();
    const bool from_start = !samples_.closed() && stretch.first == 0;
    if (from_start)
        points.insert(points.begin(), {shape_.from_fine(chain.vertices.back(), origin_), 0, true, true});
    if (end != nullptr)
        points.push_back({shape_.from_fine(*end, origin_), stretch.last, true, true});
    if (whole) {
        points.push_back(points.front());
        points.back().step += samples_.steps();
    }
    if (stretch.form == Form::cut)
        straighten(points);
    else
        thin(points, std::min(tolerance_, stretch.form == Form::middles ? middles_reach : close_reach));
    if (whole)
        points.pop_back();
    for (std::size_t i = from_start ? 1 : 0; i < points.size(); ++i) {
        const bool last = end != nullptr && i + 1 == points.size();
        const FinePoint vertex = last ? *end : shape_.to_fine(points[i].place, origin_);
        chain.add(vertex, points[i].step);
    }
}

}  // namespace d2b
