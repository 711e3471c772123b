#include "dem2buildings_score/report.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "dem2buildings/version.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
    return fixed_text(100 * share, 2) + " %";
}

std::string metres(const std::optional<double>& value) {
    return value ? fixed_text(*value, 3) + " m" : "-";
}

std::string degrees(double angle) {
    return fixed_text(angle, 2) + " deg";
}

class Lines {
  public:
    explicit Lines(bool quiet) : quiet_(quiet) {}
    void add(std::string_view name, const std::string& figure, const std::string& behind = "") {
        constexpr std::size_t width_of_names = 22;
        constexpr std::size_t width_of_figures = 12;
        const std::string padding(width_of_names - name.size(), ' ');
        text_ += std::string(name) + padding + figure;
        if (!quiet_ && !behind.empty()) {
            text_ +=
                std::string(figure.size() < width_of_figures ? width_of_figures - figure.size() : 0, ' ');
            text_ += "  " + behind;
        }
        text_ += "\n";
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    bool quiet_;
    std::string text_;
};

std::string of(std::size_t part, std::size_t whole) {
    return std::to_string(part) + " of " + std::to_string(whole);
}

std::string square_metres(double area) {
    return fixed_text(area, 1) + " m2";
}

void add_heights(Lines& lines, const Score& score) {
    if (!score.heights)
        return lines.add("height error", "-");
    const HeightErrors& errors = *score.heights;
    lines.add("height error, mean", metres(errors.mean),
              std::to_string(errors.pairs) + " pairs with heights");
    lines.add("height error, RMS", metres(errors.rms));
    lines.add("height error, median", metres(errors.median_absolute), "of absolute values");
}

/// A figure of shape for both sides. @param shown turns it into text
template <typename Shown>
void add_shape(Lines& lines, std::string_view name, const Score& score, const Shown& shown) {
    for (const SideScore* side : {&score.found, &score.reference}) {
        const auto& [figure, behind] = shown(side->shape);
        lines.add(side == &score.found ? name : "  of the reference", figure, behind);
    }
}

void add_shapes(Lines& lines, const Score& score) {
    using Figure = std::pair<std::string, std::string>;
    const auto corners = [](const ShapeScore& shape) { return std::to_string(shape.corners); };
    add_shape(lines, "corners per building", score, [&](const ShapeScore& shape) {
        return Figure{fixed_text(shape.corners_per_building, 2),
                      corners(shape) + " of " + std::to_string(shape.polygons) + " polygons"};
    });
    add_shape(lines, "right corners", score, [&](const ShapeScore& shape) {
        return Figure{percent(shape.right_share), "of " + corners(shape)};
    });
    add_shape(lines, "sharp corners", score, [&](const ShapeScore& shape) {
        return Figure{percent(shape.sharp45_share), "of " + corners(shape) + ", below 45 deg"};
    });
    add_shape(lines, "along main direction", score, [](const ShapeScore& shape) {
        return Figure{percent(shape.along_share), "of the outline's length"};
    });
    if (score.found.shape.short_edge_share && score.reference.shape.short_edge_share)
        add_shape(lines, "short edges", score, [&](const ShapeScore& shape) {
            return Figure{percent(*shape.short_edge_share), "of " + corners(shape) + ", below 2 cells"};
        });
}

void add_directions(Lines& lines, const Score& score) {
    if (!score.directions)
        return lines.add("direction error", "-");
    const DirectionErrors& errors = *score.directions;
    lines.add("direction, median", degrees(errors.median_deg),
              std::to_string(errors.pairs) + " pairs below 400 m2");
    lines.add("direction, p90", degrees(errors.p90_deg));
}

Json json_of(const SideScore& side, const std::string& dataset, const std::string& layer) {
    return {{"dataset", dataset},        {"layer", layer},
            {"features", side.features}, {"invalid", side.invalid},
            {"vertices", side.vertices}, {"area_m2", side.area_m2},
            {"objects", side.objects},   {"objects_covered", side.objects_covered}};
}

Json number_or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const std::optional<HeightErrors>& heights) {
    if (!heights)
        return nullptr;
    return {{"pairs", heights->pairs},
            {"mean_m", heights->mean},
            {"rms_m", heights->rms},
            {"median_absolute_m", heights->median_absolute}};
}

