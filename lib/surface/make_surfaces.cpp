#include "surface/make_surfaces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "surface/assemble.hpp"
#include "surface/extrude.hpp"
#include "surface/merge_near.hpp"
#include "surface/partition.hpp"
#include "surface/plan_part.hpp"

namespace d2b {
namespace {

using Places = std::vector<std::int32_t>;  ///< indices of buildings

/// Contours of the buildings that have not been excluded.
class Chosen {
  public:
    Chosen(const SurfaceCluster& cluster, const std::vector<bool>& is_out) {
        std::vector<std::int32_t> place(cluster.contours.size(), open_ground);
        for (std::size_t i = 0; i < cluster.contours.size(); ++i) {
            const PlanContour& contour = cluster.contours[i];
            if (is_out[static_cast<std::size_t>(contour.building)])
                continue;
            place[i] = static_cast<std::int32_t>(contours_.size());
            contours_.push_back(contour);
            numbers_.push_back(static_cast<std::int32_t>(i));
            if (contour.parent >= 0)
                contours_.back().parent = place[static_cast<std::size_t>(contour.parent)];
        }
    }
    [[nodiscard]] std::span<const PlanContour> contours() const { return contours_; }
    [[nodiscard]] std::vector<PlanContour>& contours() { return contours_; }
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contours_[static_cast<std::size_t>(contour)].building;
    }
    /// Returns the contour's index in the cluster.
    [[nodiscard]] std::int32_t number(std::int32_t contour) const {
        return numbers_[static_cast<std::size_t>(contour)];
    }

  private:
    std::vector<PlanContour> contours_;
    std::vector<std::int32_t> numbers_;
};

/// Surfaces of the chosen buildings, or the buildings to exclude.
struct Attempt {
    MadeSurfaces made;
    Places in_the_way;
};

class SurfaceMaker {
  public:
    SurfaceMaker(const SurfaceCluster& cluster, const std::vector<bool>& is_out, const SurfaceForms& forms,
                 const Triangulate& triangulate, const StopRequest& stop)
        : cluster_(cluster), chosen_(cluster, is_out), forms_(forms), triangulate_(triangulate), stop_(stop) {
        for (const PlanBuilding& building : cluster.buildings)
            ids_.push_back(building.id);
        for (const PlanContour& contour : chosen_.contours())
            building_of_.push_back(contour.building);
    }

    [[nodiscard]] Attempt make();

  private:
    using Edges = std::vector<std::uint32_t>;
    [[nodiscard]] bool draw_plan();
    void drop_what_is_flat();
    [[nodiscard]] std::vector<std::uint32_t> blocks() const;
    [[nodiscard]] std::vector<Edges> edges_by(const std::vector<std::uint32_t>& group) const;
    [[nodiscard]] Standing standing(const Edges& edges, const std::vector<std::uint32_t>& group,
                                    std::uint32_t which) const;
    void make_solids();
    void make_shell();

    const SurfaceCluster& cluster_;
    Chosen chosen_;
    SurfaceForms forms_;
    const Triangulate& triangulate_;
    const StopRequest& stop_;
    std::vector<std::int64_t> ids_;
    std::vector<std::int64_t> tops_;  // by contour
    Places building_of_;              // by contour
    Plan plan_;
    Attempt attempt_;
};

/// Removes contours whose roofs are not above the base of their building.
void SurfaceMaker::drop_what_is_flat() {
    const auto is_flat = [&](std::int32_t contour) {
        if (contour == open_ground)
            return false;
        const auto c = static_cast<std::size_t>(contour);
        return !forms_.gaps.stands_out(chosen_.contours()[c].top,
                                       cluster_.buildings[static_cast<std::size_t>(building_of_[c])].base);
    };
    for (PlanEdge& edge : plan_.edges) {
        edge.left = is_flat(edge.left) ? open_ground : edge.left;
        edge.right = is_flat(edge.right) ? open_ground : edge.right;
    }
    std::erase_if(plan_.edges, [](const PlanEdge& edge) { return edge.left == edge.right; });
}

/// @return true if the plan is usable
bool SurfaceMaker::draw_plan() {
    Partition partition = make_partition(chosen_.contours());
    for (const std::uint32_t contour : partition.at_odds)
        attempt_.in_the_way.push_back(chosen_.building(static_cast<std::int32_t>(contour)));
    if (!attempt_.in_the_way.empty())
        return false;
    plan_ = std::move(partition.plan);
    drop_what_is_flat();
    merge_near_nodes(plan_, forms_.gaps.corners);
    level_near_roofs(plan_, chosen_.contours(), forms_.gaps.heights);
    for (const PlanContour& contour : chosen_.contours())
        tops_.push_back(contour.top);
    PinchesTaken taken =
        take_apart_pinches(plan_, chosen_.contours(), {forms_.pinch_steps, forms_.gaps}, stop_);
    if (!taken.stuck.empty()) {
        attempt_.in_the_way.push_back(chosen_.building(static_cast<std::int32_t>(taken.stuck.back())));
        return false;
    }
    for (PinchMend& mend : taken.mends)
        for (std::int32_t& contour : mend.contours)
            contour = chosen_.number(contour);
    attempt_.made.mends = std::move(taken.mends);
    return true;
}

/// Returns a number per building that is equal for buildings with common walls.
std::vector<std::uint32_t> SurfaceMaker::blocks() const {
    DisjointSets sets(static_cast<std::uint32_t>(cluster_.buildings.size()));
    for (const PlanEdge& edge : plan_.edges)
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(chosen_.building(edge.left)),
                      static_cast<std::uint32_t>(chosen_.building(edge.right)));
    std::vector<std::uint32_t> block(cluster_.buildings.size());
    for (std::uint32_t i = 0; i < block.size(); ++i)
        block[i] = sets.find(i);
    return block;
}

