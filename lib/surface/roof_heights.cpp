#include "surface/roof_heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/partition_editor.hpp"

namespace d2b::surface {
namespace {

/// Range in steps of height of roofs that meet at a node.
constexpr double meeting_range = 1.2;
/// Least distance of other roofs, because programs that read solids merge corners within a millimetre.
constexpr std::int64_t least_distance = 2;
/// Largest difference at the end of an edge that is removed because roofs cross next to it.
constexpr std::int64_t most_joined = 2;
constexpr int joining_rounds = 4;

bool has_plane(std::int32_t contour, std::span<const PartitionContour> contours) {
    return contour != open_ground && contours[static_cast<std::size_t>(contour)].plane.has_value();
}

/// Roof at a node before rounding.
struct Reached {
    double height = 0;
    std::int32_t contour = 0;
    double cosine = 1;  ///< of its slope; 0: level, where other corners have the same height

    friend auto operator<=>(const Reached&, const Reached&) = default;
};

Reached reached(std::int32_t contour, double row, double col, std::span<const PartitionContour> contours) {
    const PartitionContour& of = contours[static_cast<std::size_t>(contour)];
    if (!of.plane)
        return {static_cast<double>(of.top), contour, 0};
    return {of.plane->height_at(row, col), contour, of.plane->cosine};
}

/// Height of roofs that meet: that of a level one, or a mean that leaves planes at equal distances.
std::int64_t common_height(std::span<const Reached> meeting) {
    double sum = 0;
    double weights = 0;
    for (const Reached& one : meeting) {
        if (one.cosine == 0)
            return std::llround(one.height);
        sum += one.height * one.cosine;
        weights += one.cosine;
    }
    return std::llround(sum / weights);
}

/// Differences of the roofs on both sides of an edge at its ends, left minus right.
struct Differences {
    std::int64_t from = 0;
    std::int64_t to = 0;