Json json_of(const ShapeScore& shape) {
    return {{"polygons", shape.polygons},
            {"corners", shape.corners},
            {"corners_per_building", shape.corners_per_building},
            {"right_share", shape.right_share},
            {"sharp45_share", shape.sharp45_share},
            {"along_share", shape.along_share},
            {"short_edge_share", number_or_null(shape.short_edge_share)}};
}

/// Names the datasets that were compared. @param run ScoreRun or RoofScoreRun
template <typename Run>
void add_inputs(Lines& lines, const ScoreRequest& request, const Run& run) {
    lines.add("found", request.found + ", layer " + run.found_layer);
    lines.add("reference", request.reference + ", layer " + run.reference_layer);
    lines.add("measured in", run.crs.empty() ? "plain units" : run.crs);
}

Json shape_json(const ScoreRun& run) {
    const std::optional<DirectionErrors>& directions = run.score.directions;
    return {{"cell_m", number_or_null(run.cell_m)},
            {"found", json_of(run.score.found.shape)},
            {"reference", json_of(run.score.reference.shape)},
            {"direction_pairs", directions ? directions->pairs : 0},
            {"direction_median_deg", directions ? Json(directions->median_deg) : Json(nullptr)},
            {"direction_p90_deg", directions ? Json(directions->p90_deg) : Json(nullptr)}};
}

}  // namespace

std::string score_text(const ScoreRequest& request, const ScoreRun& run, bool quiet) {
    const Score& score = run.score;
    Lines lines(quiet);
    if (!quiet)
        add_inputs(lines, request, run);
    lines.add("completeness", percent(score.completeness),
              square_metres(score.shared_m2) + " of " + square_metres(score.reference.area_m2));
    lines.add("correctness", percent(score.correctness),
              square_metres(score.shared_m2) + " of " + square_metres(score.found.area_m2));
    lines.add("IoU", percent(score.iou));
    lines.add("object completeness", percent(score.object_completeness),
              of(score.reference.objects_covered, score.reference.objects));
    lines.add("object correctness", percent(score.object_correctness),
              of(score.found.objects_covered, score.found.objects));
    lines.add("outline RMS", metres(score.outline_rms_m),
              "over " + fixed_text(score.outline_near_m, 1) + " of " + fixed_text(score.outline_m, 1) + " m");
    lines.add("overlap", percent(score.overlap));
    lines.add("invalid", std::to_string(score.found.invalid), "of " + std::to_string(score.found.features));
    lines.add("vertex ratio", fixed_text(score.vertex_ratio, 3),
              std::to_string(score.found.vertices) + " to " + std::to_string(score.reference.vertices));
    lines.add("PoLiS", metres(score.polis_m), std::to_string(score.pairs) + " pairs");
    add_heights(lines, score);
    add_shapes(lines, score);
    add_directions(lines, score);
    return lines.text();
}

