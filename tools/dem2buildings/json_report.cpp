#include "dem2buildings/json_report.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "dem2buildings/version.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

Json input_of(const RunReport& report) {
    return {{"name", report.input},
            {"driver", report.driver},
            {"crs", report.crs},
            {"rows", report.rows},
            {"cols", report.cols},
            {"points", report.points},
            {"valid_points", report.valid_points},
            {"minimum", report.minimum},
            {"maximum", report.maximum},
            {"mean", report.mean},
            {"standard_deviation", report.standard_deviation}};
}

Json units_of(const UnitReport& units) {
    return {{"horizontal", units.horizontal},
            {"horizontal_source", units.horizontal_source},
            {"horizontal_metres", units.horizontal_metres},
            {"vertical", units.vertical},
            {"vertical_source", units.vertical_source},
            {"vertical_metres", units.vertical_metres},
            {"areas", units.areas}};
}

Json levels_of(const RunReport& report) {
    Json levels = Json::array();
    for (const LevelReport& level : report.levels)
        levels.push_back(Json{{"level", level.level},
                              {"threshold", std::isfinite(level.threshold) ? Json(level.threshold) : Json()},
                              {"contours", level.contours},
                              {"points", level.points}});
    return levels;
}

Json length_of(const OutlineLength& length) {
    return {{"fitted", length.fitted}, {"simplified", length.simplified}, {"traced", length.traced}};
}

Json output_of(const RunReport& report) {
    return {{"name", report.output},
            {"crs", report.output_crs},
            {"buildings", report.buildings},
            {"doubtful", report.doubtful},
            {"stack_rmse_m", report.stack_rmse_m},
            {"contours", report.contours},
            {"vertices", report.vertices},
            {"outline_length_m",
             {{"buildings", length_of(report.building_outlines)},
              {"contours", length_of(report.contour_outlines)}}}};
}

Json roofs_of(const RoofReport& roofs) {
    return {{"faces", roofs.faces()},   {"flat", roofs.flat},
            {"pitched", roofs.pitched}, {"doubtful", roofs.doubtful},
            {"area_m2", roofs.area_m2}, {"doubtful_area_m2", roofs.doubtful_area_m2}};
}

Json surface_of(const SurfaceReport& surface) {
    return {{"origin", surface.origin},
            {"buildings", surface.buildings},
            {"blocks", surface.blocks},
            {"points", surface.points},
            {"triangles", surface.triangles}};
}

Json cuts_of(const std::vector<CutStack>& cuts) {
    Json list = Json::array();
    for (const CutStack& cut : cuts)
        list.push_back({{"level", cut.level}, {"rmse_m", cut.rmse_m}});
    return list;
}

Json move_of(const std::optional<ParcelMove>& move) {
    return move ? Json{{"right", move->right_m}, {"down", move->down_m}} : Json();
}

Json parcels_of(const ParcelReport& parcels) {
    return {{"cut_length_m", parcels.cut_length_m},
            {"near_wall_length_m", parcels.near_wall_length_m},
            {"median_distance_m",
             std::isfinite(parcels.median_distance_m) ? Json(parcels.median_distance_m) : Json()},
            {"best_offset_m", move_of(parcels.best_offset)},
            {"building_m2", parcels.building_m2},
            {"inside_m2", parcels.inside_m2},
            {"overlap_m2", parcels.overlap_m2},
            {"invalid_m2", parcels.invalid_m2}};
}

Json footprints_of(const FootprintReport& footprints) {
    return {{"given", footprints.given},
            {"measured", footprints.measured},
            {"outside", footprints.outside},
            {"without_cell", footprints.without_cell},
            {"without_data", footprints.without_data},
            {"without_polygon", footprints.without_polygon},
            {"invalid", footprints.invalid},
            {"flat", footprints.flat},
            {"missing", footprints.missing}};
}

Json corrections_of(const CorrectionReport& corrections) {
    return {{"building", corrections.building},
            {"no_building", corrections.no_building},
            {"cut", corrections.cut},
            {"outside", corrections.outside},
            {"without_effect", corrections.without_effect},
            {"unusable", corrections.unusable}};
}

Json number_of(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

Json sampling_of(const SamplingReport& sampling) {
    return {{"interpolated_fraction", sampling.interpolated_fraction},
            {"points_per_cell", number_of(sampling.points_per_cell)},
            {"edge_width_cells", number_of(sampling.edge_width_cells)},
            {"value_step", number_of(sampling.value_step)}};
}

Json dropped_of(const RunReport& report) {
    Json dropped = Json::object();
    for (std::size_t reason = 0; reason < reason_names.size(); ++reason)
        dropped[std::string(reason_names[reason])] = report.dropped[reason];
    return dropped;
}

Json stages_of(const RunReport& report) {
    Json stages = Json::object();
    for (std::size_t stage = 0; stage < stage_names.size(); ++stage)
        stages[std::string(stage_names[stage])] = {{"seconds", report.seconds[stage]},
                                                   {"peak_memory_bytes", report.peak_memory_bytes[stage]}};
    return stages;
}

}  // namespace

std::string json_report(const RunReport& report) {
    Json json{{"version", version},          {"input", input_of(report)},   {"units", units_of(report.units)},
              {"levels", levels_of(report)}, {"output", output_of(report)}, {"dropped", dropped_of(report)},
              {"threads", report.threads},   {"stages", stages_of(report)}, {"warnings", report.warnings}};
    if (report.roofs)
        json["roofs"] = roofs_of(*report.roofs);
    if (report.surface)
        json["surface"] = surface_of(*report.surface);
    if (!report.cuts.empty())
        json["truncated_stacks"] = cuts_of(report.cuts);
    if (report.parcels)
        json["parcels"] = parcels_of(*report.parcels);
    if (report.footprints)
        json["footprints"] = footprints_of(*report.footprints);
    if (report.corrections)
        json["corrections"] = corrections_of(*report.corrections);
    if (report.sampling)
        json["sampling"] = sampling_of(*report.sampling);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace d2b
