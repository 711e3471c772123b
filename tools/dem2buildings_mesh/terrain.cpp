// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/disjoint_sets.hpp"

namespace d2b::mesh {
namespace {

std::int64_t steps(double metres, const PlanFrame& frame) {
    return std::llround(metres / frame.metres_of_height());
}

std::array<Position, 3> corners_of(const PlanMesh& mesh, const PlanTriangle& triangle) {
    return {mesh.nodes[triangle.nodes[0]], mesh.nodes[triangle.nodes[1]], mesh.nodes[triangle.nodes[2]]};
}

/// Metres of a column's and of a row's way.
Position cell_size(const GroundGrid& grid, const PlanFrame& frame) {
    const Position origin = grid.plane({0, 0});
    const Position right = grid.plane({1, 0});
    const Position below = grid.plane({0, 1});
    return {std::hypot(right.x - origin.x, right.y - origin.y) * frame.metres(),
            std::hypot(below.x - origin.x, below.y - origin.y) * frame.metres()};
}

std::vector<std::array<Position, 2>> outlines(const PlanDrawing& drawing) {
    std::vector<std::array<Position, 2>> edges;
    for (const surface::PartitionEdge& edge : drawing.edges)
        if ((edge.left == surface::open_ground) != (edge.right == surface::open_ground))
            edges.push_back({drawing.nodes[edge.from], drawing.nodes[edge.to]});
    return edges;
}

/// Returns sets of regions that are lifted together, because they meet at a slanted roof, and would cross
/// along a wall if one were lifted alone.
DisjointSets regions_at_slopes(const PlanMesh& mesh, const std::vector<Region>& regions) {
    DisjointSets sets(static_cast<std::uint32_t>(regions.size()));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> region_at;
    for (const PlanTriangle& triangle : mesh.triangles) {
        if (triangle.region < 0)
            continue;
        const auto here = static_cast<std::uint32_t>(triangle.region);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(triangle.nodes[i], triangle.nodes[(i + 1) % 3]);
            const std::uint32_t other = region_at.try_emplace({low, high}, here).first->second;
            if (regions[here].plane || regions[other].plane)
                sets.join(here, other);
        }
    }
    return sets;
}

void lift_roof(Region& region, std::int64_t lift) {
    region.top += lift;
    if (region.plane)
        region.plane->height += static_cast<double>(lift);
}

}  // namespace

std::size_t lay_ground(PlanDrawing& drawing, GroundGrid& grid, double margin_metres, const PlanFrame& frame) {
    grid.leave_out(outlines(drawing));
    Position low{0, 0};
    Position high{static_cast<double>(grid.cols()), static_cast<double>(grid.rows())};
    std::size_t outside = 0;
    for (const Position& node : drawing.nodes) {
        const Position cell = grid.cell(node);
        constexpr double far = 1;  // walls may stand a little off the last cells
        outside += cell.x < -far || cell.y < -far || cell.x > grid.cols() + far || cell.y > grid.rows() + far
                       ? 1U
                       : 0U;
        // No footprint lies at the border.
        low = {std::min(low.x, cell.x - 1), std::min(low.y, cell.y - 1)};
        high = {std::max(high.x, cell.x + 1), std::max(high.y, cell.y + 1)};
    }
    const Position size = cell_size(grid, frame);
    const Position margin{margin_metres / size.x, margin_metres / size.y};
    low = {low.x - margin.x, low.y - margin.y};
    high = {high.x + margin.x, high.y + margin.y};
    std::array<Position, 4> frame_corners{grid.plane(low), grid.plane({low.x, high.y}), grid.plane(high),
                                          grid.plane({high.x, low.y})};
    const auto turn = [](const Position& a, const Position& b, const Position& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    if (turn(frame_corners[0], frame_corners[1], frame_corners[2]) < 0)
        std::swap(frame_corners[1], frame_corners[3]);
    const auto first = static_cast<std::uint32_t>(drawing.nodes.size());
    for (std::uint32_t i = 0; i < frame_corners.size(); ++i) {
        drawing.nodes.push_back(frame_corners[i]);
        drawing.edges.push_back({first + i, first + (i + 1) % 4, surface::open_ground, beyond});
    }
    drawing.with_ground = true;
    return outside;
}

std::function<bool(const std::array<Position, 3>&)> too_far_from(const GroundGrid& grid,
                                                                 const MeshRequest& request,
                                                                 const PlanFrame& frame) {
    const Position size = cell_size(grid, frame);
    constexpr double smallest_share = 1.0 / 64;
    const double smallest = std::min(size.x, size.y) * smallest_share / frame.metres();
    // Heights are rounded to steps in the end.
    const double most = std::max(0.5, request.ground_error / frame.metres_of_height() - 1);
    const double height = frame.metres_of_height() / frame.metres();
    const double longest =
        request.max_edge > 0 ? request.max_edge / frame.metres() : std::numeric_limits<double>::infinity();
    return [&grid, smallest, most, height, longest](const std::array<Position, 3>& corners) {
        std::array<double, 3> z{};
        std::ranges::transform(corners, z.begin(), [&](const Position& at) { return grid.elevation(at); });
        double length = 0;
        bool too_long = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t k = (i + 1) % 3;
            const double plane = std::hypot(corners[k].x - corners[i].x, corners[k].y - corners[i].y);
            length = std::max(length, plane);
            too_long = too_long || std::hypot(plane, (z[k] - z[i]) * height) > longest;
        }
        if (too_long)
            return true;
        return length > smallest &&
               !grid.errors(corners, z, [&](std::size_t, double error) { return error <= most; });
    };
}

