#include "outline/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <set>
#include <tuple>

#include "outline/vertex_grid.hpp"

namespace d2b {
namespace {

/// Simplifies all arcs together.
class Straightener {
  public:
    Straightener(const std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
                 const StopRequest& stop);
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
    [[nodiscard]] bool free_to_go(std::size_t vertex) const;
    void consider(std::size_t vertex);
    void remove(std::size_t vertex);

    const Georeference& georeference_;
    double tolerance_;
    const StopRequest& stop_;
    std::vector<Vertex> vertices_;    // all arcs, concatenated
    std::vector<std::size_t> first_;  // per arc, and one past the last
    VertexGrid grid_;
    std::set<Edge> edges_;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
    std::vector<std::size_t> blocked_;
};

Straightener::Straightener(const std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
                           const StopRequest& stop)
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
double Straightener::deviation(std::size_t from, std::size_t to) const {
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

bool Straightener::free_to_go(std::size_t vertex) const {
    const Vertex& v = vertices_[vertex];
    const LatticePoint a = vertices_[v.previous].at;
    const LatticePoint c = vertices_[v.next].at;
    return a != c && !edges_.contains(edge(a, c)) && !grid_.any_in(a, v.at, c);
}

void Straightener::consider(std::size_t vertex) {
    const Vertex& v = vertices_[vertex];
    if (v.fixed || v.removed)
        return;
    stop_.check();
    const double moved = deviation(v.previous, v.next);
    if (moved <= tolerance_)
        queue_.emplace(moved, v.at, vertex, v.previous, v.next);
}

void Straightener::remove(std::size_t vertex) {
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
    consider(v.previous);
    consider(v.next);
}

void Straightener::run() {
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        consider(i);
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
            if (!free_to_go(vertex)) {
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
            consider(vertex);
    }
}

Arc Straightener::result(std::size_t arc) const {
    Arc points;
    for (std::size_t i = first_[arc]; i < first_[arc + 1]; ++i)
        if (!vertices_[i].removed)
            points.push_back(vertices_[i].at);
    return points;
}

}  // namespace

void simplify(std::vector<Arc>& arcs, double tolerance, const Georeference& georeference,
              const StopRequest& stop) {
    Straightener straightener(arcs, tolerance, georeference, stop);
    straightener.run();
    for (std::size_t i = 0; i < arcs.size(); ++i)
        arcs[i] = straightener.result(i);
}

}  // namespace d2b