std::string score_json(const ScoreRequest& request, const ScoreRun& run,
                       const std::vector<std::string>& warnings) {
    const Score& score = run.score;
    Json json{{"version", version},
              {"found", json_of(score.found, request.found, run.found_layer)},
              {"reference", json_of(score.reference, request.reference, run.reference_layer)},
              {"crs", run.crs},
              {"metres", run.metres},
              {"limited", run.limited},
              {"min_object_m2", request.min_object_m2},
              {"shared_m2", score.shared_m2},
              {"completeness", score.completeness},
              {"correctness", score.correctness},
              {"iou", score.iou},
              {"object_completeness", score.object_completeness},
              {"object_correctness", score.object_correctness},
              {"outline_m", score.outline_m},
              {"outline_near_m", score.outline_near_m},
              {"outline_rms_m", number_or_null(score.outline_rms_m)},
              {"overlap", score.overlap},
              {"invalid", score.found.invalid},
              {"vertex_ratio", score.vertex_ratio},
              {"pairs", score.pairs},
              {"polis_m", number_or_null(score.polis_m)},
              {"height_field",
               run.reference_height_field.empty() ? Json(nullptr) : Json(run.reference_height_field)},
              {"height_error", json_of(score.heights)},
              {"shape", shape_json(run)},
              {"warnings", warnings}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

void add_angles(Lines& lines, const std::string& name, const std::optional<AngleErrors>& errors) {
    lines.add(name + ", median", errors ? degrees(errors->median_deg) : "-");
    lines.add(name + ", p90", errors ? degrees(errors->p90_deg) : "-");
}

/// Adds a line per type with the types that were found for its buildings: "gabled 140, hipped 14".
void add_types(Lines& lines, const RoofScore& score) {
    for (const auto& [type, found] : score.types) {
        std::size_t all = 0;
        std::string text;
        for (const auto& [name, count] : found) {
            all += count;
            text += (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(count);
        }
        // Names are those of the datasets.
        lines.add("  " + type.substr(0, 18), of(found.contains(type) ? found.at(type) : 0, all), text);
    }
}

Json json_of(const std::optional<AngleErrors>& errors) {
    if (!errors)
        return nullptr;
    return {{"median_deg", errors->median_deg}, {"p90_deg", errors->p90_deg}};
}

}  // namespace

std::string roof_score_text(const ScoreRequest& request, const RoofScoreRun& run, bool quiet) {
    const RoofScore& score = run.score;
    const std::string shared = "of " + square_metres(score.shared_m2);
    Lines lines(quiet);
    if (!quiet)
        add_inputs(lines, request, run);
    lines.add("roofs covered", percent(score.covered),
              square_metres(score.shared_m2) + " of " + square_metres(score.reference_m2));
    lines.add("overlap", percent(score.overlap));
    lines.add("slope and azimuth", percent(score.angles_right), shared + ", within 5 and 10 deg");
    lines.add("without a slope", percent(score.without_slope), shared);
    add_angles(lines, "slope error", score.slope);
    add_angles(lines, "azimuth error", score.azimuth);
    lines.add("height and slope", percent(score.heights_right), shared + ", within 1 m and 5 deg");
    lines.add("  IoU", percent(score.heights_iou), "of the area in either");
    lines.add("roof type", percent(score.type_right),
              of(score.right, score.compared) + " buildings covered by half, of " +
                  std::to_string(score.buildings));
    lines.add("  of pairs", percent(score.pair_type_right),
              of(score.pairs_right, score.pairs) + " with an IoU of 0.5 or more");
    if (!quiet)
        add_types(lines, score);
    return lines.text();
}

std::string roof_score_json(const ScoreRequest& request, const RoofScoreRun& run,
                            const std::vector<std::string>& warnings) {
    const RoofScore& score = run.score;
    const auto side = [](const std::string& dataset, const std::string& layer, std::size_t faces,
                         double area) {
        return Json{{"dataset", dataset}, {"layer", layer}, {"faces", faces}, {"area_m2", area}};
    };
    Json types = Json::object();
    for (const auto& [type, found] : score.types)
        for (const auto& [name, count] : found)
            types[type][name] = count;
    const Json json{{"version", version},
                    {"found", side(request.found, run.found_layer, score.found_faces, score.found_m2)},
                    {"reference",
                     side(request.reference, run.reference_layer, score.reference_faces, score.reference_m2)},
                    {"crs", run.crs},
                    {"metres", run.metres},
                    {"limited", run.limited},
                    {"min_object_m2", request.min_object_m2},
                    {"shared_m2", score.shared_m2},
                    {"covered", score.covered},
                    {"overlap", score.overlap},
                    {"slope_azimuth_right", score.angles_right},
                    {"without_slope", score.without_slope},
                    {"slope_error", json_of(score.slope)},
                    {"azimuth_error", json_of(score.azimuth)},
                    {"height_slope_right", score.heights_right},
                    {"height_slope_iou", score.heights_iou},
                    {"buildings", score.buildings},
                    {"buildings_compared", score.compared},
                    {"type_right", score.type_right},
                    {"pairs", score.pairs},
                    {"pair_type_right", score.pair_type_right},
                    {"types", types},
                    {"warnings", warnings}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace d2b
