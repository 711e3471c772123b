#include "outline/walls/circular_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace d2b {
namespace {

constexpr double arc_price = 3.2;  // of an arc: more than a wall, less than two
constexpr double bargain = 0.6;  // share of the cost of walls that an arc may have: ragged walls are no arcs
constexpr double least_radius = 3;  // cells
constexpr double least_sweep = std::numbers::pi / 2;
constexpr std::size_t fewest_walls = 4;  // that an arc stands for

/// An arc in place of some walls, where it is the cheaper description.
std::optional<WallPiece> arc_for(const WallSamples& samples, const WallStyle& style, std::size_t first,
                                 std::size_t last, double walls_cost) {
    const std::optional<Circle> circle = fit_circle(samples, first, last);
    if (!circle || circle->radius < least_radius)
        return {};
    double squares = 0;
    double largest = 0;
    for (std::size_t i = first; i < last; ++i) {
        squares += std::pow(circle->off(0.5 * (samples.at(i) + samples.at(i + 1))), 2);
        largest = std::max(largest, std::abs(circle->off(samples.at(i))));
        if (largest > style.tolerance - 0.05)
            return {};
    }
    const double cost = style.price * arc_price + style.misfit(squares, static_cast<double>(last - first));
    const double sweep =
        static_cast<double>(last - first) / 1.27 / circle->radius;  // a staircase is 4 / pi longer
    if (cost > bargain * walls_cost || sweep < least_sweep)
        return {};
    return WallPiece{first, last, WallPiece::free, {}, circle, cost};
}

/// The way that two walls turn: 1 or -1, or 0 where they turn too much or not at all for an arc.
int turn(const WallPiece& a, const WallPiece& b) {
    const Vec from = a.line.along;
    const Vec to = b.line.along;
    const double sine = cross(from, to);
    if (dot(from, to) < std::cos(std::numbers::pi / 3) || std::abs(sine) < 0.02)
        return 0;
    return sine > 0 ? 1 : -1;
}

/// Past the longest run of walls from one on that turn one way and not much more than once round: no arc is
/// longer, and a spiral would be looked through from each of its walls to its end.
std::size_t end_of_turn(const std::vector<WallPiece>& pieces, std::size_t i) {
    constexpr double most = 3 * std::numbers::pi;
    std::size_t end = i + 1;
    for (double angle = 0; end < pieces.size() && angle < most; ++end) {
        const int way = turn(pieces[end - 1], pieces[end]);
        if (way == 0 || way != turn(pieces[i], pieces[i + 1]))
            break;
        angle +=
            std::asin(std::min(1.0, std::abs(cross(pieces[end - 1].line.along, pieces[end].line.along))));
    }
    return end;
}

}  // namespace

void find_circular_arcs(const WallSamples& samples, const WallStyle& style, std::vector<WallPiece>& pieces,
                        const StopRequest& stop) {
    if (style.walls != Walls::automatic || pieces.size() < fewest_walls)
        return;
    double cost = 0;
    for (const WallPiece& piece : pieces)
        cost += piece.cost;
    if (samples.closed())
        if (const auto circle =
                arc_for(samples, style, pieces.front().first, pieces.front().first + samples.steps(), cost)) {
            pieces = {*circle};
            return;
        }
    std::vector<WallPiece> result;
    for (std::size_t i = 0; i < pieces.size();) {
        std::size_t end = end_of_turn(pieces, i);
        std::optional<WallPiece> arc;
        for (; !arc && end >= i + fewest_walls; --end) {
            stop.check();
            double replaced = 0;
            for (std::size_t k = i; k < end; ++k)
                replaced += pieces[k].cost;
            arc = arc_for(samples, style, pieces[i].first, pieces[end - 1].last, replaced);
            if (arc)
                break;
        }
        result.push_back(arc ? *arc : pieces[i]);
        i = arc ? end : i + 1;
    }
    pieces = std::move(result);
}

}  // namespace d2b
