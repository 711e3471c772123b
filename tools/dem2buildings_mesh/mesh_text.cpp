// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/mesh_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/text.hpp"
#include "write/surface/obj_stl_sink.hpp"

namespace d2b::mesh {
namespace {

/// Some of a step of the mesh, so that rounding adds next to nothing.
int decimals_of(double step) {
    constexpr double parts = 4;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(step / parts))), 0, 12);
}

std::string plain(double value, int decimals) {
    std::string text = fixed_text(value, decimals);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.'))
            text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

const char* name_of(ShellPart part) {
    switch (part) {
        case ShellPart::roof:
            return "roof";
        case ShellPart::wall:
            return "wall";
        case ShellPart::ground:
            return "ground";
        case ShellPart::terrain:
            return "terrain";
        case ShellPart::sides:
            return "sides";
        case ShellPart::plate:
            return "plate";
    }
    return "";
}

std::array<double, 3> unit_normal(const SurfaceFrame& frame, const Shell& shell, const ShellTriangle& t) {
    std::array<std::array<double, 3>, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
        at[i] = frame.local(shell.points[t.points[i]]);
    const auto edge = [&](std::size_t to, std::size_t axis) { return at[to][axis] - at[0][axis]; };
    std::array<double, 3> normal{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        normal[axis] = edge(1, u) * edge(2, v) - edge(1, v) * edge(2, u);
    }
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& part : normal)
        part = length > 0 ? part / length : 0;
    return normal;
}

}  // namespace

std::string local_text(const SurfaceFrame& frame, const SurfacePoint& point) {
    const std::array<double, 3> at = frame.local(point);
    const int plane = decimals_of(std::min(frame.scale[0], frame.scale[1]) * frame.horizontal_metres);
    const int height = decimals_of(frame.scale[2] * frame.vertical_metres);
    return plain(at[0], plane) + " " + plain(at[1], plane) + " " + plain(at[2], height);
}

void for_each_object(
    const NamedShell& shell,
    const std::function<void(const std::string& name, std::span<const ShellTriangle>)>& take) {
    const std::vector<ShellTriangle>& all = shell.shell.triangles;
    const auto key = [](const ShellTriangle& triangle) {
        return std::pair(triangle.building, triangle.building < 0 ? triangle.part : ShellPart::roof);
    };
    for (auto begin = all.begin(); begin != all.end();) {
        const auto end = std::find_if(begin, all.end(), [&](const auto& t) { return key(t) != key(*begin); });
        take(begin->building < 0 ? name_of(begin->part)
                                 : shell.city.buildings[static_cast<std::size_t>(begin->building)].name,
             {begin, end});
        begin = end;
    }
}

void write_stl(const NamedShell& shell, const TextSink& sink) {
    for_each_object(shell, [&](const std::string& name, std::span<const ShellTriangle> triangles) {
        sink("solid " + name + " origin " + writing::origin_text(shell.frame) + "\n");
        for (const ShellTriangle& triangle : triangles) {
            std::string text = "facet normal";
            for (const double part : unit_normal(shell.frame, shell.shell, triangle))
                text += " " + plain(part, 6);
            text += "\nouter loop\n";
            for (const std::uint32_t point : triangle.points)
                text += "vertex " + local_text(shell.frame, shell.shell.points[point]) + "\n";
            sink(text + "endloop\nendfacet\n");
        }
        sink("endsolid " + name + "\n");
    });
}

void write_obj(const NamedShell& shell, const TextSink& sink) {
    sink("# dem2buildings_mesh: metres from the origin, x to the east, y to the north, z up\n");
    sink("# origin: " + writing::origin_text(shell.frame) + "\n");
    for (const SurfacePoint& point : shell.shell.points)
        sink("v " + local_text(shell.frame, point) + "\n");
    for_each_object(shell, [&](const std::string& name, std::span<const ShellTriangle> triangles) {
        std::string text = "o " + name + "\n";
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (i == 0 || triangles[i].part != triangles[i - 1].part)
                text += std::string("g ") + name_of(triangles[i].part) + "\n";
            text += "f";
            for (const std::uint32_t point : triangles[i].points)
                text += " " + std::to_string(point + 1);
            text += "\n";
        }
        sink(text);
    });
}

}  // namespace d2b::mesh
