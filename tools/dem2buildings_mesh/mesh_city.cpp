// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/mesh_city.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/check_shell.hpp"
#include "dem2buildings_mesh/city_plan.hpp"
#include "dem2buildings_mesh/measure_shell.hpp"
#include "dem2buildings_mesh/mesh_file.hpp"
#include "dem2buildings_mesh/read_city.hpp"
#include "dem2buildings_mesh/read_ground.hpp"
#include "dem2buildings_mesh/refine_plan.hpp"
#include "dem2buildings_mesh/stand_up.hpp"
#include "dem2buildings_mesh/terrain.hpp"

namespace d2b::mesh {
namespace {

std::string at_text(double x, double y) {
    return fixed_text(x, 3) + " " + fixed_text(y, 3);
}

Crs crs_of(const CityModel& city) {
    Crs crs;
    try {
        crs = Crs(city.reference_system);
    } catch (const OptionError&) {
        throw InputError("'" + city.name + "' has a referenceSystem that PROJ does not know, '" +
                         city.reference_system + "'; give a file that -surface wrote.");
    }
    if (!city.reference_system.empty() && !crs.horizontal_unit())
        throw InputError("'" + city.name +
                         "' is in degrees, which are not lengths; make it again with -t_srs and a projected "
                         "coordinate reference system.");
    return crs;
}

surface::GapTolerances gaps_of(const CityModel& city, const Crs& crs) {
    const auto unit = crs.horizontal_unit();
    const double metres = FinePoint::steps * (unit ? unit->metres : 1);
    return surface::gap_tolerances({city.scale[0] * metres, city.scale[1] * metres});
}

PlanFrame frame_of(const CityModel& city, const CityPlan& plan, const Crs& crs) {
    PlanFrame frame;
    frame.corner = plan.plan.nodes.front();
    for (const FinePoint& node : plan.plan.nodes)
        frame.corner = {std::max(frame.corner.row, node.row), std::min(frame.corner.col, node.col)};
    frame.ratio = city.scale[1] / city.scale[0];
    frame.surface.scale = city.scale;
    for (std::size_t axis : {0U, 1U})
        frame.surface.scale[axis] /= static_cast<double>(parts_a_step);
    frame.surface.translate = city.translate;
    if (const auto unit = crs.horizontal_unit())
        frame.surface.horizontal_metres = frame.surface.vertical_metres = unit->metres;
    return frame;
}

/// The middle of the shell, below its lowest point, in whole metres.
std::array<double, 3> middle_of(const Shell& shell, const SurfaceFrame& frame) {
    std::array<double, 3> low = frame.local(shell.points.front());
    std::array<double, 3> high = low;
    for (const SurfacePoint& point : shell.points) {
        const std::array<double, 3> at = frame.local(point);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], at[axis]);
            high[axis] = std::max(high[axis], at[axis]);
        }
    }
    return {std::round((low[0] + high[0]) / 2), std::round((low[1] + high[1]) / 2), std::floor(low[2])};
}

PlanDrawing drawing_of(const CityPlan& plan, const PlanFrame& frame) {
    PlanDrawing drawing;
    for (const FinePoint& node : plan.plan.nodes)
        drawing.nodes.push_back(frame.plane(node));
    drawing.edges = plan.plan.edges;
    return drawing;
}

/// The terrain around the footprints.
void add_ground(const MeshRequest& request, const CityModel& city, const PlanFrame& frame, GroundGrid& ground,
                PlanDrawing& drawing, const Callbacks& callbacks) {
    const std::size_t corners = drawing.nodes.size();
    const std::size_t outside = lay_ground(drawing, ground, request.margin, frame);
    if (outside == corners)
        throw InputError("The terrain '" + request.ground + "' and '" + city.name +
                         "' do not meet; check the files and their coordinate reference systems.");
    if (outside > 0 && callbacks.on_warning)
        callbacks.on_warning(std::to_string(outside) + " of " + std::to_string(corners) + " corners of '" +
                             city.name + "' lie outside of the terrain '" + request.ground +
                             "', which continues flat beyond its edge.");
}

/// Each point takes a kilobyte of memory until the surface is written.
void require_few_points(const PlanDrawing& drawing, const MeshRequest& request, const PlanFrame& frame) {
    constexpr double most_points = 20e6;
    if (request.max_edge > 0 && fewest_points(drawing, request.max_edge / frame.metres()) > most_points)
        throw OptionError(
            "-max_edge " + number_text(request.max_edge) +
            " would take more than 20 million points; give a larger one, or a smaller part of the city.");
}

