#include "surface/take_apart_pinches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/node_star.hpp"
#include "surface/pinch.hpp"

namespace d2b {
namespace {

/// How far a corner may move, in steps, where nothing else is asked for; what is usual comes first.
constexpr std::array<std::int64_t, 8> usual_reaches{2, 3, 4, 8, 16, 32, 64, 128};

/// A node with more edges is left as it is. Each move takes one away from where they were at least, so that
/// no edge's end goes farther than most_moved, however often it moves.
constexpr std::size_t most_arms = 32;

/// What lies so far off in one of the eight directions or between them.
std::vector<FinePoint> square(std::int64_t reach) {
    std::vector<FinePoint> places;
    for (std::int64_t row = -reach; row <= reach; ++row)
        for (std::int64_t col = -reach; col <= reach; col += std::abs(row) == reach ? 1 : 2 * reach)
            places.push_back({row, col});
    return places;
}

/// What lies as far off in all directions.
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

/// Edges near a place, although their ends have moved since they were put down.
class NearEdges {
  public:
    NearEdges(const Plan& plan, std::int64_t most_moved)
        : plan_(plan),
          known_(plan.edges.size()),
          moved_(static_cast<double>(most_moved)),
          tree_(boxes(plan)) {}

    /// Calls visit(edge) for all that may meet a box, with others.
    template <typename Visit>
    void visit(std::span<const FinePoint> points, const Visit& visit) const {
        Box box;
        for (const FinePoint& point : points)
            box.add(Position{static_cast<double>(point.col), static_cast<double>(point.row)});
        tree_.query({box.left - moved_, box.low - moved_, box.right + moved_, box.high + moved_},
                    [&](std::size_t e) { visit(plan_.edges[e]); });
        for (std::size_t e = known_; e < plan_.edges.size(); ++e)
            visit(plan_.edges[e]);
    }

  private:
    static std::vector<Box> boxes(const Plan& plan) {
        std::vector<Box> boxes;
        for (const PlanEdge& edge : plan.edges) {
            Box& box = boxes.emplace_back();
            for (const std::uint32_t node : {edge.from, edge.to})
                box.add(Position{static_cast<double>(plan.nodes[node].col),
                                 static_cast<double>(plan.nodes[node].row)});
        }
        return boxes;
    }

    const Plan& plan_;
    std::size_t known_;
    double moved_;
    BoxTree tree_;
};

class PinchTaker {
  public:
    PinchTaker(Plan& plan, std::span<const PlanContour> contours, const PinchReach& wanted)
        : plan_(plan), heights_{contours}, wanted_(wanted) {
        if (wanted.steps > usual_reaches.front())
            planned_ = plan_reaches(plan, contours, wanted);
        const NodeStars stars(plan);
        for (std::uint32_t node = 0; node < plan.nodes.size(); ++node)
            around_.push_back(stars.around(node));
    }

    [[nodiscard]] PinchesTaken take();

  private:
    [[nodiscard]] std::optional<FinePoint> place_for(std::uint32_t node, const std::vector<NodeArm>& arms,
                                                     std::span<const FinePoint> ring) const;
    [[nodiscard]] bool is_free(std::uint32_t node, const std::vector<NodeArm>& arms, FinePoint place) const;
    [[nodiscard]] bool take_one(std::uint32_t node, const Pinch& pinch);
    [[nodiscard]] bool move_far(std::uint32_t node, const Pinch& pinch);
    [[nodiscard]] bool move_usual(std::uint32_t node, const Pinch& pinch);
    [[nodiscard]] PassedOver passed_over(std::uint32_t node, const std::vector<NodeArm>& arms,
                                         FinePoint place) const;
    void move(std::uint32_t node, const SectorRun& run, FinePoint place, bool fills);

