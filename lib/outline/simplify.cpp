#include "outline/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <set>
#include <tuple>
#include <unordered_map>

#include "core/lattice.hpp"
#include "outline/fine_geometry.hpp"

namespace d2b::outline {

/// Uniform grid of points with buckets of 16 x 16, for finding points in triangles.
class VertexGrid {
  public:
    void add(LatticePoint point) {
        buckets_[bucket(point.row >> shift, point.col >> shift)].push_back(point);
    }
    /// Removes one of the points equal to this.
    void remove(LatticePoint point);
    /// Returns true if the closed triangle contains a point other than its corners.
    [[nodiscard]] bool any_in_triangle(LatticePoint a, LatticePoint b, LatticePoint c) const;

  private:
    static constexpr int shift = 4;
    static std::uint64_t bucket(std::int32_t row, std::int32_t col) {
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) |
               static_cast<std::uint32_t>(col);
    }
    std::unordered_map<std::uint64_t, std::vector<LatticePoint>> buckets_;
};

namespace {

/// Simplifies all arcs together.
class ArcSimplifier {
  public:
    ArcSimplifier(const std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
                  const StopToken& stop);
    void run();
    [[nodiscard]] Arc result(std::size_t arc) const;

  private:
    struct Vertex {
        LatticePoint at;
        std::size_t previous;  // among the remaining vertices
        std::size_t next;
        bool fixed;  // end of its arc
        bool removed = false;
    };
    using Edge = std::array<LatticePoint, 2>;
    using Candidate = std::tuple<double, LatticePoint, std::size_t, std::size_t, std::size_t>;

    [[nodiscard]] static Edge edge(LatticePoint a, LatticePoint b) {
        return {std::min(a, b), std::max(a, b)};
    }
    [[nodiscard]] double deviation(std::size_t from, std::size_t to) const;
    [[nodiscard]] bool is_removable(std::size_t vertex) const;
    void try_enqueue(std::size_t vertex);
    void remove(std::size_t vertex);

    const Georeference& georeference_;
    double tolerance_;
    const StopToken& stop_;
    std::vector<Vertex> vertices_;    // all arcs, concatenated
    std::vector<std::size_t> first_;  // per arc, and one past the last
    VertexGrid grid_;
    std::set<Edge> edges_;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
    std::vector<std::size_t> blocked_;
};

ArcSimplifier::ArcSimplifier(const std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
                             const StopToken& stop)
    : georeference_(georeference), tolerance_(tolerance), stop_(stop) {
    std::set<LatticePoint> ends;  // junctions are shared by arcs but inserted into the grid once
    for (const Arc& arc : arcs) {
        first_.push_back(vertices_.size());
        for (std::size_t i = 0; i < arc.size(); ++i) {
            stop_.check();
            const bool end = i == 0 || i + 1 == arc.size();
            vertices_.push_back({arc[i], vertices_.size() - 1, vertices_.size() + 1, end});
            if (!end || ends.insert(arc[i]).second)
                grid_.add(arc[i]);
            if (i > 0)
                edges_.insert(edge(arc[i - 1], arc[i]));
        }
    }
    first_.push_back(vertices_.size());
}

/// Largest distance between the original points between two vertices and the edge joining them.
double ArcSimplifier::deviation(std::size_t from, std::size_t to) const {
    const LatticePoint origin = vertices_[from].at;
    const auto offset = [&](LatticePoint p) {
        return georeference_.step(p.row - origin.row, p.col - origin.col);
    };
    const Position along = offset(vertices_[to].at);
    const double length2 = along.x * along.x + along.y * along.y;
    double largest = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
        const Position p = offset(vertices_[i].at);
        const double share =
            length2 > 0 ? std::clamp((p.x * along.x + p.y * along.y) / length2, 0.0, 1.0) : 0.0;
        largest = std::max(largest, std::hypot(p.x - share * along.x, p.y - share * along.y));
        if (largest > tolerance_)
            break;
    }
    return largest;
}

