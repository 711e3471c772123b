#include "outline/walls/draw_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr double sagitta = 0.05;      // cells between a circle and its polygon
constexpr double least_sine = 0.2;    // walls at a smaller angle do not intersect
constexpr double largest_kink = 0.6;  // cells: parallel walls closer than this are joined into one line

double off(const WallPiece& piece, Vec p) {
    return piece.circle ? piece.circle->off(p) : piece.line.off(p);
}
Vec foot(const WallPiece& piece, Vec p) {
    return piece.circle ? piece.circle->foot(p) : piece.line.foot(p);
}

std::optional<Vec> crossing(const Line& a, const Line& b) {
    const double sine = cross(a.along, b.along);
    if (std::abs(sine) < least_sine)
        return {};
    return a.through + cross(b.through - a.through, b.along) / sine * a.along;
}

/// Intersection of a line and a circle nearest to a point.
std::optional<Vec> crossing(const Line& line, const Circle& circle, Vec near) {
    const Vec middle = line.foot(circle.centre);
    const double square = circle.radius * circle.radius - dot(middle - circle.centre, middle - circle.centre);
    if (square < 0)
        return {};
    const Vec half = std::sqrt(square) * line.along;
    return length(middle + half - near) < length(middle - half - near) ? middle + half : middle - half;
}

std::optional<Vec> crossing(const WallPiece& a, const WallPiece& b, Vec near) {
    if (a.circle && b.circle)
        return {};
    if (a.circle)
        return crossing(b.line, *a.circle, near);
    if (b.circle)
        return crossing(a.line, *b.circle, near);
    return crossing(a.line, b.line);
}

/// Draws one chain.
class Drawer {
  public:
    Drawer(const WallSamples& samples, const WallStyle& style, const CellShape& shape, LatticePoint origin)
        : samples_(samples), style_(style), shape_(shape), origin_(origin) {}

    void add(Vec place, std::size_t step) { chain_.add(shape_.to_fine(place, origin_), step); }
    /// Joint of two walls: one vertex, or the end of the first and the beginning of the second.
    [[nodiscard]] std::pair<Vec, std::optional<Vec>> joint(const WallPiece& a, const WallPiece& b) const;
    void add_joint(const std::pair<Vec, std::optional<Vec>>& joint, std::size_t step) {
        add(joint.first, step);
        if (joint.second)
            add(*joint.second, step);
    }
    /// Appends all vertices of a wall after its first, which has already been added.
    void add_wall(const std::vector<WallPiece>& pieces, std::size_t i, const std::optional<ChainEnds>& ends);
    void whole_circle(const WallPiece& piece);
    DrawnChain& chain() { return chain_; }
    void reserve(std::size_t vertices) {
        chain_.vertices.reserve(vertices);
        chain_.steps.reserve(vertices);
    }

  private:
    void round_off(const WallPiece& piece, std::size_t first_vertex);

    const WallSamples& samples_;
    const WallStyle& style_;
    const CellShape& shape_;
    LatticePoint origin_;
    DrawnChain chain_;
};

std::pair<Vec, std::optional<Vec>> Drawer::joint(const WallPiece& a, const WallPiece& b) const {
    const Vec turn = samples_.at(b.first);
    const std::optional<Vec> sharp = crossing(a, b, turn);
    if (sharp && length(*sharp - turn) <= std::max(1.0, style_.tolerance))
        return {*sharp, {}};
    const Vec end = foot(a, turn);
    const Vec begin = foot(b, turn);
    if (length(end - begin) <= largest_kink)
        return {0.5 * (end + begin), {}};
    return {end, begin};
}

void Drawer::add_wall(const std::vector<WallPiece>& pieces, std::size_t i,
                      const std::optional<ChainEnds>& ends) {
    const WallPiece& piece = pieces[i];
    const std::size_t first_vertex = chain_.vertices.size() - 1;
    if (i + 1 < pieces.size()) {
        const auto next = joint(piece, pieces[i + 1]);
        add(next.first, piece.last);
        if (piece.circle && chain_.vertices.size() == first_vertex + 2)
            round_off(piece, first_vertex);
        if (next.second)
            add(*next.second, piece.last);
    } else if (ends) {
        add(shape_.from_fine(ends->last, origin_), samples_.steps());
        if (piece.circle)
            round_off(piece, first_vertex);
    } else if (piece.circle && chain_.vertices.size() > 1) {
        add(shape_.from_fine(chain_.vertices.front(), origin_), piece.last);
        round_off(piece, first_vertex);
        chain_.remove_last();
    }
}