PlanHeights heights_over(const PlanMesh& mesh, std::vector<Region> regions, const GroundGrid& grid,
                         const MeshRequest& request, const PlanFrame& frame, const CityModel& city,
                         MeshReport& report) {
    PlanHeights heights{std::move(regions), {}, 0};
    for (const Position& node : mesh.nodes)
        heights.terrain.push_back(std::llround(grid.elevation(node)));
    std::vector<bool> beside(mesh.nodes.size());
    std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
    for (const PlanTriangle& triangle : mesh.triangles)
        for (const std::uint32_t node : triangle.nodes)
            if (triangle.region == surface::open_ground) {
                beside[node] = true;
                lowest = std::min(lowest, heights.terrain[node]);
            }
    heights.plate = lowest - std::max<std::int64_t>(1, steps(request.base, frame));
    const std::int64_t wall = std::max<std::int64_t>(1, steps(request.min_wall, frame));
    heights.raise_roofs(mesh, frame);
    std::vector<std::int64_t> lift(heights.regions.size(), 0);
    std::vector<std::uint32_t> place(heights.regions.size());
    for (const PlanTriangle& triangle : mesh.triangles)
        for (const std::uint32_t node : triangle.nodes) {
            if (triangle.region < 0 || !beside[node])
                continue;
            const auto region = static_cast<std::size_t>(triangle.region);
            const std::int64_t missing = heights.terrain[node] + wall - heights.top(triangle.region, node);
            if (missing > lift[region]) {
                lift[region] = missing;
                place[region] = node;
            }
        }
    DisjointSets together = regions_at_slopes(mesh, heights.regions);
    std::vector<std::int64_t> most(lift.size(), 0);  // by root
    for (std::uint32_t i = 0; i < together.size(); ++i) {
        std::int64_t& of_set = most[together.find(i)];
        of_set = std::max(of_set, lift[i]);
        if (lift[i] == 0)
            continue;
        report.lifted.push_back({frame.world(mesh.nodes[place[i]]),
                                 static_cast<double>(lift[i]) * frame.metres_of_height(),
                                 city.buildings[static_cast<std::size_t>(heights.regions[i].building)].name});
    }
    for (std::uint32_t i = 0; i < together.size(); ++i)
        lift_roof(heights.regions[i], most[together.find(i)]);
    heights.raise_roofs(mesh, frame);
    return heights;
}

void measure_terrain(const PlanMesh& mesh, const PlanHeights& heights, const GroundGrid& grid,
                     const MeshRequest& request, const PlanFrame& frame, MeshReport& report) {
    double largest = 0;
    for (const PlanTriangle& triangle : mesh.triangles) {
        if (triangle.region != surface::open_ground)
            continue;
        std::array<double, 3> z{};
        for (std::size_t i = 0; i < 3; ++i)
            z[i] = static_cast<double>(heights.terrain[triangle.nodes[i]]);
        grid.errors(corners_of(mesh, triangle), z, [&](std::size_t cell, double error) {
            const double metres = error * frame.metres_of_height();
            largest = std::max(largest, metres);
            if (metres > request.ground_error)
                report.missed.push_back({frame.world(grid.middle(cell)), metres, ""});
            return true;
        });
    }
    std::ranges::sort(report.missed, std::greater<>(), &NamedPlace::figure);
    report.ground_error = largest;
    report.ground_cells = grid.measured();
}

}  // namespace d2b::mesh
