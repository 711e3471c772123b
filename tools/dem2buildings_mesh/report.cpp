// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/report.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "dem2buildings/version.hpp"

namespace d2b::mesh {
namespace {

using ReportJson = nlohmann::ordered_json;

constexpr std::size_t most_places = 10;

std::string line(std::string_view name, const std::string& figure) {
    constexpr std::size_t width = 26;
    return std::string(name) + std::string(width - name.size(), ' ') + figure + "\n";
}

/// "  84012.500 446103.250: 12.3 deg, building_4". @param unit "" where there is no figure
std::string places(const std::vector<NamedPlace>& all, const std::string& unit) {
    std::string text;
    for (std::size_t i = 0; i < std::min(all.size(), most_places); ++i)
        text += "  " + fixed_text(all[i].at.x, 3) + " " + fixed_text(all[i].at.y, 3) +
                (unit.empty() ? "" : ": " + fixed_text(all[i].figure, 2) + " " + unit) +
                (all[i].building.empty() ? "" : ", " + all[i].building) + "\n";
    if (all.size() > most_places)
        text += "  and " + std::to_string(all.size() - most_places) + " more; -json lists all\n";
    return text;
}

std::string below(std::int64_t count, const MeshRequest& request) {
    return std::to_string(count) + " of less than " + number_text(request.min_angle) + " deg";
}

ReportJson json_of(const std::vector<NamedPlace>& all, const char* figure) {
    ReportJson list = ReportJson::array();
    for (const NamedPlace& place : all) {
        ReportJson& item = list.emplace_back(ReportJson{{"x", place.at.x}, {"y", place.at.y}});
        if (*figure != '\0')
            item[figure] = place.figure;
        if (!place.building.empty())
            item["building"] = place.building;
    }
    return list;
}

}  // namespace

std::string mesh_text(const MeshRequest& request, const MeshReport& report) {
    std::string text =
        line("buildings", std::to_string(report.buildings)) +
        line("points of the plan", std::to_string(report.plan_points) + ", of the footprints " +
                                       std::to_string(report.footprint_points)) +
        line("points", std::to_string(report.points)) + line("triangles", std::to_string(report.triangles)) +
        line("smallest angle", fixed_text(report.smallest_angle, 2) + " deg, " +
                                   below(static_cast<std::int64_t>(report.small.size()), request)) +
        places(report.small, "deg") +
        line("smallest angle of walls",
             fixed_text(report.smallest_wall_angle, 2) + " deg, " + below(report.small_walls, request)) +
        line("longest edge", fixed_text(report.longest_edge, 2) + " m") +
        line("origin", numbers_text(report.origin, " "));
    if (!report.pinches.empty())
        text += line("points separated", std::to_string(report.pinches.size())) + places(report.pinches, "");
    if (report.ground_error)
        text += line("terrain", "within " + fixed_text(*report.ground_error, 3) + " m of " +
                                    std::to_string(report.ground_cells) + " cells, " +
                                    std::to_string(report.missed.size()) + " farther than " +
                                    number_text(request.ground_error) + " m") +
                places(report.missed, "m") + line("roofs lifted", std::to_string(report.lifted.size())) +
                places(report.lifted, "m");
    return text;
}

std::string mesh_json(const MeshRequest& request, const MeshReport& report,
                      const std::vector<std::string>& warnings) {
    ReportJson json{{"version", version},
                    {"input", request.city},
                    {"output", request.destination},
                    {"buildings", report.buildings},
                    {"footprint_points", report.footprint_points},
                    {"plan_points", report.plan_points},
                    {"points", report.points},
                    {"triangles", report.triangles},
                    {"min_angle", request.min_angle},
                    {"smallest_angle", report.smallest_angle},
                    {"small_angles", json_of(report.small, "degrees")},
                    {"smallest_wall_angle", report.smallest_wall_angle},
                    {"small_wall_angles", report.small_walls},
                    {"longest_edge_m", report.longest_edge},
                    {"origin", report.origin},
                    {"separated_points", json_of(report.pinches, "")},
                    {"ground", nullptr},
                    {"warnings", warnings}};
    if (report.ground_error)
        json["ground"] = {{"raster", request.ground},
                          {"largest_error_m", *report.ground_error},
                          {"cells", report.ground_cells},
                          {"cells_beyond_tolerance", json_of(report.missed, "metres")},
                          {"lifted_roofs", json_of(report.lifted, "metres")}};
    return json.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

}  // namespace d2b::mesh