    Plan& plan_;
    Heights heights_;
    const PinchReach& wanted_;
    PlannedReaches planned_;
    std::optional<NearEdges> near_;  // made when the first node moves
    std::vector<std::vector<NodeArm>> around_;
    PinchesTaken taken_;
};

/// Moving a corner sweeps a triangle an arm: no other node may lie in one, and nothing may cross the way.
bool PinchTaker::is_free(std::uint32_t node, const std::vector<NodeArm>& arms, FinePoint place) const {
    const FinePoint from = plan_.nodes[node];
    const auto in_triangle = [&](FinePoint a, FinePoint point) {
        const int s = side(from, place, a);
        return s * side(from, place, point) >= 0 && s * side(place, a, point) >= 0 &&
               s * side(a, from, point) >= 0;
    };
    std::vector<FinePoint> swept{from, place};
    for (const NodeArm& arm : arms) {
        swept.push_back(plan_.nodes[arm.end]);
        if (side(from, place, swept.back()) == 0)
            return false;
    }
    bool free = true;
    near_->visit(swept, [&](const PlanEdge& edge) {
        const bool own = edge.from == node || edge.to == node;
        if (free && !own)
            free = !meet({plan_.nodes[edge.from], plan_.nodes[edge.to]}, {from, place});
        for (const std::uint32_t end : {edge.from, edge.to})
            for (std::size_t i = 0; free && end != node && i < arms.size(); ++i)
                free = end == arms[i].end || !in_triangle(swept[i + 2], plan_.nodes[end]);
    });
    return free;
}

/// The freest direction first. @return nothing where there is no room at this reach
std::optional<FinePoint> PinchTaker::place_for(std::uint32_t node, const std::vector<NodeArm>& arms,
                                               std::span<const FinePoint> ring) const {
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
        if (is_free(node, arms, place))
            return place;
    return std::nullopt;
}

PassedOver PinchTaker::passed_over(std::uint32_t node, const std::vector<NodeArm>& arms,
                                   FinePoint place) const {
    PassedOver area;
    for (const NodeArm& arm : arms)
        area.add(arm, plan_.nodes[arm.end], plan_.nodes[node], place);
    return area;
}

void PinchTaker::move(std::uint32_t node, const SectorRun& run, FinePoint place, bool fills) {
    taken_.mends.push_back({plan_.nodes[node], place, fills, contours_of(around_[node])});
    if (wanted_.take)
        wanted_.take(taken_.mends.back().contours,
                     passed_over(node, arms_of(around_[node], run), place).outside);
    const auto moved = static_cast<std::uint32_t>(plan_.nodes.size());
    std::vector<NodeArm>& all = around_[node];
    std::vector<NodeArm> arms = arms_of(all, run);
    plan_.nodes.push_back(place);
    for (const NodeArm& arm : arms) {
        PlanEdge& edge = plan_.edges[arm.edge];
        (edge.from == node ? edge.from : edge.to) = moved;
        for (NodeArm& back : around_[arm.end])
            if (back.edge == arm.edge)
                back.end = moved;
        std::erase_if(all, [&](const NodeArm& other) { return other.edge == arm.edge; });
    }
    const std::int32_t left = arms.back().left;
    const std::int32_t right = arms.front().right;
    if (left != right) {
        const auto edge = static_cast<std::uint32_t>(plan_.edges.size());
        plan_.edges.push_back({node, moved, left, right});
        all.push_back({edge, moved, left, right});
        arms.push_back({edge, node, right, left});
    }
    around_.push_back(std::move(arms));
    sort_around(plan_, node, around_[node]);
    sort_around(plan_, moved, around_[moved]);
}

/// As far as was planned, or as little less as there is room for and as is allowed.
bool PinchTaker::move_far(std::uint32_t node, const Pinch& pinch) {
    const auto planned = planned_.find(plan_.nodes[node]);
    const std::vector<std::int32_t> contours = contours_of(around_[node]);
    for (const std::int64_t reach :
         reaches_down_from(planned == planned_.end() ? wanted_.steps : planned->second)) {
        const std::vector<FinePoint> ring = circle(reach);
        std::optional<std::pair<SectorRun, FinePoint>> best;
        double least = 0;
        for (const SectorRun& run : pinch.runs) {
            const std::vector<NodeArm> arms = arms_of(around_[node], run);
            const auto place = place_for(node, arms, ring);
            if (!place)
                continue;
            const PassedOver area = passed_over(node, arms, *place);
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

bool PinchTaker::move_usual(std::uint32_t node, const Pinch& pinch) {
    for (const std::int64_t reach : usual_reaches) {
        const std::vector<FinePoint> ring = square(reach);
        for (const SectorRun& run : pinch.runs)
            if (const auto place = place_for(node, arms_of(around_[node], run), ring)) {
                move(node, run, *place, pinch.fills);
                return true;
            }
    }
    return false;
}

bool PinchTaker::take_one(std::uint32_t node, const Pinch& pinch) {
    if (around_[node].size() > most_arms)
        return false;
    if (!near_)
        near_.emplace(plan_,
                      static_cast<std::int64_t>(most_arms) * std::max(wanted_.steps, usual_reaches.back()));
    return move_far(node, pinch) || move_usual(node, pinch);
}

/// Each move leaves both nodes with fewer edges than the one had, so that this ends.
PinchesTaken PinchTaker::take() {
    for (std::uint32_t node = 0; node < plan_.nodes.size(); ++node)
        while (const auto pinch = find_pinch(around_[node], heights_))
            if (!take_one(node, *pinch)) {
                for (const std::int32_t contour : contours_of(around_[node]))
                    taken_.stuck.push_back(static_cast<std::uint32_t>(contour));
                break;
            }
    std::ranges::sort(taken_.stuck);
    return std::move(taken_);
}

}  // namespace

PinchesTaken take_apart_pinches(Plan& plan, std::span<const PlanContour> contours, const PinchReach& wanted) {
    return PinchTaker(plan, contours, wanted).take();
}

}  // namespace d2b