bool ArcSimplifier::is_removable(std::size_t vertex) const {
    const Vertex& v = vertices_[vertex];
    const LatticePoint a = vertices_[v.previous].at;
    const LatticePoint c = vertices_[v.next].at;
    return a != c && !edges_.contains(edge(a, c)) && !grid_.any_in_triangle(a, v.at, c);
}

void ArcSimplifier::try_enqueue(std::size_t vertex) {
    const Vertex& v = vertices_[vertex];
    if (v.fixed || v.removed)
        return;
    stop_.check();
    const double moved = deviation(v.previous, v.next);
    if (moved <= tolerance_)
        queue_.emplace(moved, v.at, vertex, v.previous, v.next);
}

void ArcSimplifier::remove(std::size_t vertex) {
    Vertex& v = vertices_[vertex];
    const LatticePoint a = vertices_[v.previous].at;
    const LatticePoint c = vertices_[v.next].at;
    edges_.erase(edge(a, v.at));
    edges_.erase(edge(v.at, c));
    edges_.insert(edge(a, c));
    grid_.remove(v.at);
    v.removed = true;
    vertices_[v.previous].next = v.next;
    vertices_[v.next].previous = v.previous;
    try_enqueue(v.previous);
    try_enqueue(v.next);
}

void ArcSimplifier::run() {
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        try_enqueue(i);
    bool any_removed = true;
    while (any_removed) {
        any_removed = false;
        while (!queue_.empty()) {
            const auto [moved, at, vertex, previous, next] = queue_.top();
            queue_.pop();
            stop_.check();
            const Vertex& v = vertices_[vertex];
            if (v.removed || v.previous != previous || v.next != next)
                continue;  // outdated entry: its neighbours have changed, so it was queued again
            if (!is_removable(vertex)) {
                blocked_.push_back(vertex);
                continue;
            }
            remove(vertex);
            any_removed = true;
        }
        // Retry blocked vertices, because the obstacles may have been removed.
        std::vector<std::size_t> again;
        std::swap(again, blocked_);
        for (const std::size_t vertex : again)
            try_enqueue(vertex);
    }
}

Arc ArcSimplifier::result(std::size_t arc) const {
    Arc points;
    for (std::size_t i = first_[arc]; i < first_[arc + 1]; ++i)
        if (!vertices_[i].removed)
            points.push_back(vertices_[i].at);
    return points;
}

}  // namespace

void VertexGrid::remove(LatticePoint point) {
    auto& points = buckets_[bucket(point.row >> shift, point.col >> shift)];
    const auto found = std::find(points.begin(), points.end(), point);
    *found = points.back();
    points.pop_back();
}

bool VertexGrid::any_in_triangle(LatticePoint a, LatticePoint b, LatticePoint c) const {
    const LatticePoint low{std::min({a.row, b.row, c.row}), std::min({a.col, b.col, c.col})};
    const LatticePoint high{std::max({a.row, b.row, c.row}), std::max({a.col, b.col, c.col})};
    for (std::int32_t row = low.row >> shift; row <= high.row >> shift; ++row)
        for (std::int32_t col = low.col >> shift; col <= high.col >> shift; ++col) {
            const auto found = buckets_.find(bucket(row, col));
            if (found == buckets_.end())
                continue;
            for (const LatticePoint p : found->second)
                if (p != a && p != b && p != c && p.row >= low.row && p.col >= low.col && p.col <= high.col &&
                    p.row <= high.row && in_triangle(fine(a), fine(b), fine(c), fine(p)))
                    return true;
        }
    return false;
}

void simplify(std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
              const StopToken& stop) {
    ArcSimplifier simplifier(arcs, tolerance, georeference, stop);
    simplifier.run();
    for (std::size_t i = 0; i < arcs.size(); ++i)
        arcs[i] = simplifier.result(i);
}

}  // namespace d2b::outline
