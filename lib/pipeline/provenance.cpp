#include "pipeline/provenance.hpp"

#include <cmath>
#include <string>

#include "core/number_text.hpp"
#include "core/version.hpp"
#include "options/preset.hpp"

namespace d2b {
namespace {

std::string thresholds_of(const RunReport& report) {
    std::string text;
    for (const LevelReport& level : report.levels)
        if (level.level > 0 && std::isfinite(level.threshold))
            text += (text.empty() ? "" : " ") + number_text(level.threshold);
    return text;
}

std::string name_of(Walls walls) {
    switch (walls) {
        case Walls::automatic:
            return "auto";
        case Walls::right:
            return "right";
        case Walls::free:
            return "free";
        case Walls::off:
        case Walls::by_preset:
            break;
    }
    return "off";
}

std::string name_of(LevelSource source) {
    switch (source) {
        case LevelSource::building:
            return "building";
        case LevelSource::natural:
            return "natural";
        case LevelSource::global:
        case LevelSource::by_preset:
            break;
    }
    return "global";
}

std::map<std::string, std::string> detection_metadata(const Options& options) {
    const std::string ground = options.ground.mode == GroundMode::given  ? options.ground.terrain
                               : options.ground.mode == GroundMode::none ? "none"
                                                                         : "auto";
    return {{"D2B_GROUND", ground},
            {"D2B_MAX_BUILDING_WIDTH_M", number_text(options.ground.max_building_width)},
            {"D2B_MIN_HEIGHT_M", number_text(options.detect.min_height)},
            {"D2B_MIN_CONFIDENCE", number_text(options.detect.min_confidence)},
            {"D2B_MASK", options.detect.mask},
            {"D2B_NDVI", options.detect.ndvi},
            {"D2B_SPLIT_HEIGHT_M", number_text(options.detect.split_height)},
            {"D2B_LEVELS", name_of(options.levels.source)},
            {"D2B_DETAIL_M", number_text(options.levels.detail)},
            {"D2B_LOD", std::to_string(options.levels.lod)},
            {"D2B_REGULARIZE", name_of(options.outline.walls)}};
}

}  // namespace

Provenance make_provenance(const Options& options, const DemInfo& info, const Crs& crs, const Crs& target,
                           const RunReport& report) {
    Provenance provenance;
    provenance.crs_wkt = target.kind() == Crs::Kind::none ? crs.wkt() : target.wkt();
    // Elevations in two units, or stacked contours among disjoint ones, would make nonsense of a layer.
    provenance.binding = {"D2B_VERTICAL_UNIT", "D2B_CONTOURS"};
    provenance.metadata = {
        {"D2B_VERSION", std::string(version)},
        {"D2B_SOURCE", info.name},
        {"D2B_PRESET", options.preset},
        {"D2B_TRACE", options.trace.mode == TraceMode::points ? "points" : "cells"},
        {"D2B_NOISE_FACTOR", std::to_string(options.filter.noise_factor)},
        {"D2B_MIN_AREA_M2", number_text(detects_buildings(options) ? options.detect.min_area_m2
                                                                   : options.filter.min_area_m2.value_or(0))},
        {"D2B_SIMPLIFY", number_text(options.outline.simplify)},
        {"D2B_CONTOURS", options.outline.disjoint ? "disjoint" : "stacked"},
        {"D2B_THRESHOLDS", thresholds_of(report)},
        {"D2B_MINIMUM", number_text(report.minimum)},
        {"D2B_MAXIMUM", number_text(report.maximum)},
        {"D2B_VERTICAL_UNIT", report.units.vertical},
        {"D2B_VERTICAL_UNIT_FROM", report.units.vertical_decided_by},
        {"D2B_HORIZONTAL_UNIT", report.units.horizontal},
        {"D2B_HORIZONTAL_UNIT_FROM", report.units.horizontal_decided_by},
        {"D2B_AREAS", report.units.areas},
    };
    if (detects_buildings(options))
        provenance.metadata.merge(detection_metadata(options));
    return provenance;
}

}  // namespace d2b
