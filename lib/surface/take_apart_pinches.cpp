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
#include "surface/plan_editor.hpp"

namespace d2b {
namespace {

/// How far a corner may move, in steps, where nothing else is asked for; what is usual comes first.
constexpr std::array<std::int64_t, 8> usual_reaches{2, 3, 4, 8, 16, 32, 64, 128};

/// A node with more edges is left as it is. Each move takes one away from where they were at least, so that
/// no edge's end goes farther than most_moved, however often it moves.
constexpr std::size_t most_arms = 32;

/// What is asked for, as little less as there is room for, and then what is usual.
std::vector<std::int64_t> reaches_from(std::int64_t wanted) {
    std::vector<std::int64_t> reaches;
    for (std::int64_t reach = wanted; reach > usual_reaches.front(); reach -= (reach + 3) / 4)
        reaches.push_back(reach);
    reaches.insert(reaches.end(), usual_reaches.begin(), usual_reaches.end());
    return reaches;
}

double angle_of(FinePoint from, FinePoint to) {
    return std::atan2(static_cast<double>(from.row - to.row), static_cast<double>(to.col - from.col));
}

/// From 0 to a full turn, counter-clockwise.
double turned_from(double a, double b) {
    const double turn = b - a;
    return turn > 0 ? turn : turn + 2 * std::numbers::pi;
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
    PinchTaker(Plan& plan, std::span<const PlanContour> contours, std::int64_t wanted)
        : plan_(plan), heights_{contours}, reaches_(reaches_from(wanted)) {
        const NodeStars stars(plan);
        for (std::uint32_t node = 0; node < plan.nodes.size(); ++node)
            around_.push_back(stars.around(node));
    }

    [[nodiscard]] PinchesTaken take();

  private:
    /// The arms that bound the sectors of a run, one more than these.
    [[nodiscard]] std::vector<NodeArm> arms_of(std::uint32_t node, const SectorRun& run) const;
    [[nodiscard]] std::optional<FinePoint> place_for(std::uint32_t node, const std::vector<NodeArm>& arms,
                                                     std::int64_t reach) const;
    [[nodiscard]] bool is_free(std::uint32_t node, const std::vector<NodeArm>& arms, FinePoint place) const;
    [[nodiscard]] bool move_one(std::uint32_t node, const Pinch& pinch);
    [[nodiscard]] Int128 swept_outside(std::uint32_t node, const std::vector<NodeArm>& arms,
                                       FinePoint place) const;
    void move(std::uint32_t node, const SectorRun& run, FinePoint place);
    [[nodiscard]] std::vector<std::int32_t> contours_at(std::uint32_t node) const;

    Plan& plan_;
    Heights heights_;
    std::vector<std::int64_t> reaches_;
    std::optional<NearEdges> near_;  // made when the first node moves
    std::vector<std::vector<NodeArm>> around_;
    PinchesTaken taken_;
};

std::vector<NodeArm> PinchTaker::arms_of(std::uint32_t node, const SectorRun& run) const {
    const std::vector<NodeArm>& all = around_[node];
    std::vector<NodeArm> arms;
    for (std::size_t i = 0; i <= run.count; ++i)
        arms.push_back(all[(run.first + i) % all.size()]);
    return arms;
}

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
                                               std::int64_t reach) const {
    const FinePoint from = plan_.nodes[node];
    const double first = angle_of(from, plan_.nodes[arms.front().end]);
    const double whole = turned_from(first, angle_of(from, plan_.nodes[arms.back().end]));
    std::vector<std::pair<double, FinePoint>> places;
    // Far away not every step counts.
    const std::int64_t stride = std::max<std::int64_t>(1, reach / 128);
    const std::int64_t far = reach - reach % stride;
    for (std::int64_t row = -far; row <= far; row += stride)
        for (std::int64_t col = -far; col <= far; col += std::abs(row) == far ? stride : 2 * far) {
            const FinePoint place{from.row + row, from.col + col};
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

Int128 PinchTaker::swept_outside(std::uint32_t node, const std::vector<NodeArm>& arms,
                                 FinePoint place) const {
    Int128 sum = 0;
    for (const NodeArm& arm : arms)
        if (arm.left == open_ground || arm.right == open_ground) {
            const Int128 twice = turn(plan_.nodes[node], place, plan_.nodes[arm.end]);
            sum += twice < 0 ? -twice : twice;
        }
    return sum;
}

void PinchTaker::move(std::uint32_t node, const SectorRun& run, FinePoint place) {
    const auto moved = static_cast<std::uint32_t>(plan_.nodes.size());
    std::vector<NodeArm>& all = around_[node];
    std::vector<NodeArm> arms = arms_of(node, run);
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

bool PinchTaker::move_one(std::uint32_t node, const Pinch& pinch) {
    if (!near_)
        near_.emplace(plan_, static_cast<std::int64_t>(most_arms) * std::ranges::max(reaches_));
    for (const std::int64_t reach : reaches_)
        for (const SectorRun& run : pinch.runs)
            if (const auto place = place_for(node, arms_of(node, run), reach)) {
                taken_.mends.push_back({plan_.nodes[node], *place,
                                        swept_outside(node, arms_of(node, run), *place), pinch.fills,
                                        contours_at(node)});
                move(node, run, *place);
                return true;
            }
    return false;
}

std::vector<std::int32_t> PinchTaker::contours_at(std::uint32_t node) const {
    std::vector<std::int32_t> contours;
    for (const NodeArm& arm : around_[node])
        if (arm.left != open_ground)
            contours.push_back(arm.left);
    std::ranges::sort(contours);
    contours.erase(std::unique(contours.begin(), contours.end()), contours.end());
    return contours;
}

/// Each move leaves both nodes with fewer edges than the one had, so that this ends.
PinchesTaken PinchTaker::take() {
    for (std::uint32_t node = 0; node < plan_.nodes.size(); ++node)
        while (const auto pinch = find_pinch(around_[node], heights_))
            if (around_[node].size() > most_arms || !move_one(node, *pinch)) {
                for (const std::int32_t contour : contours_at(node))
                    taken_.stuck.push_back(static_cast<std::uint32_t>(contour));
                break;
            }
    std::ranges::sort(taken_.stuck);
    return std::move(taken_);
}

/// Where a corner is to move far, long edges get a node nearby, so that not the whole of them moves.
void divide_near_pinches(Plan& plan, std::span<const PlanContour> contours, std::int64_t wanted) {
    PlanEditor editor(std::move(plan));
    const auto nodes = static_cast<std::uint32_t>(editor.nodes().size());
    for (std::uint32_t node = 0; node < nodes; ++node) {
        const std::vector<NodeArm> arms = editor.around(node);
        if (!find_pinch(arms, {contours}))
            continue;
        const FinePoint from = editor.at(node);
        for (const NodeArm& arm : arms) {
            const FinePoint to = editor.at(arm.end);
            const auto rows = static_cast<double>(to.row - from.row);
            const auto cols = static_cast<double>(to.col - from.col);
            const double share = 2 * static_cast<double>(wanted) / std::hypot(rows, cols);
            if (share < 0.6)
                static_cast<void>(editor.split(arm.edge, {from.row + std::llround(share * rows),
                                                          from.col + std::llround(share * cols)}));
        }
    }
    plan = editor.plan();
}

}  // namespace

PinchesTaken take_apart_pinches(Plan& plan, std::span<const PlanContour> contours, std::int64_t wanted) {
    if (wanted > usual_reaches.front())
        divide_near_pinches(plan, contours, wanted);
    return PinchTaker(plan, contours, wanted).take();
}

}  // namespace d2b
