// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/check_shell.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "core/int128.hpp"

namespace d2b::mesh {
namespace {

struct HalfEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t triangle = 0;

    friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

std::vector<HalfEdge> half_edges(const Shell& shell) {
    std::vector<HalfEdge> edges;
    for (std::uint32_t t = 0; t < shell.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            edges.push_back({shell.triangles[t].points[i], shell.triangles[t].points[(i + 1) % 3], t});
    std::ranges::sort(edges);
    return edges;
}

std::optional<ShellFault> open_edge(const std::vector<HalfEdge>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const HalfEdge& edge = edges[i];
        if (i > 0 && edges[i - 1].from == edge.from && edges[i - 1].to == edge.to)
            return ShellFault{"touches itself in an edge", edge.from};
        const auto back = std::ranges::lower_bound(edges, HalfEdge{edge.to, edge.from, 0});
        if (back == edges.end() || back->from != edge.to || back->to != edge.from)
            return ShellFault{"is open", edge.from};
    }
    return std::nullopt;
}

/// Around a point of a manifold, triangles that share an edge there are all of its triangles.
std::optional<ShellFault> torn_point(const Shell& shell, const std::vector<HalfEdge>& edges) {
    // Corner i of triangle t is number 3 t + i; corners at one point are joined over edges.
    DisjointSets fans(static_cast<std::uint32_t>(shell.triangles.size() * 3));
    const auto corner = [&](std::uint32_t triangle, std::uint32_t point) {
        const auto& points = shell.triangles[triangle].points;
        return triangle * 3 + static_cast<std::uint32_t>(std::ranges::find(points, point) - points.begin());
    };
    for (const HalfEdge& edge : edges)
        if (const auto back = std::ranges::lower_bound(edges, HalfEdge{edge.to, edge.from, 0});
            edge.from < edge.to)
            for (const std::uint32_t point : {edge.from, edge.to})
                static_cast<void>(fans.join(corner(edge.triangle, point), corner(back->triangle, point)));
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> fan(shell.points.size(), none);
    for (std::uint32_t i = 0; i < fans.size(); ++i) {
        const std::uint32_t point = shell.triangles[i / 3].points[i % 3];
        if (fan[point] != none && fan[point] != fans.find(i))
            return ShellFault{"touches itself in a point", point};
        fan[point] = fans.find(i);
    }
    return std::nullopt;
}

int turn(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
    const Int128 area =
        static_cast<Int128>(b.x - a.x) * (c.y - a.y) - static_cast<Int128>(b.y - a.y) * (c.x - a.x);
    return area > 0 ? 1 : (area < 0 ? -1 : 0);
}

std::optional<ShellFault> flat_triangle(const Shell& shell) {
    for (const ShellTriangle& triangle : shell.triangles) {
        const bool wall = triangle.part == ShellPart::wall || triangle.part == ShellPart::sides;
        const bool up = triangle.part == ShellPart::roof || triangle.part == ShellPart::terrain;
        const auto& [a, b, c] = triangle.points;
        if (!wall && turn(shell.points[a], shell.points[b], shell.points[c]) != (up ? 1 : -1))
            return ShellFault{"has corners nearer to each other than its grid", a};
    }
    return std::nullopt;
}

/// A point that equals another one. @param keys of the points
template <class Key>
std::optional<std::uint32_t> repeated(const std::vector<Key>& keys) {
    std::vector<std::uint32_t> order(keys.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto key = [&](std::uint32_t i) { return std::pair(keys[i], i); };
    std::ranges::sort(order, {}, key);
    const auto same = std::ranges::adjacent_find(
        order, [&](std::uint32_t a, std::uint32_t b) { return keys[a] == keys[b]; });
    return same == order.end() ? std::nullopt : std::optional(*same);
}

}  // namespace

std::optional<ShellFault> fault_of(const Shell& shell) {
    if (const auto point = repeated(shell.points))
        return ShellFault{"has corners nearer to each other than its grid", *point};
    if (auto fault = flat_triangle(shell))
        return fault;
    const std::vector<HalfEdge> edges = half_edges(shell);
    if (auto fault = open_edge(edges))
        return fault;
    return torn_point(shell, edges);
}

std::optional<std::uint32_t> merged_in_single(const Shell& shell, const SurfaceFrame& frame) {
    std::vector<std::array<float, 3>> points;
    for (const SurfacePoint& point : shell.points) {
        const std::array<double, 3> at = frame.local(point);
        points.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
    }
    return repeated(points);
}

}  // namespace d2b::mesh
