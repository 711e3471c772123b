// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/stand_up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/columns.hpp"
#include "surface/roof_heights.hpp"

namespace d2b::mesh {
namespace {

/// Number of rounds; each halves the panels that are too long.
constexpr int most_rounds = 12;

/// A corner over a node of the plan.
struct Corner {
    std::uint32_t node = 0;
    std::int64_t z = 0;

    friend auto operator<=>(const Corner&, const Corner&) = default;
};

struct CornerTriangle {
    ShellPart part = ShellPart::roof;
    std::int32_t building = -1;
    std::array<Corner, 3> corners{};
};

class Builder {
  public:
    Builder(const PlanMesh& mesh, const PlanHeights& heights, const PlanFrame& frame, double max_edge)
        : mesh_(mesh),
          heights_(heights),
          frame_(frame),
          max_edge_(max_edge),
          panels_(wall_panels(mesh, heights)),
          columns_(mesh.nodes.size(), panels_),
          steps_(mesh.nodes.size()) {}

    [[nodiscard]] Shell build();

  private:
    void add_level(const PlanTriangle& triangle);
    void add_wall(const WallPanel& panel, std::vector<CornerTriangle>& to) const;
    void divide_columns();
    [[nodiscard]] bool too_long(const WallPanel& panel) const;
    void divide_column(std::uint32_t node);
    [[nodiscard]] double length(const Corner& a, const Corner& b) const;
    [[nodiscard]] Shell join();

