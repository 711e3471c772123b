#include "pipeline/provenance.hpp"

#include <cmath>
#include <string>

#include "core/number_text.hpp"
#include "core/utf8_text.hpp"
#include "dem2buildings/version.hpp"
#include "options/given_words.hpp"
#include "options/option_checks.hpp"
#include "options/option_table.hpp"

namespace d2b {
namespace {

std::string thresholds_of(const RunReport& report) {
    std::string text;
    for (const LevelReport& level : report.levels)
        if (level.level > 0 && std::isfinite(level.threshold))
            text += (text.empty() ? "" : " ") + number_text(level.threshold);
    return text;
}

/// Returns the decided values of the options that shape the result, by the names in their rows.
std::map<std::string, std::string> decisions(const RunPlan& plan) {
    const Request settled{plan.settled(), {}};
    std::map<std::string, std::string> items;
    for (const OptionRow& row : option_table())
        if (!row.item.empty() && has_effect(row, settled))
            items.emplace("D2B_" + row.item, row.show(settled));
    return items;
}

}  // namespace

Provenance make_provenance(const RunPlan& plan, const DemInfo& info, const Crs& crs, const Crs& target,
                           const RunReport& report) {
    Provenance provenance;
    provenance.crs_wkt = target.kind() == Crs::Kind::none ? crs.wkt() : target.wkt();
    // A layer must not mix vertical units, or stacked with disjoint contours, because its fields would lose
    // their meaning.
    provenance.binding = {"D2B_VERTICAL_UNIT", "D2B_CONTOURS"};
    provenance.metadata = {
        {"D2B_VERSION", std::string(version)},
        {"D2B_SOURCE", info.name},
        {"D2B_OPTIONS", given_words(plan.asked)},
        {"D2B_CONTOURS", plan.asked.outline.disjoint ? "disjoint" : "stacked"},
        {"D2B_THRESHOLDS", thresholds_of(report)},
        {"D2B_MINIMUM", number_text(report.minimum)},
        {"D2B_MAXIMUM", number_text(report.maximum)},
        {"D2B_VERTICAL_UNIT", report.units.vertical},
        {"D2B_VERTICAL_UNIT_FROM", report.units.vertical_decided_by},
        {"D2B_HORIZONTAL_UNIT", report.units.horizontal},
        {"D2B_HORIZONTAL_UNIT_FROM", report.units.horizontal_decided_by},
        {"D2B_AREAS", report.units.areas},
    };
    provenance.metadata.merge(decisions(plan));
    std::erase_if(provenance.metadata, [](const auto& item) { return item.second.empty(); });
    for (auto& [name, value] : provenance.metadata)
        value = utf8_text(value);
    return provenance;
}

}  // namespace d2b
