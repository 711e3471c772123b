// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/measure_shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dem2buildings_mesh/plan_mesh.hpp"

namespace d2b::mesh {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// A triangle with sides of these lengths, laid into the plane.
std::array<Position, 3> laid_flat(const Corners& at) {
    const double c = distance(at[0], at[1]);
    const double b = distance(at[0], at[2]);
    const double a = distance(at[1], at[2]);
    const double x = (b * b + c * c - a * a) / (2 * c);
    return {Position{0, 0}, Position{c, 0}, Position{x, std::sqrt(std::max(0.0, b * b - x * x))}};
}

std::array<Position, 3> from_above(const Corners& at) {
    return {Position{at[0][0], at[0][1]}, Position{at[1][0], at[1][1]}, Position{at[2][0], at[2][1]}};
}

bool upright(ShellPart part) {
    return part == ShellPart::wall || part == ShellPart::sides;
}

}  // namespace

void measure_shell(const NamedShell& shell, double min_angle, MeshReport& report) {
    report.points = static_cast<std::int64_t>(shell.shell.points.size());
    report.triangles = static_cast<std::int64_t>(shell.shell.triangles.size());
    report.origin = shell.frame.origin;
    report.smallest_angle = report.smallest_wall_angle = 180;
    for (const ShellTriangle& triangle : shell.shell.triangles) {
        Corners at{};
        for (std::size_t i = 0; i < 3; ++i)
            at[i] = shell.frame.local(shell.shell.points[triangle.points[i]]);
        for (std::size_t i = 0; i < 3; ++i)
            report.longest_edge = std::max(report.longest_edge, distance(at[i], at[(i + 1) % 3]));
        if (upright(triangle.part)) {
            const double angle = smallest_angle(laid_flat(at)).degrees;
            report.smallest_wall_angle = std::min(report.smallest_wall_angle, angle);
            report.small_walls += angle < min_angle ? 1 : 0;
            continue;
        }
        const auto [angle, corner] = smallest_angle(from_above(at));
        report.smallest_angle = std::min(report.smallest_angle, angle);
        // Leaves out ground and plate, because their triangles are those above.
        if (angle < min_angle && (triangle.part == ShellPart::roof || triangle.part == ShellPart::terrain)) {
            const std::array<double, 3> place =
                shell.frame.coordinates(shell.shell.points[triangle.points[corner]]);
            report.small.push_back(
                {{place[0], place[1]},
                 angle,
                 triangle.building < 0
                     ? ""
                     : shell.city.buildings[static_cast<std::size_t>(triangle.building)].name});
        }
    }
}

}  // namespace d2b::mesh
