#include "surface/resolve_nonmanifold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/partition_editor.hpp"

namespace d2b::surface {
namespace {

/// Distances of minimal moves, in halves of the minimum gap, smallest first. The larger ones are for sharp
/// angles and crowded places.
constexpr std::array<std::int64_t, 8> minimal_halves{2, 3, 4, 8, 16, 32, 64, 128};
/// Limits of minimal moves: in steps, and in gaps.
constexpr std::int64_t most_steps = 128;
constexpr std::int64_t most_gaps = 8;

/// Nodes with more edges are not resolved.
constexpr std::size_t most_arms = 32;

LatticeDistance halves_of(const LatticeDistance& gap, std::int64_t halves) {
    return {(gap.rows * halves + 1) / 2, (gap.cols * halves + 1) / 2};
}

std::vector<LatticeDistance> minimal_distances(const LatticeDistance& pinch) {
    std::vector<LatticeDistance> reaches;
    for (const std::int64_t halves : minimal_halves)
        if (const LatticeDistance reach = halves_of(pinch, halves);
            halves <= 2 * most_gaps || std::max(reach.rows, reach.cols) <= most_steps)
            reaches.push_back(reach);
    return reaches;
}

/// Returns distances below the minimum gap for places without room. They still exceed the distance within
/// which corners are merged.
std::vector<LatticeDistance> reduced_distances(const GapTolerances& gaps) {
    std::vector<LatticeDistance> reaches;
    LatticeDistance reach = halves_of(gaps.pinch, 1);
    while (std::min(reach.rows, reach.cols) >= 2 && reach.rows >= gaps.corners.rows &&
           reach.cols >= gaps.corners.cols) {
        reaches.push_back(reach);
        reach = halves_of(reach, 1);
    }
    return reaches;
}

/// Returns points on the border of a box around the origin, in all directions.
std::vector<FinePoint> border_of(const LatticeDistance& half) {
    constexpr std::int64_t most_a_half = 128;
    const auto along = [](std::int64_t length) {
        std::vector<std::int64_t> places;
        const std::int64_t step = (length + most_a_half - 1) / most_a_half;
        for (std::int64_t at = -length; at < length; at += step)
            places.push_back(at);
        places.push_back(length);
        return places;
    };
    std::vector<FinePoint> places;
    for (const std::int64_t row : along(half.rows))
        for (const std::int64_t col : {-half.cols, half.cols})
            places.push_back({row, col});
    for (const std::int64_t col : along(half.cols))
        for (const std::int64_t row : {-half.rows, half.rows})
            if (std::abs(col) != half.cols)
                places.push_back({row, col});
    return places;
}

/// Returns true if a segment meets the interior of a box around a point. Exact.
bool comes_near(const FineSegment& segment, FinePoint place, const LatticeDistance& gap) {
    const FinePoint low{place.row - gap.rows + 1, place.col - gap.cols + 1};
    const FinePoint high{place.row + gap.rows - 1, place.col + gap.cols - 1};
    if (!outline::boxes_intersect(segment, {low, high}))
        return false;
    int sides = 0;
    for (const FinePoint corner : {low, high, FinePoint{low.row, high.col}, FinePoint{high.row, low.col}})
        sides += outline::side(segment.from, segment.to, corner);
    return std::abs(sides) < 4;
}

/// Returns points at equal distance in all directions.
std::vector<FinePoint> circle(std::int64_t reach) {
    constexpr int directions = 512;
    std::vector<FinePoint> places;
    for (int i = 0; i < directions; ++i) {
        const double angle = 2 * std::numbers::pi * i / directions;
        const auto steps = static_cast<double>(reach);
        const FinePoint place{std::llround(steps * std::sin(angle)), std::llround(steps * std::cos(angle))};
        if (places.empty() || places.back() != place)
            places.push_back(place);
    }
    return places;
}

class NonmanifoldResolver {
  public:
    NonmanifoldResolver(PlanarPartition& plan, std::span<const PartitionContour> contours,
                        const MoveDistances& wanted, const StopToken& stop)
        : plan_(plan), contours_(contours), wanted_(wanted), stop_(stop) {
        if (wanted.steps > std::max(wanted.gaps.pinch.rows, wanted.gaps.pinch.cols))
            planned_ = plan_distances(plan, contours, wanted, stop);
        around_ = edges_around_nodes(plan);
    }