    [[nodiscard]] bool cross() const { return (from < 0 && to > 0) || (from > 0 && to < 0); }
};

/// Returns the way between two corners to the east, to the north and upwards.
std::array<double, 3> way(const RoofPlane& plane, const RoofCorner& from, const RoofCorner& to) {
    return {(to[1] - from[1]) * plane.col_step, (from[0] - to[0]) * plane.row_step, to[2] - from[2]};
}

/// Returns true if a corner is on the line between its neighbours in plan, to within a step of height, but
/// not in space. A Delaunay triangulation in the plane of the face then has a triangle of the three, if they
/// are so near each other that no other corner is in their circumcircle.
bool bends_shortly(const RoofPlane& plane, const RoofCorner& from, const RoofCorner& corner,
                   const RoofCorner& to) {
    constexpr double shortest = 200;  // steps
    const std::array<double, 3> all = way(plane, from, to);
    const double length = std::hypot(all[0], all[1]);
    if (length == 0 || length > shortest)
        return false;
    const std::array<double, 3> part = way(plane, from, corner);
    const double off = (all[0] * part[1] - all[1] * part[0]) / length;
    const double along = (all[0] * part[0] + all[1] * part[1]) / (length * length);
    return std::abs(off) < 1 && part[2] != along * all[2];
}

Differences differences(const PartitionEdge& edge, const PlanarPartition& plan, const RoofHeights& heights) {
    if (edge.left == open_ground || edge.right == open_ground)
        return {};
    const auto at = [&](std::uint32_t node) {
        const FinePoint p = plan.nodes[node];
        return heights.at(edge.left, p) - heights.at(edge.right, p);
    };
    return {at(edge.from), at(edge.to)};
}

}  // namespace

/// Least squares, because corners are not exactly on a plane.
RoofPlane fit_plane(std::span<const RoofCorner> points) {
    std::array<double, 3> mean{};
    for (const auto& point : points)
        for (std::size_t i = 0; i < point.size(); ++i)
            mean[i] += point[i] / static_cast<double>(points.size());
    const FinePoint at{std::llround(mean[0]), std::llround(mean[1])};
    double rr = 0;
    double rc = 0;
    double cc = 0;
    double rz = 0;
    double cz = 0;
    for (const auto& point : points) {
        const double r = point[0] - mean[0];
        const double c = point[1] - mean[1];
        const double z = point[2] - mean[2];
        rr += r * r;
        rc += r * c;
        cc += c * c;
        rz += r * z;
        cz += c * z;
    }
    RoofPlane plane{at, mean[2], 0, 0, 1};
    if (const double determinant = rr * cc - rc * rc; determinant > 0) {
        plane.per_row = (rz * cc - cz * rc) / determinant;
        plane.per_col = (cz * rr - rz * rc) / determinant;
    }
    plane.height += (static_cast<double>(at.row) - mean[0]) * plane.per_row +
                    (static_cast<double>(at.col) - mean[1]) * plane.per_col;
    return plane;
}

double angle_between(const RoofPlane& plane, const std::array<RoofCorner, 3>& corners) {
    const std::array<double, 3> a = way(plane, corners[0], corners[1]);
    const std::array<double, 3> b = way(plane, corners[0], corners[2]);
    const double area = a[0] * b[1] - a[1] * b[0];
    // Rise per unit of length.
    const double east = (a[2] * b[1] - a[1] * b[2]) / area;
    const double north = (a[0] * b[2] - a[2] * b[0]) / area;
    const double plane_east = plane.per_col / plane.col_step;
    const double plane_north = -plane.per_row / plane.row_step;
    const double cosine = (1 + east * plane_east + north * plane_north) /
                          (std::hypot(1, east, north) * std::hypot(1, plane_east, plane_north));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

bool is_twisted(const RoofPlane& plane, const PartitionFace& face,
                std::span<const PartitionTriangle> triangles,
                const std::function<RoofCorner(std::uint32_t node)>& corner_at) {
    constexpr double most_degrees = 10;
    const auto turns_away = [&](const PartitionTriangle& triangle) {
        return angle_between(plane, {corner_at(triangle[0]), corner_at(triangle[1]),
                                     corner_at(triangle[2])}) > most_degrees;
    };
    const auto bends = [&](const std::vector<std::uint32_t>& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i)
            if (bends_shortly(plane, corner_at(ring[i]), corner_at(ring[(i + 1) % ring.size()]),
                              corner_at(ring[(i + 2) % ring.size()])))
                return true;
        return false;
    };
    return std::ranges::any_of(triangles, turns_away) || bends(face.exterior) ||
           std::ranges::any_of(face.interiors, bends);
}

std::vector<std::int64_t> heights_at(double row, double col, std::span<const std::int32_t> around,
                                     std::span<const PartitionContour> contours) {
    std::vector<std::int64_t> heights;
    heights.reserve(around.size());
    for (const std::int32_t contour : around)
        heights.push_back(contour == open_ground ? no_height
                                                 : contours[static_cast<std::size_t>(contour)].top);
    if (std::ranges::none_of(around, [&](std::int32_t contour) { return has_plane(contour, contours); }))
        return heights;
    std::vector<Reached> roofs;
    for (const std::int32_t contour : around)
        if (contour != open_ground)
            roofs.push_back(reached(contour, row, col, contours));
    std::ranges::sort(roofs);
    roofs.erase(std::unique(roofs.begin(), roofs.end()), roofs.end());
    std::int64_t lowest = no_height;
    for (std::size_t begin = 0; begin < roofs.size();) {
        std::size_t end = begin + 1;
        while (end < roofs.size() && roofs[end].height - roofs[begin].height < meeting_range)
            ++end;
        const std::span<const Reached> meeting = std::span(roofs).subspan(begin, end - begin);
        const std::int64_t height = std::max(lowest, common_height(meeting));
        lowest = height + least_distance;
        for (std::size_t i = 0; i < around.size(); ++i)
            if (std::ranges::find(meeting, around[i], &Reached::contour) != meeting.end())
                heights[i] = height;
        begin = end;
    }
    return heights;
}

std::vector<FinePoint> split_crossings(PlanarPartition& plan, std::span<const PartitionContour> contours) {
    const RoofHeights heights(plan, contours);
    std::vector<std::pair<std::uint32_t, FinePoint>> crossings;
    for (std::uint32_t e = 0; e < plan.edges.size(); ++e) {
        const PartitionEdge& edge = plan.edges[e];
        const Differences difference = differences(edge, plan, heights);
        if (!difference.cross())
            continue;
        const auto before = static_cast<double>(std::abs(difference.from));
        const double share = before / (before + static_cast<double>(std::abs(difference.to)));
        const FinePoint a = plan.nodes[edge.from];
        const FinePoint b = plan.nodes[edge.to];
        crossings.emplace_back(e, outline::point_between(a, b, share));
    }
    if (crossings.empty())
        return {};
    std::vector<FinePoint> places;
    PartitionEditor editor(std::move(plan));
    for (const auto& [edge, place] : crossings)
        if (editor.split(edge, place))
            places.push_back(place);
    plan = editor.plan();
    std::ranges::sort(places);
    return places;
}

RoofHeights::RoofHeights(const PlanarPartition& plan, std::span<const PartitionContour> contours) {
    for (const PartitionContour& contour : contours)
        tops_.push_back(contour.top);
    std::vector<std::pair<std::uint32_t, std::int32_t>> around;  // nodes and contours
    std::vector<bool> is_slanted(plan.nodes.size());
    for (const PartitionEdge& edge : plan.edges)
        for (const std::uint32_t node : {edge.from, edge.to})
            for (const std::int32_t contour : {edge.left, edge.right})
                if (contour != open_ground) {
                    around.emplace_back(node, contour);
                    is_slanted[node] = is_slanted[node] || has_plane(contour, contours);
                }
    std::erase_if(around, [&](const auto& one) { return !is_slanted[one.first]; });
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::vector<std::int32_t> here;
    for (std::size_t begin = 0; begin < around.size();) {
        const std::uint32_t node = around[begin].first;
        here.clear();
        std::size_t end = begin;
        for (; end < around.size() && around[end].first == node; ++end)
            here.push_back(around[end].second);
        const std::vector<std::int64_t> heights = heights_at(plan.nodes[node], here, contours);
        for (std::size_t i = 0; i < here.size(); ++i)
            entries_.push_back({plan.nodes[node], here[i], heights[i]});
        begin = end;
    }
    std::ranges::sort(entries_);
}

std::int64_t RoofHeights::at(std::int32_t contour, FinePoint node) const {
    if (!entries_.empty())
        if (const auto found = std::ranges::lower_bound(entries_, Entry{node, contour, no_height});
            found != entries_.end() && found->node == node && found->contour == contour)
            return found->height;
    return tops_[static_cast<std::size_t>(contour)];
}

std::span<RoofHeights::Entry> RoofHeights::entries_at(FinePoint node) {
    const auto at_node = [](const Entry& entry, FinePoint place) { return entry.node < place; };
    const auto first = std::lower_bound(entries_.begin(), entries_.end(), node, at_node);
    const auto last =
        std::find_if(first, entries_.end(), [&](const Entry& entry) { return entry.node != node; });
    return {first, last};
}

/// Gives all roofs at the heights of two contours their mean height.
void RoofHeights::join(FinePoint node, std::int32_t a, std::int32_t b) {
    const std::int64_t low = at(a, node);
    const std::int64_t high = at(b, node);
    for (Entry& entry : entries_at(node))
        if (entry.height == low || entry.height == high)
            entry.height = (low + high) / 2;
}

std::vector<std::int32_t> RoofHeights::join_near_crossings(const PlanarPartition& plan) {
    if (entries_.empty())
        return {};
    std::vector<std::int32_t> left;
    for (int round = 0; round < joining_rounds; ++round) {
        left.clear();
        for (const PartitionEdge& edge : plan.edges) {
            const Differences difference = differences(edge, plan, *this);
            if (!difference.cross())
                continue;
            left.push_back(edge.left);
            left.push_back(edge.right);
            const bool at_start = std::abs(difference.from) < std::abs(difference.to);
            if (std::min(std::abs(difference.from), std::abs(difference.to)) <= most_joined)
                join(plan.nodes[at_start ? edge.from : edge.to], edge.left, edge.right);
        }
        if (left.empty())
            return {};
    }
    std::ranges::sort(left);
    left.erase(std::unique(left.begin(), left.end()), left.end());
    return left;
}

std::vector<std::int32_t> RoofHeights::uneven_roofs(std::span<const PartitionContour> contours) const {
    constexpr double most = 1;  // step
    std::vector<Entry> corners = entries_;
    std::erase_if(corners, [&](const Entry& entry) { return !has_plane(entry.contour, contours); });
    std::ranges::stable_sort(corners, {}, &Entry::contour);
    std::vector<std::int32_t> uneven;
    std::vector<RoofCorner> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto& [node, contour, height] = corners[i];
        points.push_back(
            {static_cast<double>(node.row), static_cast<double>(node.col), static_cast<double>(height)});
        if (i + 1 < corners.size() && corners[i + 1].contour == contour)
            continue;
        const RoofPlane fit = fit_plane(points);
        const double cosine = contours[static_cast<std::size_t>(contour)].plane->cosine;
        if (std::ranges::any_of(points, [&](const RoofCorner& point) {
                return std::abs(point[2] - fit.height_at(point[0], point[1])) * cosine > most;
            }))
            uneven.push_back(contour);
        points.clear();
    }
    return uneven;
}

}  // namespace d2b::surface
