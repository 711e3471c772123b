// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "core/number_text.hpp"
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

/// "[[[0,1,2]],[[2,1,3]]]"
std::string boundaries(Triangles triangles) {
    std::string text;
    for (const ShellTriangle& triangle : triangles) {
        const auto& [a, b, c] = triangle.points;
        text += (text.empty() ? "[[" : ",[[") + std::to_string(a) + "," + std::to_string(b) + "," +
                std::to_string(c) + "]]";
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

std::string building(const CityBuilding& of, const std::string& lod, Triangles triangles) {
    return R"({"type":"Building",)" +
           (of.attributes.empty() ? "" : R"("attributes":)" + of.attributes + ",") +
           R"("geometry":[{"type":"MultiSurface","lod":)" + quoted(lod) + R"(,"boundaries":)" +
           boundaries(triangles) + R"(,"semantics":)" + semantics(triangles) + "}]}";
}

std::string relief(const std::string& lod, Triangles triangles) {
    return R"({"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":)" + quoted(lod) +
           R"(,"boundaries":)" + boundaries(triangles) + "}]}";
}

std::string extent(const NamedShell& shell) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 6> box{far, far, far, -far, -far, -far};
    for (const SurfacePoint& point : shell.shell.points) {
        const std::array<double, 3> at = shell.frame.coordinates(point);
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
    sink(R"({"type":"CityJSON","version":"2.0","metadata":{"geographicalExtent":)" + extent(shell) +
         (crs.empty() ? "" : R"(,"referenceSystem":)" + quoted(crs)) + R"(},"transform":{"scale":)" +
         list(shell.frame.scale) + R"(,"translate":)" + list(shell.frame.translate) +
         "},\n\"CityObjects\":{");
    std::string comma = "\n";
    for_each_object(shell, [&](const std::string& name, Triangles triangles) {
        const std::int32_t of = triangles.front().building;
        if (of < 0 && triangles.front().part != ShellPart::terrain)
            return;  // sides and plate are no part of a city
        sink(comma + quoted(name) + ":" +
             (of < 0 ? relief(lod, triangles)
                     : building(shell.city.buildings[static_cast<std::size_t>(of)], lod, triangles)));
        comma = ",\n";
    });
    sink("},\n\"vertices\":[");
    comma = "\n";
    for (const SurfacePoint& point : shell.shell.points) {
        sink(comma + "[" + std::to_string(point.x) + "," + std::to_string(point.y) + "," +
             std::to_string(point.z) + "]");
        comma = ",\n";
    }
    sink("]}\n");
}

}  // namespace d2b::mesh