    [[nodiscard]] ResolvedVertices take();

  private:
    [[nodiscard]] std::optional<FinePoint> place_for(std::uint32_t node,
                                                     const std::vector<IncidentEdge>& arms,
                                                     std::span<const FinePoint> ring,
                                                     const LatticeDistance& clearance) const;
    [[nodiscard]] bool is_free(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                               FinePoint place) const;
    [[nodiscard]] bool is_clear(std::uint32_t node, const std::vector<IncidentEdge>& arms, FinePoint place,
                                const LatticeDistance& clearance) const;
    [[nodiscard]] bool take_one(std::uint32_t node, const NonmanifoldVertex& pinch);
    [[nodiscard]] bool move_by_plan(std::uint32_t node, const NonmanifoldVertex& pinch);
    [[nodiscard]] bool move_minimally(std::uint32_t node, const NonmanifoldVertex& pinch);
    [[nodiscard]] bool move_by(std::uint32_t node, const NonmanifoldVertex& pinch,
                               std::span<const LatticeDistance> reaches, const LatticeDistance& clearance);
    [[nodiscard]] SweptArea swept_area(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                                       FinePoint place) const;
    [[nodiscard]] SweptArea least_swept(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                                        std::int64_t reach) const;
    [[nodiscard]] const std::vector<FinePoint>& places_at(std::int64_t reach);
    void move(std::uint32_t node, const SectorRun& run, FinePoint place, bool fills);

