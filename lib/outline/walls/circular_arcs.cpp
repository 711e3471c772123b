#include "outline/walls/circular_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace d2b {
namespace {

constexpr double arc_price = 3.2;  // cost of an arc: more than a wall, less than two
constexpr double bargain =
    0.6;  // largest cost relative to that of the walls replaced, because ragged walls are not arcs
constexpr double least_radius = 3;  // cells
constexpr double least_sweep = std::numbers::pi / 2;
constexpr std::size_t fewest_walls = 4;  // fewest walls that an arc replaces

/// Returns an arc to replace a run of walls if it is the cheaper description.
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
        static_cast<double>(last - first) / 1.27 / circle->radius;  // a staircase is 4 / pi times longer
    if (cost > bargain * walls_cost || sweep < least_sweep)
        return {};
    return WallPiece{first, last, WallPiece::free, {}, circle, cost};
}

/// Direction of the turn between two walls: 1 or -1, or 0 if the turn is too sharp or too slight for an arc.
int turn(const WallPiece& a, const WallPiece& b) {
    const Vec from = a.line.along;
    const Vec to = b.line.along;
    const double sine = cross(from, to);
    if (dot(from, to) < std::cos(std::numbers::pi / 3) || std::abs(sine) < 0.02)
        return 0;
    return sine > 0 ? 1 : -1;
}

/// Returns the end of the longest run of walls from i that turn the same way, limited to one and a half
/// turns: no arc is longer, and a spiral would otherwise be searched to its end from each of its walls.
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
