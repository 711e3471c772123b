#include "dem2buildings_compare/report.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "dem2buildings/version.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

std::string line(std::string_view name, const std::string& figure) {
    constexpr std::size_t width_of_names = 10;
    return std::string(name) + std::string(width_of_names - name.size(), ' ') + figure + "\n";
}

std::string counted(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string survey_text(const ComparedSurvey& survey) {
    std::string text = survey.dataset + (survey.layer.empty() ? "" : ", layer " + survey.layer) + ": " +
                       counted(survey.buildings, "building");
    if (survey.cell_m)
        text += ", cells of " + fixed_text(*survey.cell_m, 1) + " m";
    if (survey.outside > 0)
        text += ", " + std::to_string(survey.outside) + " of them outside the other survey";
    return text;
}

std::string shift_text(const SurveyShift& shift) {
    if (shift.pairs == 0)
        return "not estimated, because fewer than 3 buildings agree on one";
    return fixed_text(std::abs(shift.east_m), 2) + " m " + (shift.east_m < 0 ? "west" : "east") + ", " +
           fixed_text(std::abs(shift.north_m), 2) + " m " + (shift.north_m < 0 ? "south" : "north") +
           ", from " + std::to_string(shift.pairs) + " buildings";
}

Json json_of(const ComparedSurvey& survey) {
    return {{"dataset", survey.dataset},
            {"layer", survey.layer.empty() ? Json(nullptr) : Json(survey.layer)},
            {"buildings", survey.buildings},
            {"outside", survey.outside},
            {"cell_m", survey.cell_m ? Json(*survey.cell_m) : Json(nullptr)}};
}

}  // namespace

std::string comparison_text(const SurveyComparison& comparison, bool quiet) {
    std::string text;
    if (!quiet) {
        text += line("old", survey_text(comparison.old_survey));
        text += line("new", survey_text(comparison.new_survey));
        text += line("shift", shift_text(comparison.shift));
        if (!comparison.output.empty())
            text += line("changes", comparison.output);
        if (!comparison.page.empty())
            text += line("page", comparison.page);
        text += "\n";
    }
    for (std::size_t i = 0; i < change_names.size(); ++i)
        text += line(change_names[i], std::to_string(comparison.counts[i]));
    return text;
}

std::string comparison_json(const SurveyComparison& comparison) {
    Json changes;
    for (std::size_t i = 0; i < change_names.size(); ++i)
        changes[std::string(change_names[i])] = comparison.counts[i];
    const SurveyShift& shift = comparison.shift;
    const Json json{{"version", version},
                    {"old", json_of(comparison.old_survey)},
                    {"new", json_of(comparison.new_survey)},
                    {"crs", comparison.crs},
                    {"shift", {{"east_m", shift.east_m}, {"north_m", shift.north_m}, {"pairs", shift.pairs}}},
                    {"changes", changes},
                    {"output", comparison.output.empty() ? Json(nullptr) : Json(comparison.output)},
                    {"page", comparison.page.empty() ? Json(nullptr) : Json(comparison.page)},
                    {"warnings", comparison.warnings}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace d2b
