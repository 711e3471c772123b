// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/disjoint_sets.hpp"
#include "core/text.hpp"
#include "dem2buildings_mesh/mesh_text.hpp"

namespace d2b::mesh {
namespace {

using Triangles = std::span<const ShellTriangle>;

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string list(const std::array<double, 3>& numbers) {
    return "[" + numbers_text(numbers, ",") + "]";
}

/// Selects the triangles that are written: sides and plate are no part of a city.
bool is_of_city(Triangles triangles) {
    return triangles.front().building >= 0 || triangles.front().part == ShellPart::terrain;
}

/// The corners of a city, numbered anew.
struct CityVertices {
    std::vector<std::uint32_t> points;  ///< of the shell
    std::vector<std::uint32_t> number;  ///< of each point of the shell that is one of them

    explicit CityVertices(const NamedShell& shell) : number(shell.shell.points.size()) {
        std::vector<bool> used(number.size());
        for_each_object(shell, [&](const std::string& /*name*/, Triangles triangles) {
            if (is_of_city(triangles))
                for (const ShellTriangle& triangle : triangles)
                    for (const std::uint32_t point : triangle.points)
                        used[point] = true;
        });
        for (std::uint32_t point = 0; point < used.size(); ++point)
            if (used[point]) {
                number[point] = static_cast<std::uint32_t>(points.size());
                points.push_back(point);
            }
    }
};

/// "[[[0,1,2]],[[2,1,3]]]"
std::string boundaries(Triangles triangles, const CityVertices& vertices) {
    std::string text;
    for (const ShellTriangle& triangle : triangles) {
        const auto& [a, b, c] = triangle.points;
        text += (text.empty() ? "[[" : ",[[") + std::to_string(vertices.number[a]) + "," +
                std::to_string(vertices.number[b]) + "," + std::to_string(vertices.number[c]) + "]]";
    }
    return "[" + text + "]";
}

std::string semantics(Triangles triangles) {
    std::string values;
    for (const ShellTriangle& triangle : triangles)
        values += (values.empty() ? "" : ",") + std::to_string(static_cast<int>(triangle.part));
    return R"({"surfaces":[{"type":"RoofSurface"},{"type":"WallSurface"},{"type":"GroundSurface"}],"values":[)" +
           values + "]}";
}

std::string building(const CityBuilding& of, const std::string& lod, Triangles triangles,
                     const CityVertices& vertices) {
    return (of.whole.empty() ? R"({"type":"Building",)"
                             : R"({"type":"BuildingPart","parents":[)" + quoted(of.whole) + "],") +
           (of.attributes.empty() ? "" : R"("attributes":)" + of.attributes + ",") +
           R"("geometry":[{"type":"MultiSurface","lod":)" + quoted(lod) + R"(,"boundaries":)" +
           boundaries(triangles, vertices) + R"(,"semantics":)" + semantics(triangles) + "}]}";
}

std::string relief(const std::string& lod, Triangles triangles, const CityVertices& vertices) {
    return R"({"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":)" + quoted(lod) +
           R"(,"boundaries":)" + boundaries(triangles, vertices) + "}]}";
}

/// The terrain in pieces that hang together by their edges, because a composite surface is in one: the ground
/// of a courtyard is one of its own. The piece of most triangles comes first.
std::vector<std::vector<ShellTriangle>> connected_parts(Triangles triangles) {
    struct Edge {
        std::uint32_t low = 0;
        std::uint32_t high = 0;
        std::uint32_t triangle = 0;

        auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({triangles[t].points[i], triangles[t].points[(i + 1) % 3]});
            edges.push_back({low, high, t});
        }
    std::ranges::sort(edges);
    DisjointSets sets(static_cast<std::uint32_t>(triangles.size()));
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
            static_cast<void>(sets.join(edges[i].triangle, edges[i - 1].triangle));
    std::vector<std::size_t> part(triangles.size());
    std::vector<std::vector<ShellTriangle>> parts;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t first = sets.find(t);
        if (first == t) {
            part[t] = parts.size();
            parts.emplace_back();
        }
        parts[part[first]].push_back(triangles[t]);
    }
    std::ranges::stable_sort(parts, std::ranges::greater{}, &std::vector<ShellTriangle>::size);
    return parts;
}

std::string extent(const NamedShell& shell, const CityVertices& vertices) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 6> box{far, far, far, -far, -far, -far};
    for (const std::uint32_t point : vertices.points) {
        const std::array<double, 3> at = shell.frame.coordinates(shell.shell.points[point]);
        for (std::size_t i = 0; i < 3; ++i) {
            box[i] = std::min(box[i], at[i]);
            box[i + 3] = std::max(box[i + 3], at[i]);
        }
    }
    return "[" + numbers_text(box, ",") + "]";
}

}  // namespace

void write_city_json(const NamedShell& shell, const TextSink& sink) {
    const std::string& crs = shell.city.reference_system;
    const std::string lod = shell.city.lod.empty() ? "1.2" : shell.city.lod;
    const CityVertices vertices(shell);
    sink(R"({"type":"CityJSON","version":"2.0","metadata":{"geographicalExtent":)" + extent(shell, vertices) +
         (crs.empty() ? "" : R"(,"referenceSystem":)" + quoted(crs)) + R"(},"transform":{"scale":)" +
         list(shell.frame.scale) + R"(,"translate":)" + list(shell.frame.translate) +
         "},\n\"CityObjects\":{");
    std::string comma = "\n";
    std::map<std::string, std::string> divided;  // names of parts, by those of their buildings
    for_each_object(shell, [&](const std::string& name, Triangles triangles) {
        const std::int32_t of = triangles.front().building;
        if (!is_of_city(triangles))
            return;
        const auto add = [&](const std::string& called, const std::string& object) {
            sink(comma + quoted(called) + ":" + object);
            comma = ",\n";
        };
        if (of >= 0) {
            const CityBuilding& one = shell.city.buildings[static_cast<std::size_t>(of)];
            add(name, building(one, lod, triangles, vertices));
            if (!one.whole.empty()) {
                std::string& parts = divided[one.whole];
                parts += (parts.empty() ? "" : ",") + quoted(name);
            }
            return;
        }
        const std::vector<std::vector<ShellTriangle>> parts = connected_parts(triangles);
        for (std::size_t i = 0; i < parts.size(); ++i)
            add(i == 0 ? name : name + "_" + std::to_string(i + 1), relief(lod, parts[i], vertices));
    });
    for (const auto& [name, parts] : divided) {
        sink(comma + quoted(name) + R"(:{"type":"Building","children":[)" + parts + "]}");
        comma = ",\n";
    }
    sink("},\n\"vertices\":[");
    comma = "\n";
    for (const std::uint32_t used : vertices.points) {
        const SurfacePoint& point = shell.shell.points[used];
        sink(comma + "[" + std::to_string(point.x) + "," + std::to_string(point.y) + "," +
             std::to_string(point.z) + "]");
        comma = ",\n";
    }
    sink("]}\n");
}

}  // namespace d2b::mesh
