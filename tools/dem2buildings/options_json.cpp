#include <cmath>

#include <nlohmann/json.hpp>

#include "core/version.hpp"
#include "dem2buildings/help.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const OptionRow& row) {
    Json option{
        {"name", row.name},           {"group", option_group_names[static_cast<std::size_t>(row.group)]},
        {"kind", option_kind(row)},   {"values", row.values},
        {"words", option_words(row)}, {"unit", row.unit},
        {"default", row.standard},    {"repeatable", row.repeatable},
        {"hidden", row.hidden},       {"help", row.help},
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
    Json options = Json::array();
    for (const OptionRow& row : option_table())
        options.push_back(json_of(row));
    return Json{{"version", version}, {"options", options}}.dump(indent) + "\n";
}

}  // namespace d2b