    PlanarPartition& plan_;
    std::span<const PartitionContour> contours_;
    const MoveDistances& wanted_;
    const StopToken& stop_;
    PlannedDistances planned_;
    std::optional<EdgeGrid> near_;                              // built at the first move
    std::map<std::int64_t, std::vector<FinePoint>> places_at_;  // by distance
    std::vector<std::vector<IncidentEdge>> around_;
    ResolvedVertices taken_;
};

/// Returns true if a corner can move. Moving it sweeps one triangle per arm; no other node may be inside, and
/// no edge may cross the path.
bool NonmanifoldResolver::is_free(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                                  FinePoint place) const {
    const FinePoint from = plan_.nodes[node];
    if (std::ranges::any_of(arms, [&](const IncidentEdge& arm) {
            return outline::side(from, place, plan_.nodes[arm.end]) == 0;
        }))
        return false;
    return std::ranges::all_of(arms, [&](const IncidentEdge& arm) {
        const FinePoint far = plan_.nodes[arm.end];
        return near_->all_in_triangle(from, place, far, [&](std::uint32_t e) {
            const PartitionEdge& edge = plan_.edges[e];
            const bool own = edge.from == node || edge.to == node;
            if (!own &&
                outline::segments_intersect({plan_.nodes[edge.from], plan_.nodes[edge.to]}, {from, place}))
                return false;
            return std::ranges::none_of(std::array{edge.from, edge.to}, [&](std::uint32_t end) {
                return end != node && end != arm.end &&
                       outline::in_triangle(from, place, far, plan_.nodes[end]);
            });
        });
    });
}

/// Returns true if the new position is far enough from other edges, because otherwise corners would touch
/// there. Walls that move along are exempt if only their ends are, because they may be short and lead to
/// other corners.
bool NonmanifoldResolver::is_clear(std::uint32_t node, const std::vector<IncidentEdge>& arms, FinePoint place,
                                   const LatticeDistance& clearance) const {
    const auto is_end = [&](std::uint32_t of) {
        return std::ranges::any_of(arms, [&](const IncidentEdge& arm) { return arm.end == of; });
    };
    const LatticeDistance& corners = wanted_.gaps.corners;
    return near_->all_in_box(
        {place.row - clearance.rows, place.col - clearance.cols},
        {place.row + clearance.rows, place.col + clearance.cols}, [&](std::uint32_t e) {
            const PartitionEdge& edge = plan_.edges[e];
            if (edge.from == node || edge.to == node || is_end(edge.from) || is_end(edge.to))
                return std::ranges::all_of(std::array{edge.from, edge.to}, [&](std::uint32_t end) {
                    return end == node || corners.parts(plan_.nodes[end], place);
                });
            return !comes_near({plan_.nodes[edge.from], plan_.nodes[edge.to]}, place, clearance);
        });
}

/// Tries directions with the largest angles to the neighbouring walls first. @return nothing if there is no
/// room at this distance
std::optional<FinePoint> NonmanifoldResolver::place_for(std::uint32_t node,
                                                        const std::vector<IncidentEdge>& arms,
                                                        std::span<const FinePoint> ring,
                                                        const LatticeDistance& clearance) const {
    const FinePoint from = plan_.nodes[node];
    const double first = angle_of(from, plan_.nodes[arms.front().end]);
    const double whole = turned_from(first, angle_of(from, plan_.nodes[arms.back().end]));
    std::vector<std::pair<double, FinePoint>> places;
    for (const FinePoint& off : ring) {
        const FinePoint place{from.row + off.row, from.col + off.col};
        const double turn = turned_from(first, angle_of(from, place));
        const double room = std::min(turn, whole - turn);
        if (room > 0 && std::max(turn, whole - turn) < std::numbers::pi)
            places.emplace_back(-room, place);
    }
    std::ranges::sort(places);
    for (const auto& [room, place] : places)
        if (is_free(node, arms, place) && is_clear(node, arms, place, clearance))
            return place;
    return std::nullopt;
}

SweptArea NonmanifoldResolver::swept_area(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                                          FinePoint place) const {
    SweptArea area;
    for (const IncidentEdge& arm : arms)
        area.add(arm, plan_.nodes[arm.end], plan_.nodes[node], place);
    return area;
}

/// Returns areas below those of a move to any place at a distance. Each is a sum of sines of angles to the
/// arms, so it is least in the direction of one of them.
SweptArea NonmanifoldResolver::least_swept(std::uint32_t node, const std::vector<IncidentEdge>& arms,
                                           std::int64_t reach) const {
    const FinePoint from = plan_.nodes[node];
    const double rounded = std::max(0.0, static_cast<double>(reach - 1) * (1 - 1e-9));
    std::optional<SweptArea> least;
    for (const IncidentEdge& arm : arms) {
        const FinePoint along = plan_.nodes[arm.end];
        const double length = outline::step_distance(from, along);
        const SweptArea area = swept_area(node, arms, along);
        const SweptArea here{rounded / length * area.outside, rounded / length * area.inside};
        least = least
                    ? SweptArea{std::min(least->outside, here.outside), std::min(least->inside, here.inside)}
                    : here;
    }
    return *least;
}

/// Returns the places to which a corner may move at a distance, relative to it.
const std::vector<FinePoint>& NonmanifoldResolver::places_at(std::int64_t reach) {
    const auto [known, is_new] = places_at_.try_emplace(reach);
    if (is_new) {
        known->second = circle(reach);
        std::erase_if(known->second, [&](FinePoint off) { return !wanted_.gaps.pinch.parts({}, off); });
    }
    return known->second;
}

void NonmanifoldResolver::move(std::uint32_t node, const SectorRun& run, FinePoint place, bool fills) {
    taken_.repairs.push_back({plan_.nodes[node], place, fills, contours_of(around_[node])});
    if (wanted_.take)
        wanted_.take(taken_.repairs.back().contours,
                     swept_area(node, bounding_half_edges(around_[node], run), place).outside);
    const auto moved = static_cast<std::uint32_t>(plan_.nodes.size());
    std::vector<IncidentEdge>& all = around_[node];
    std::vector<IncidentEdge> arms = bounding_half_edges(all, run);
    plan_.nodes.push_back(place);
    for (const IncidentEdge& arm : arms) {
        PartitionEdge& edge = plan_.edges[arm.edge];
        (edge.from == node ? edge.from : edge.to) = moved;
        for (IncidentEdge& back : around_[arm.end])
            if (back.edge == arm.edge)
                back.end = moved;
        std::erase_if(all, [&](const IncidentEdge& other) { return other.edge == arm.edge; });
    }
    for (const IncidentEdge& arm : arms)
        near_->add(arm.edge, place, plan_.nodes[arm.end]);
    const std::int32_t left = arms.back().left;
    const std::int32_t right = arms.front().right;
    if (left != right) {
        near_->add(static_cast<std::uint32_t>(plan_.edges.size()), plan_.nodes[node], place);
        const auto edge = static_cast<std::uint32_t>(plan_.edges.size());
        plan_.edges.push_back({node, moved, left, right});
        all.push_back({edge, moved, left, right});
        arms.push_back({edge, node, right, left});
    }
    around_.push_back(std::move(arms));
    sort_around(plan_.nodes, node, around_[node]);
    sort_around(plan_.nodes, moved, around_[moved]);
}

/// Moves by the planned distance, or by the largest smaller one that fits and is allowed.
bool NonmanifoldResolver::move_by_plan(std::uint32_t node, const NonmanifoldVertex& pinch) {
    const auto planned = planned_.find(plan_.nodes[node]);
    const std::vector<std::int32_t> contours = contours_of(around_[node]);
    for (const std::int64_t reach : distances_down_from(
             planned == planned_.end() ? wanted_.steps : planned->second, wanted_.gaps.pinch)) {
        std::optional<std::pair<SectorRun, FinePoint>> best;
        double least = 0;
        for (const SectorRun& run : pinch.runs) {
            const std::vector<IncidentEdge> arms = bounding_half_edges(around_[node], run);
            // Asked first, because looking for a place costs far more and is in vain if the budget is used
            // up.
            if (const SweptArea least_area = least_swept(node, arms, reach);
                wanted_.allows && !wanted_.allows(contours, least_area.outside, least_area.inside))
                continue;
            const auto place = place_for(node, arms, places_at(reach), wanted_.gaps.pinch);
            if (!place)
                continue;
            const SweptArea area = swept_area(node, arms, *place);
            if (wanted_.allows && !wanted_.allows(contours, area.outside, area.inside))
                continue;
            if (best && least <= area.outside)
                continue;
            best = {run, *place};
            least = area.outside;
        }
        if (best) {
            move(node, best->first, best->second, pinch.fills);
            return true;
        }
    }
    return false;
}

bool NonmanifoldResolver::move_by(std::uint32_t node, const NonmanifoldVertex& pinch,
                                  std::span<const LatticeDistance> reaches,
                                  const LatticeDistance& clearance) {
    for (const LatticeDistance& reach : reaches) {
        const std::vector<FinePoint> ring = border_of(reach);
        for (const SectorRun& run : pinch.runs)
            if (const auto place =
                    place_for(node, bounding_half_edges(around_[node], run), ring, clearance)) {
                move(node, run, *place, pinch.fills);
                return true;
            }
    }
    return false;
}

/// In narrow places first allows smaller clearance, then smaller distances.
bool NonmanifoldResolver::move_minimally(std::uint32_t node, const NonmanifoldVertex& pinch) {
    const GapTolerances& gaps = wanted_.gaps;
    const std::vector<LatticeDistance> reaches = minimal_distances(gaps.pinch);
    return move_by(node, pinch, reaches, gaps.pinch) || move_by(node, pinch, reaches, gaps.corners) ||
           move_by(node, pinch, reduced_distances(gaps), gaps.corners);
}

bool NonmanifoldResolver::take_one(std::uint32_t node, const NonmanifoldVertex& pinch) {
    if (around_[node].size() > most_arms)
        return false;
    if (!near_) {
        near_.emplace();
        for (std::uint32_t e = 0; e < plan_.edges.size(); ++e)
            near_->add(e, plan_.nodes[plan_.edges[e].from], plan_.nodes[plan_.edges[e].to]);
    }
    return move_by_plan(node, pinch) || move_minimally(node, pinch);
}

/// Terminates, because each move leaves both nodes with fewer edges than the original one.
ResolvedVertices NonmanifoldResolver::take() {
    for (std::uint32_t node = 0; node < plan_.nodes.size(); ++node)
        while (const auto pinch = find_nonmanifold(plan_.nodes[node], around_[node], contours_)) {
            stop_.check();
            if (!take_one(node, *pinch)) {
                for (const std::int32_t contour : contours_of(around_[node]))
                    taken_.unresolved.push_back(static_cast<std::uint32_t>(contour));
                break;
            }
        }
    std::ranges::sort(taken_.unresolved);
    return std::move(taken_);
}

}  // namespace

ResolvedVertices resolve_nonmanifold_vertices(PlanarPartition& plan,
                                              std::span<const PartitionContour> contours,
                                              const MoveDistances& wanted, const StopToken& stop) {
    return NonmanifoldResolver(plan, contours, wanted, stop).take();
}

}  // namespace d2b::surface
