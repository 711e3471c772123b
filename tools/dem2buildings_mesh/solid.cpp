// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/int128.hpp"
#include "surface/roof_heights.hpp"

namespace d2b::mesh {
namespace {

using Ring = std::vector<SurfacePoint>;
using DirectedEdge = std::pair<SurfacePoint, SurfacePoint>;

/// Twice the area that a face covers in the plan, positive where it faces up.
Int128 twice_area(const SolidFace& face) {
    Int128 area = 0;
    for (const Ring& ring : face.rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const SurfacePoint& a = ring[i];
            const SurfacePoint& b = ring[i + 1 == ring.size() ? 0 : i + 1];
            area += static_cast<Int128>(a.x) * b.y - static_cast<Int128>(b.x) * a.y;
        }
    return area;
}

bool level(const SolidFace& face) {
    const std::int64_t z = face.rings.front().front().z;
    return std::ranges::all_of(face.rings, [&](const Ring& ring) {
        return std::ranges::all_of(ring, [&](const SurfacePoint& point) { return point.z == z; });
    });
}

/// Corners of an upright face lie on a line of the plan.
bool upright(const SolidFace& face) {
    const Ring& ring = face.rings.front();
    const auto other = std::ranges::find_if(ring, [&](const SurfacePoint& point) {
        return point.x != ring.front().x || point.y != ring.front().y;
    });
    if (other == ring.end())
        return false;
    const auto on_line = [&](const SurfacePoint& point) {
        return static_cast<Int128>(other->x - ring.front().x) * (point.y - ring.front().y) ==
               static_cast<Int128>(other->y - ring.front().y) * (point.x - ring.front().x);
    };
    return std::ranges::all_of(face.rings,
                               [&](const Ring& part) { return std::ranges::all_of(part, on_line); });
}

std::vector<DirectedEdge> edges_of(const std::vector<SolidFace>& faces) {
    std::vector<DirectedEdge> edges;
    for (const SolidFace& face : faces)
        for (const Ring& ring : face.rings)
            for (std::size_t i = 0; i < ring.size(); ++i)
                edges.emplace_back(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    return edges;
}

bool closed(const std::vector<SolidFace>& faces) {
    std::vector<DirectedEdge> there = edges_of(faces);
    std::vector<DirectedEdge> back;
    back.reserve(there.size());
    for (const DirectedEdge& edge : there)
        back.emplace_back(edge.second, edge.first);
    std::ranges::sort(there);
    std::ranges::sort(back);
    return std::ranges::adjacent_find(there) == there.end() && there == back;
}

surface::RoofPlane plane_of(const SolidFace& face) {
    std::vector<std::array<double, 3>> corners;
    for (const Ring& ring : face.rings)
        for (const SurfacePoint& p : ring)
            corners.push_back(
                {static_cast<double>(-p.y), static_cast<double>(p.x), static_cast<double>(p.z)});
    return surface::fit_plane(corners);
}

bool is_plane(const SolidFace& face) {
    constexpr double most = 2;
    const surface::RoofPlane plane = plane_of(face);
    return std::ranges::all_of(face.rings, [&](const Ring& ring) {
        return std::ranges::all_of(ring, [&](const SurfacePoint& p) {
            return std::abs(plane.height_at(static_cast<double>(-p.y), static_cast<double>(p.x)) -
                            static_cast<double>(p.z)) <= most;
        });
    });
}

std::optional<std::string> fault_of(const SolidFace& face, bool slanted) {
    if (face.kind == FaceKind::wall)
        return upright(face) ? std::nullopt : std::optional("has a wall that is not upright");
    const char* const name = face.kind == FaceKind::roof ? "a roof" : "a ground";
    if (slanted && face.kind == FaceKind::roof) {
        if (!is_plane(face))
            return "has a roof that is not plane";
    } else if (!level(face))
        return "has " + std::string(name) + " that is not level";
    const Int128 area = twice_area(face);
    if (face.kind == FaceKind::roof ? area <= 0 : area >= 0)
        return "has " + std::string(name) + " that faces the wrong way";
    return std::nullopt;
}

FineRing plan_of(const Ring& ring) {
    FineRing plan;
    plan.reserve(ring.size());
    for (const SurfacePoint& point : ring)
        plan.push_back({-point.y, point.x});
    return plan;
}

}  // namespace

std::optional<std::string> fault_of(const std::vector<SolidFace>& faces, bool slanted) {
    Int128 covered = 0;
    for (const SolidFace& face : faces) {
        if (std::ranges::any_of(face.rings, [](const Ring& ring) { return ring.size() < 3; }))
            return "has a face of fewer than three corners";
        if (auto fault = fault_of(face, slanted))
            return fault;
        covered += face.kind == FaceKind::wall ? 0 : twice_area(face);
    }
    if (faces.empty() || !closed(faces))
        return "is not closed";
    if (covered != 0)
        return "has roofs that cover more or less than its grounds";
    return std::nullopt;
}

CityBuilding building_of(const std::vector<SolidFace>& faces) {
    CityBuilding building;
    std::optional<std::int64_t> base;
    for (const SolidFace& face : faces) {
        const std::int64_t z = face.rings.front().front().z;
        if (face.kind == FaceKind::ground)
            base = std::min(base.value_or(z), z);
        if (face.kind != FaceKind::roof)
            continue;
        CityRoof& roof = building.roofs.emplace_back();
        roof.z = z;
        if (!level(face)) {
            roof.plane = plane_of(face);
            for (const Ring& ring : face.rings)
                for (const SurfacePoint& point : ring)
                    roof.z = std::min(roof.z, point.z);
        }
        roof.outline.exterior = plan_of(face.rings.front());
        for (std::size_t i = 1; i < face.rings.size(); ++i)
            roof.outline.interiors.push_back(plan_of(face.rings[i]));
    }
    building.base = base.value_or(0);
    return building;
}

}  // namespace d2b::mesh
