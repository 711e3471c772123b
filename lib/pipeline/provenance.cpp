#include "pipeline/provenance.hpp"

#include <string>

#include "core/number_text.hpp"
#include "core/version.hpp"

namespace d2b {
namespace {

std::string thresholds_of(const RunReport& report) {
    std::string text;
    for (const LevelReport& level : report.levels)
        if (level.level > 0)
            text += (text.empty() ? "" : " ") + number_text(level.threshold);
    return text;
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
        {"D2B_MIN_AREA_M2", number_text(options.filter.min_area_m2)},
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
    return provenance;
}

}  // namespace d2b
