#include "surface/extrude.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "surface/straighten.hpp"

namespace d2b {
namespace {

class Extruder {
  public:
    explicit Extruder(const Standing& standing) : standing_(standing) {}

    [[nodiscard]] Extrusion make() {
        Extrusion result;
        add_roofs(result);
        add_grounds(result);
        find_heights();
        for (const PlanEdge& edge : standing_.plan.edges)
            add_wall(edge, result);
        return result;
    }

  private:
    [[nodiscard]] std::int64_t height(std::int32_t contour) const {
        return contour == open_ground ? standing_.base : standing_.tops[static_cast<std::size_t>(contour)];
    }
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contour == open_ground ? open_ground : standing_.building[static_cast<std::size_t>(contour)];
    }
    void add_roofs(Extrusion& result) const;
    void add_grounds(Extrusion& result) const;
    void find_heights();
    [[nodiscard]] std::vector<std::int64_t> column(std::uint32_t node, std::int64_t low,
                                                   std::int64_t high) const;
    void add_wall(const PlanEdge& edge, Extrusion& result) const;

    const Standing& standing_;
    std::vector<std::vector<std::int64_t>> heights_;  // heights around each node, ascending
};

void Extruder::add_roofs(Extrusion& result) const {
    for (OwnedFace& owned : plan_faces(standing_.plan))
        result.roofs.push_back({building(owned.owner), height(owned.owner), std::move(owned.face)});
}

/// Adds the ground of each building as a whole, whatever stands on it.
void Extruder::add_grounds(Extrusion& result) const {
    Plan plan{standing_.plan.nodes, {}};
    for (const PlanEdge& edge : standing_.plan.edges)
        if (const PlanEdge low{edge.from, edge.to, building(edge.left), building(edge.right)};
            low.left != low.right)
            plan.edges.push_back(low);
    straighten(plan, Straighten::inside);
    for (OwnedFace& owned : plan_faces(plan))
        result.grounds.push_back({owned.owner, standing_.base, std::move(owned.face)});
}

void Extruder::find_heights() {
    heights_.resize(standing_.plan.nodes.size());
    for (const PlanEdge& edge : standing_.plan.edges)
        for (const std::uint32_t node : {edge.from, edge.to})
            for (const std::int32_t contour : {edge.left, edge.right})
                heights_[node].push_back(height(contour));
    for (std::vector<std::int64_t>& heights : heights_) {
        std::ranges::sort(heights);
        heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    }
}

std::vector<std::int64_t> Extruder::column(std::uint32_t node, std::int64_t low, std::int64_t high) const {
    const std::vector<std::int64_t>& all = heights_[node];
    return {std::ranges::lower_bound(all, low), std::ranges::upper_bound(all, high)};
}

void Extruder::add_wall(const PlanEdge& edge, Extrusion& result) const {
    const std::int64_t left = height(edge.left);
    const std::int64_t right = height(edge.right);
    if (left == right)
        return;
    // Seen from the lower side.
    const auto [low, high] = std::minmax(left, right);
    const auto [from, to] = left > right ? std::pair(edge.from, edge.to) : std::pair(edge.to, edge.from);
    result.walls.push_back({building(left > right ? edge.left : edge.right), from, to,
                            column(from, low, high), column(to, low, high)});
}

}  // namespace

Extrusion extrude(const Standing& standing) {
    return Extruder(standing).make();
}

}  // namespace d2b
