#include "outline/walls/chain_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace d2b::outline {
namespace {

/// Step in [low, high] nearest to a point.
std::size_t nearest_step(const TraceSums& samples, Vec2 place, std::size_t low, std::size_t high) {
    std::size_t best = low;
    const auto square = [&](std::size_t i) { return dot(samples.at(i) - place, samples.at(i) - place); };
    double least = square(low);
    for (std::size_t i = low + 1; i <= high; ++i) {
        const double away = square(i);
        if (away < least) {
            least = away;
            best = i;
        }
    }
    return best;
}

constexpr double sagitta = 0.2;          // cells between a circle and its polygon
constexpr double min_sine = 0.2;         // walls at a smaller angle do not intersect
constexpr double frame_sine = 0.05;      // same with the edge of the raster, which is exact
constexpr std::size_t corner_reach = 8;  // steps before and behind the end of a wall
constexpr double max_kink = 0.6;         // cells: parallel walls closer than this are joined into one line

Vec2 project(const WallSegment& segment, Vec2 p) {
    return segment.circle ? segment.circle->project(p) : segment.line.project(p);
}

/// Intersection of a line and a circle nearest to a point.
std::optional<Vec2> crossing(const Line2& line, const Circle& circle, Vec2 near) {
    const Vec2 middle = line.project(circle.centre);
    const double square = circle.radius * circle.radius - dot(middle - circle.centre, middle - circle.centre);
    if (square < 0)
        return {};
    const Vec2 half = std::sqrt(square) * line.along;
    return length(middle + half - near) < length(middle - half - near) ? middle + half : middle - half;
}

std::optional<Vec2> crossing(const WallSegment& a, const WallSegment& b, Vec2 near) {
    if (a.circle && b.circle)
        return {};
    if (a.circle)
        return crossing(b.line, *a.circle, near);
    if (b.circle)
        return crossing(a.line, *b.circle, near);
    return crossing(a.line, b.line, a.on_frame || b.on_frame ? frame_sine : min_sine);
}

/// Draws one chain.
class Drawer {
  public:
    Drawer(const TraceSums& samples, const WallParameters& parameters)
        : samples_(samples), parameters_(parameters) {}

    void add(Vec2 place, std::size_t step) { chain_.add(samples_.to_fine(place), step); }
    /// Joint of two walls: one vertex, or the end of the first and the beginning of the second.
    [[nodiscard]] std::pair<Vec2, std::optional<Vec2>> joint(const WallSegment& a,
                                                             const WallSegment& b) const;
    void add_joint(const std::pair<Vec2, std::optional<Vec2>>& joint, std::size_t step) {
        add(joint.first, step);
        if (joint.second)
            add(*joint.second, step);
    }
    /// Appends all vertices of a wall after its first, which has already been added.
    void add_wall(const std::vector<WallSegment>& segments, std::size_t i,
                  const std::optional<ChainEnds>& ends);
    void add_circle(const WallSegment& segment);
    ChainPolyline& chain() { return chain_; }
    void reserve(std::size_t vertices) {
        chain_.vertices.reserve(vertices);
        chain_.steps.reserve(vertices);
    }

  private:
    void add_arc_vertices(const WallSegment& segment, std::size_t first_vertex);

    const TraceSums& samples_;
    const WallParameters& parameters_;
    ChainPolyline chain_;
};

std::pair<Vec2, std::optional<Vec2>> Drawer::joint(const WallSegment& a, const WallSegment& b) const {
    const Vec2 turn = samples_.at(b.first);
    const std::optional<Vec2> sharp = crossing(a, b, turn);
    if (sharp) {
        const std::size_t low = a.last - std::min(a.last - a.first, corner_reach);
        const std::size_t high = a.last + std::min(b.last - b.first, corner_reach);
        const std::size_t near = nearest_step(samples_, *sharp, low, high);
        if (length(*sharp - samples_.at(near)) <= std::max(1.0, parameters_.tolerance))
            return {*sharp, {}};
    }
    const Vec2 end = project(a, turn);
    const Vec2 begin = project(b, turn);
    if (length(end - begin) <= max_kink)
        return {0.5 * (end + begin), {}};
    return {end, begin};
}

void Drawer::add_wall(const std::vector<WallSegment>& segments, std::size_t i,
                      const std::optional<ChainEnds>& ends) {
    const WallSegment& segment = segments[i];
    const std::size_t first_vertex = chain_.vertices.size() - 1;
    if (i + 1 < segments.size()) {
        const auto next = joint(segment, segments[i + 1]);
        add(next.first, segment.last);
        if (segment.circle && chain_.vertices.size() == first_vertex + 2)
            add_arc_vertices(segment, first_vertex);
        if (next.second)
            add(*next.second, segment.last);
    } else if (ends) {
        chain_.add(ends->last, samples_.steps());
        if (segment.circle)
            add_arc_vertices(segment, first_vertex);
    } else if (segment.circle && chain_.vertices.size() > 1) {
        chain_.add(chain_.vertices.front(), segment.last);
        add_arc_vertices(segment, first_vertex);
        chain_.remove_last();
    }
}

/// Inserts vertices between the last two, on the circle through them and the midpoint of the arc.
void Drawer::add_arc_vertices(const WallSegment& segment, std::size_t first_vertex) {
    const Vec2 from = samples_.from_fine(chain_.vertices[first_vertex]);
    const Vec2 to = samples_.from_fine(chain_.vertices.back());
    const Vec2 middle = segment.circle->project(samples_.at((segment.first + segment.last) / 2));
    const std::optional<Circle> circle = circle_through(from, middle, to);
    if (!circle)
        return;
    const auto angle = [&](Vec2 p) { return std::atan2(p.y - circle->centre.y, p.x - circle->centre.x); };
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
        add(circle->centre + circle->radius * Vec2{std::cos(at), std::sin(at)},
            segment.first + (segment.last - segment.first) * k / edges);
    }
    chain_.arcs.push_back({0, static_cast<std::uint32_t>(first_vertex), static_cast<std::uint32_t>(edges)});
    chain_.vertices.push_back(last);
    chain_.steps.push_back(segment.last);
}