    const PlanMesh& mesh_;
    const PlanHeights& heights_;
    const PlanFrame& frame_;
    double max_edge_;
    std::vector<WallPanel> panels_;
    Columns columns_;
    std::vector<std::int64_t> steps_;  // between corners of a column, as of the last round; 0: not divided
    std::vector<CornerTriangle> triangles_;
};

double Builder::length(const Corner& a, const Corner& b) const {
    const Position& from = mesh_.nodes[a.node];
    const Position& to = mesh_.nodes[b.node];
    return std::hypot((to.x - from.x) * frame_.metres(), (to.y - from.y) * frame_.metres(),
                      static_cast<double>(b.z - a.z) * frame_.metres_of_height());
}

/// Adds a roof, or terrain, and the level below it.
void Builder::add_level(const PlanTriangle& triangle) {
    CornerTriangle top{ShellPart::terrain, -1, {}};
    CornerTriangle below{ShellPart::plate, -1, {}};
    std::int64_t level = heights_.plate;
    if (triangle.region >= 0) {
        const Region& region = heights_.regions[static_cast<std::size_t>(triangle.region)];
        top.part = ShellPart::roof;
        top.building = region.building;
        if (heights_.terrain.empty()) {
            below = {ShellPart::ground, region.building, {}};
            level = region.base;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t node = triangle.nodes[i];
        top.corners[i] = {node,
                          triangle.region < 0 ? heights_.terrain[node] : heights_.top(triangle.region, node)};
        below.corners[2 - i] = {node, level};
    }
    triangles_.push_back(top);
    triangles_.push_back(below);
}

/// Between two columns from below, always over the shorter of two diagonals.
void Builder::add_wall(const WallPanel& panel, std::vector<CornerTriangle>& to) const {
    const auto left = columns_.between(panel.left_node, panel.left_low, panel.left_high);
    const auto right = columns_.between(panel.right_node, panel.right_low, panel.right_high);
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < left.size() || j + 1 < right.size()) {
        const Corner a{panel.left_node, left[i]};
        const Corner b{panel.right_node, right[j]};
        bool rises_left = j + 1 == right.size();
        if (i + 1 < left.size() && j + 1 < right.size())
            rises_left =
                length({panel.left_node, left[i + 1]}, b) <= length(a, {panel.right_node, right[j + 1]});
        const Corner next =
            rises_left ? Corner{panel.left_node, left[++i]} : Corner{panel.right_node, right[++j]};
        to.push_back({panel.part, panel.building, {a, b, next}});
    }
}

void Builder::divide_column(std::uint32_t node) {
    std::int64_t& step = steps_[node];
    if (step == 0)
        step = std::max<std::int64_t>(
            1, std::llround(max_edge_ / std::numbers::sqrt2 / frame_.metres_of_height()));
    else
        step = std::max<std::int64_t>(1, step / 2);
    columns_.divide(node, step);
}

bool Builder::too_long(const WallPanel& panel) const {
    std::vector<CornerTriangle> triangles;
    add_wall(panel, triangles);
    return std::ranges::any_of(triangles, [&](const CornerTriangle& triangle) {
        const auto& [a, b, c] = triangle.corners;
        return std::max({length(a, b), length(b, c), length(c, a)}) > max_edge_;
    });
}

void Builder::divide_columns() {
    for (int round = 0; round <= most_rounds; ++round) {
        std::vector<std::uint32_t> nodes;
        for (const WallPanel& panel : panels_)
            if (too_long(panel))
                nodes.insert(nodes.end(), {panel.left_node, panel.right_node});
        if (nodes.empty())
            return;
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        if (round == most_rounds) {
            const Position at = frame_.world(mesh_.nodes[nodes.front()]);
            throw InputError("Edges of a wall at " + fixed_text(at.x, 3) + " " + fixed_text(at.y, 3) +
                             " stay longer than -max_edge; give a larger one.");
        }
        for (const std::uint32_t node : nodes)
            divide_column(node);
    }
}

Shell Builder::build() {
    if (max_edge_ > 0)
        divide_columns();
    for (const PlanTriangle& triangle : mesh_.triangles)
        add_level(triangle);
    for (const WallPanel& panel : panels_)
        add_wall(panel, triangles_);
    return join();
}

Shell Builder::join() {
    std::ranges::stable_sort(triangles_, {}, [](const CornerTriangle& triangle) {
        return std::tuple(static_cast<std::uint32_t>(triangle.building), triangle.part);
    });
    std::vector<Corner> corners;
    for (const CornerTriangle& triangle : triangles_)
        corners.insert(corners.end(), triangle.corners.begin(), triangle.corners.end());
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    Shell shell;
    for (const Corner& corner : corners)
        shell.points.push_back(frame_.steps(mesh_.nodes[corner.node], corner.z));
    for (const CornerTriangle& triangle : triangles_) {
        ShellTriangle& to = shell.triangles.emplace_back(ShellTriangle{triangle.part, triangle.building, {}});
        for (std::size_t i = 0; i < 3; ++i)
            to.points[i] = static_cast<std::uint32_t>(std::ranges::lower_bound(corners, triangle.corners[i]) -
                                                      corners.begin());
    }
    return shell;
}

}  // namespace

std::int64_t PlanHeights::top(std::int32_t region, std::uint32_t node) const {
    if (!slanted.empty())
        for (const auto& [at_node, height] : slanted[node])
            if (at_node == region)
                return height;
    return regions[static_cast<std::size_t>(region)].top;
}

void PlanHeights::raise_roofs(const PlanMesh& mesh, const PlanFrame& frame) {
    slanted.clear();
    if (std::ranges::none_of(regions, [](const Region& region) { return region.plane.has_value(); }))
        return;
    std::vector<surface::PartitionContour> contours;
    for (const Region& region : regions)
        contours.push_back({{}, -1, region.building, region.top, region.plane});
    std::vector<std::vector<std::int32_t>> around(mesh.nodes.size());
    for (const PlanTriangle& triangle : mesh.triangles)
        for (const std::uint32_t node : triangle.nodes)
            if (triangle.region >= 0 &&
                std::ranges::find(around[node], triangle.region) == around[node].end())
                around[node].push_back(triangle.region);
    slanted.resize(mesh.nodes.size());
    for (std::size_t node = 0; node < slanted.size(); ++node) {
        const Position at = frame.lattice(mesh.nodes[node]);
        const std::vector<std::int64_t> heights = surface::heights_at(at.y, at.x, around[node], contours);
        for (std::size_t i = 0; i < heights.size(); ++i)
            slanted[node].emplace_back(around[node][i], heights[i]);
    }
}

Shell stand_up(const PlanMesh& mesh, const PlanHeights& heights, const PlanFrame& frame, double max_edge) {
    return Builder(mesh, heights, frame, max_edge).build();
}

}  // namespace d2b::mesh
