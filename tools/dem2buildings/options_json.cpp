#include <cmath>

#include <nlohmann/json.hpp>

#include "dem2buildings/help.hpp"
#include "dem2buildings/version.hpp"
#include "options/run_plan.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

Json presets_of(const OptionRow& row) {
    Json presets = Json::array();
    for (const Preset preset : every_preset)
        if (row.has_meaning(preset))
            presets.push_back(preset_name(preset));
    return presets;
}

Json python_of(const OptionRow& row) {
    return {{"name", row.python.name},
            {"extract", row.python.extract},
            {"extract_file", row.python.extract_file}};
}

/// Returns the request in which all options that were left open have their values of the default preset.
Request usual_request() {
    return {make_run_plan({}, Layers::both).resolved(), {}};
}

Json json_of(const OptionRow& row, const Request& usual) {
    Json option{{"name", row.name},
                {"aliases", row.aliases},
                {"group", option_group_names[static_cast<std::size_t>(row.group)]},
                {"kind", option_kind_names[static_cast<std::size_t>(row.kind)]},
                {"values", row.values},
                {"choices", row.choices},
                {"choice_titles", row.choice_titles.empty() ? row.choices : row.choice_titles},
                {"unit", row.unit},
                {"default", row.standard},
                {"usual", row.arity == Arity::none ? "" : row.show(usual)},
                {"repeatable", row.repeatable},
                {"hidden", row.hidden},
                {"presets", presets_of(row)},
                {"python", python_of(row)},
                {"title", row.title},
                {"section", dialog_section_names[static_cast<std::size_t>(row.section)]},
                {"help", row.help},
                {"details", row.details}};
    if (row.numbers && std::isfinite(row.numbers->lowest))
        option["lowest"] = row.numbers->lowest;
    if (row.numbers && std::isfinite(row.numbers->highest))
        option["highest"] = row.numbers->highest;
    return option;
}

}  // namespace

std::string options_json() {
    constexpr int indent = 1;
    const Request usual = usual_request();
    Json options = Json::array();
    for (const OptionRow& row : option_table())
        options.push_back(json_of(row, usual));
    return Json{{"version", version}, {"options", options}}.dump(indent) + "\n";
}

}  // namespace d2b