void Drawer::add_circle(const WallSegment& segment) {
    const Circle& circle = *segment.circle;
    const double step = 2 * std::acos(std::max(0.0, 1 - sagitta / circle.radius));
    // Even, because the circle is written as two arcs.
    const auto edges = 2 * static_cast<std::size_t>(std::ceil(std::numbers::pi / step));
    const Vec2 from = samples_.at(segment.first) - circle.centre;
    const double begin = std::atan2(from.y, from.x);
    const double turn = twice_area(samples_) > 0 ? 1 : -1;
    std::size_t at_step = segment.first;
    for (std::size_t k = 0; k < edges; ++k) {
        const double at =
            begin + turn * 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(edges);
        const Vec2 place = circle.centre + circle.radius * Vec2{std::cos(at), std::sin(at)};
        // Advance along the trace together with the circle.
        const std::size_t reach =
            std::min(segment.first + samples_.steps(), at_step + 2 * samples_.steps() / edges + 2);
        for (std::size_t i = at_step; i < reach; ++i)
            if (length(samples_.at(i) - place) < length(samples_.at(at_step) - place))
                at_step = i;
        add(place, at_step);
    }
    const auto half = static_cast<std::uint32_t>(edges / 2);
    chain_.arcs = {{0, 0, half}, {0, half, half}};
}

/// Finds the step of the trace that corresponds to each vertex, and the deviation.
/// @param chain its vertices are set, its steps are hints
void match_trace(const TraceSums& samples, ChainPolyline& chain) {
    constexpr std::size_t reach = 8;
    const std::size_t n = chain.vertices.size();
    const std::size_t end = samples.closed() ? 2 * samples.steps() - 1 : samples.steps();
    for (std::size_t k = samples.closed() ? 0 : 1; k + (samples.closed() ? 0 : 1) < n; ++k) {
        const std::size_t hint = chain.steps[k];
        const std::size_t low = std::max(hint > reach ? hint - reach : 0, k > 0 ? chain.steps[k - 1] : 0);
        std::size_t high = std::min(hint + reach, end);
        if (k > 0 && samples.closed())
            high = std::min(high, chain.steps.front() + samples.steps());
        chain.steps[k] =
            nearest_step(samples, samples.from_fine(chain.vertices[k]), std::min(low, high), high);
    }
    chain.deviation = deviation(samples, chain, samples.closed());
}

}  // namespace

double deviation(const TraceSums& samples, const ChainPolyline& chain, bool closed) {
    double largest = 0;  // squared
    for_distances(samples, chain, closed,
                  [&](std::size_t, double square) { largest = std::max(largest, square); });
    return std::sqrt(largest);
}

double twice_area(const TraceSums& samples) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.steps(); ++i)
        sum += cross(samples.at(i), samples.at(i + 1));
    return sum;
}

double twice_area(const std::vector<FinePoint>& ring, const TraceSums& samples) {
    double sum = 0;
    Vec2 from = samples.from_fine(ring.back());
    for (const FinePoint vertex : ring) {
        const Vec2 to = samples.from_fine(vertex);
        sum += cross(from, to);
        from = to;
    }
    return sum;
}

ChainPolyline draw_walls(const TraceSums& samples, const WallParameters& parameters,
                         const std::vector<WallSegment>& segments, const std::optional<ChainEnds>& ends) {
    Drawer drawer(samples, parameters);
    drawer.reserve(2 * segments.size() + 2);
    if (segments.size() == 1 && segments.front().circle && !ends) {
        drawer.add_circle(segments.front());
    } else {
        if (ends)
            drawer.chain().add(ends->first, 0);
        else
            drawer.add_joint(drawer.joint(segments.back(), segments.front()), segments.front().first);
        for (std::size_t i = 0; i < segments.size(); ++i)
            drawer.add_wall(segments, i, ends);
    }
    match_trace(samples, drawer.chain());
    return std::move(drawer.chain());
}

}  // namespace d2b::outline