/// Cosine of the steepest roof: edges along its slope are longer than they are seen from above.
double least_cosine(const CityPlan& plan, const PlanFrame& frame) {
    const double height = frame.metres_of_height() / frame.metres();
    double least = 1;
    for (const Region& region : plan.regions)
        if (region.plane)
            least = std::min(least, 1 / std::hypot(1, region.plane->per_col * height,
                                                   region.plane->per_row * height / frame.ratio));
    return least;
}

PlanMesh divide(PlanDrawing& drawing, const CityPlan& plan, const MeshRequest& request,
                const std::optional<GroundGrid>& ground, const CityModel& city, const PlanFrame& frame) {
    RefineRules rules{request.min_angle, request.max_edge / frame.metres() * least_cosine(plan, frame)};
    if (request.max_edge > 0)
        split_long_edges(drawing, rules.max_edge / std::numbers::sqrt2);
    if (ground)
        rules.too_coarse = too_far_from(*ground, request, frame);
    try {
        return refine_plan(drawing, rules);
    } catch (const PlanFault& fault) {
        const Position at = frame.world(fault.at);
        throw InputError("'" + city.name + "' has two roofs over one place at " + at_text(at.x, at.y) +
                         "; the file is damaged.");
    }
}

void require_closed(const CityModel& city, const Shell& shell, const SurfaceFrame& frame, bool single) {
    if (const auto fault = fault_of(shell)) {
        const std::array<double, 3> at = frame.coordinates(shell.points[fault->point]);
        throw InputError("The surface of '" + city.name + "' " + fault->what + " at " +
                         at_text(at[0], at[1]) +
                         "; make the file again with -surface, which separates such places.");
    }
    if (!single)
        return;
    if (const auto point = merged_in_single(shell, frame)) {
        const std::array<double, 3> at = frame.coordinates(shell.points[*point]);
        throw InputError("Corners at " + at_text(at[0], at[1]) +
                         " would coincide in single precision; give an -origin near them, a smaller part of "
                         "the city, or .city.json as output.");
    }
}

}  // namespace

MeshReport mesh_city(const MeshRequest& request, const Callbacks& callbacks,
                     const ReportReader<MeshReport>& reader) {
    writing::FileWriter file(locate_mesh(request));
    const CityModel city = read_city(request.city);
    if (city.buildings.empty())
        throw InputError("'" + city.name + "' has no buildings; there is nothing to mesh.");
    const Crs crs = crs_of(city);
    const CityPlan plan = make_city_plan(city, gaps_of(city, crs));
    PlanFrame frame = frame_of(city, plan, crs);
    MeshReport report;
    report.buildings = static_cast<std::int64_t>(city.buildings.size());
    report.footprint_points = static_cast<std::int64_t>(plan.plan.nodes.size());
    for (const FinePoint& pinch : plan.pinches)
        report.pinches.push_back({frame.world(frame.plane(pinch)), 0, ""});

    PlanDrawing drawing = drawing_of(plan, frame);
    std::optional<GroundGrid> ground;
    if (!request.ground.empty()) {
        ground = read_ground(request, city, crs, frame, callbacks);
        add_ground(request, city, frame, *ground, drawing, callbacks);
    }
    require_few_points(drawing, request, frame);
    const PlanMesh mesh = divide(drawing, plan, request, ground, city, frame);
    report.plan_points = static_cast<std::int64_t>(mesh.nodes.size());
    PlanHeights heights{plan.regions, {}, 0};
    heights.raise_roofs(mesh, frame);
    if (ground) {
        heights = heights_over(mesh, plan.regions, *ground, request, frame, city, report);
        measure_terrain(mesh, heights, *ground, request, frame, report);
    }
    const Shell shell = stand_up(mesh, heights, frame, request.max_edge);
    frame.surface.origin = request.origin.value_or(middle_of(shell, frame.surface));
    require_closed(city, shell, frame.surface, is_local(request.destination));
    const NamedShell named{city, frame.surface, shell};
    measure_shell(named, request.min_angle, report);
    write_mesh(named, request.destination, file);
    CommitList commit;
    file.prepare(commit);
    if (reader.prepare)
        reader.prepare(report);
    commit.publish([&] {
        if (callbacks.on_warning)
            std::ranges::for_each(file.take_warnings(), callbacks.on_warning);
        if (reader.show)
            reader.show(report);
    });
    return report;
}

}  // namespace d2b::mesh