/// Returns the edges that bound each group. @param group by building
std::vector<SurfaceMaker::Edges> SurfaceMaker::edges_by(const std::vector<std::uint32_t>& group) const {
    std::vector<Edges> edges(cluster_.buildings.size());
    const auto group_of = [&](std::int32_t contour) {
        return group[static_cast<std::size_t>(chosen_.building(contour))];
    };
    for (std::uint32_t e = 0; e < plan_.edges.size(); ++e) {
        const PlanEdge& edge = plan_.edges[e];
        if (edge.left != open_ground)
            edges[group_of(edge.left)].push_back(e);
        if (edge.right != open_ground &&
            (edge.left == open_ground || group_of(edge.left) != group_of(edge.right)))
            edges[group_of(edge.right)].push_back(e);
    }
    return edges;
}

Standing SurfaceMaker::standing(const Edges& edges, const std::vector<std::uint32_t>& group,
                                std::uint32_t which) const {
    Standing result{plan_part(plan_, edges,
                              [&](std::int32_t contour) {
                                  return group[static_cast<std::size_t>(chosen_.building(contour))] == which;
                              }),
                    tops_, building_of_, std::numeric_limits<std::int64_t>::max()};
    for (const PlanEdge& edge : result.plan.edges)
        for (const std::int32_t contour : {edge.left, edge.right})
            if (contour != open_ground)
                result.base =
                    std::min(result.base,
                             cluster_.buildings[static_cast<std::size_t>(chosen_.building(contour))].base);
    return result;
}

void SurfaceMaker::make_solids() {
    std::vector<std::uint32_t> each(cluster_.buildings.size());
    for (std::uint32_t i = 0; i < each.size(); ++i)
        each[i] = i;
    const std::vector<Edges> edges = edges_by(each);
    for (std::uint32_t i = 0; i < each.size(); ++i) {
        if (edges[i].empty())
            continue;
        stop_.check();
        const Standing alone = standing(edges[i], each, i);
        attempt_.made.solids.push_back(assemble_faces(extrude(alone), alone.plan, ids_));
    }
}

void SurfaceMaker::make_shell() {
    const std::vector<std::uint32_t> block = blocks();
    const std::vector<Edges> edges = edges_by(block);
    for (std::uint32_t i = 0; i < block.size(); ++i) {
        if (edges[i].empty())
            continue;
        stop_.check();
        const Standing together = standing(edges[i], block, i);
        AssembledTriangles made = assemble_triangles(extrude(together), together.plan, ids_, triangulate_);
        attempt_.in_the_way.insert(attempt_.in_the_way.end(), made.failed.begin(), made.failed.end());
        attempt_.made.shell.push_back(std::move(made.part));
    }
}

Attempt SurfaceMaker::make() {
    if (!draw_plan())
        return std::move(attempt_);
    if (forms_.shell)
        make_shell();
    if (forms_.solids && attempt_.in_the_way.empty())
        make_solids();
    return std::move(attempt_);
}

}  // namespace

MadeSurfaces make_surfaces(const SurfaceCluster& cluster, const SurfaceForms& forms,
                           const Triangulate& triangulate, const StopRequest& stop) {
    std::vector<bool> is_out(cluster.buildings.size());
    std::vector<std::int64_t> left_out;
    while (true) {
        Attempt attempt = SurfaceMaker(cluster, is_out, forms, triangulate, stop).make();
        if (attempt.in_the_way.empty()) {
            attempt.made.left_out = std::move(left_out);
            return std::move(attempt.made);
        }
        for (const std::int32_t building : attempt.in_the_way) {
            if (is_out[static_cast<std::size_t>(building)])
                continue;
            is_out[static_cast<std::size_t>(building)] = true;
            left_out.push_back(cluster.buildings[static_cast<std::size_t>(building)].id);
        }
        std::ranges::sort(left_out);
    }
}

}  // namespace d2b