/// Inserts vertices between the last two, on the circle through them and the midpoint of the arc.
void Drawer::round_off(const WallPiece& piece, std::size_t first_vertex) {
    const Vec from = shape_.from_fine(chain_.vertices[first_vertex], origin_);
    const Vec to = shape_.from_fine(chain_.vertices.back(), origin_);
    const Vec middle = piece.circle->foot(samples_.at((piece.first + piece.last) / 2));
    const std::optional<Circle> circle = circle_through(from, middle, to);
    if (!circle)
        return;
    const auto angle = [&](Vec p) { return std::atan2(p.y - circle->centre.y, p.x - circle->centre.x); };
    const double turn = cross(middle - from, to - middle) > 0 ? 1 : -1;
    double sweep = turn * (angle(to) - angle(from));
    sweep -= std::floor(sweep / (2 * std::numbers::pi)) * 2 * std::numbers::pi;
    const double step = 2 * std::acos(std::max(0.0, 1 - sagitta / circle->radius));
    // Even, so that one vertex is the midpoint of the arc.
    const auto edges = std::max<std::size_t>(2, 2 * static_cast<std::size_t>(std::ceil(sweep / step / 2)));
    const FinePoint last = chain_.vertices.back();
    chain_.remove_last();
    for (std::size_t k = 1; k < edges; ++k) {
        const double at = angle(from) + turn * sweep * static_cast<double>(k) / static_cast<double>(edges);
        add(circle->centre + circle->radius * Vec{std::cos(at), std::sin(at)},
            piece.first + (piece.last - piece.first) * k / edges);
    }
    chain_.arcs.push_back({0, static_cast<std::uint32_t>(first_vertex), static_cast<std::uint32_t>(edges)});
    chain_.vertices.push_back(last);
    chain_.steps.push_back(piece.last);
}

void Drawer::whole_circle(const WallPiece& piece) {
    const Circle& circle = *piece.circle;
    const double step = 2 * std::acos(std::max(0.0, 1 - sagitta / circle.radius));
    const auto edges = 4 * static_cast<std::size_t>(std::ceil(std::numbers::pi / 2 / step));
    const Vec from = samples_.at(piece.first) - circle.centre;
    const double begin = std::atan2(from.y, from.x);
    const double turn = twice_area(samples_) > 0 ? 1 : -1;
    std::size_t at_step = piece.first;
    for (std::size_t k = 0; k < edges; ++k) {
        const double at =
            begin + turn * 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(edges);
        const Vec place = circle.centre + circle.radius * Vec{std::cos(at), std::sin(at)};
        // Advance along the trace together with the circle.
        const std::size_t reach =
            std::min(piece.first + samples_.steps(), at_step + 2 * samples_.steps() / edges + 2);
        for (std::size_t i = at_step; i < reach; ++i)
            if (length(samples_.at(i) - place) < length(samples_.at(at_step) - place))
                at_step = i;
        add(place, at_step);
    }
    const auto half = static_cast<std::uint32_t>(edges / 2);
    chain_.arcs = {{0, 0, half}, {0, half, half}};
}

}  // namespace

void settle_ends(const WallSamples& samples, std::vector<WallPiece>& pieces) {
    constexpr std::size_t reach = 6;
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        WallPiece& a = pieces[k - 1];
        WallPiece& b = pieces[k];
        const std::size_t low = std::max(a.first + 1, b.first > reach ? b.first - reach : 0);
        const std::size_t high = std::min(b.last - 1, b.first + reach);
        // Residual for ending at each step, relative to ending at `low`.
        double sum = 0;
        double least = 0;
        std::size_t best = low;
        for (std::size_t end = low; end < high; ++end) {
            const Vec middle = 0.5 * (samples.at(end) + samples.at(end + 1));
            sum += std::pow(off(a, middle), 2) - std::pow(off(b, middle), 2);
            if (sum < least) {
                least = sum;
                best = end + 1;
            }
        }
        if (low < high) {
            a.last = best;
            b.first = best;
        }
    }
    for (WallPiece& piece : pieces) {
        const WallSamples::Sums sums = samples.sums(piece.first, piece.last);
        piece.line.through = sums.mean;
        if (piece.family == WallPiece::free)
            piece.line.along = sums.direction();
    }
}

DrawnChain draw_walls(const WallSamples& samples, const WallStyle& style, const CellShape& shape,
                      LatticePoint origin, const std::vector<WallPiece>& pieces,
                      const std::optional<ChainEnds>& ends) {
    Drawer drawer(samples, style, shape, origin);
    drawer.reserve(2 * pieces.size() + 2);
    if (pieces.size() == 1 && pieces.front().circle && !ends) {
        drawer.whole_circle(pieces.front());
    } else {
        if (ends)
            drawer.add(shape.from_fine(ends->first, origin), 0);
        else
            drawer.add_joint(drawer.joint(pieces.back(), pieces.front()), pieces.front().first);
        for (std::size_t i = 0; i < pieces.size(); ++i)
            drawer.add_wall(pieces, i, ends);
    }
    match_trace(samples, shape, origin, drawer.chain());
    return std::move(drawer.chain());
}

}  // namespace d2b
