#include "options/option_checks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_rules.hpp"
#include "options/sweep_plan.hpp"

namespace d2b {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return result;
}

/// Returns the Damerau-Levenshtein distance (optimal string alignment).
std::size_t edit_distance(std::string_view one, std::string_view other) {
    std::vector<std::vector<std::size_t>> cost(one.size() + 1, std::vector<std::size_t>(other.size() + 1));
    for (std::size_t i = 0; i <= one.size(); ++i) {
        for (std::size_t j = 0; j <= other.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = cost[i - 1][j - 1] + (one[i - 1] == other[j - 1] ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost.back().back();
}

/// Returns true if an option set to `value` matches the use.
bool is_so(const OptionUse& use, const std::string& value) {
    switch (use.match) {
        case Match::any:
            break;
        case Match::equal:
            return value == use.value;
        case Match::other:
            return value != use.value;
        case Match::names:
            return value.find(std::string(use.value) + "=") != std::string::npos;
    }
    return true;
}

/// Formats the use as on a command line.
std::string written(const OptionUse& use, const Request& request) {
    std::string option = "-" + std::string(use.name);
    switch (use.match) {
        case Match::any:
            break;
        case Match::equal:
        case Match::other:
            return option + " " + find_option(use.name)->show(request);
        case Match::names:
            return option + " " + std::string(use.value) + "=...";
    }
    return option;
}

bool holds(const OptionUse& use, const Request& request) {
    const OptionRow& row = *find_option(use.name);
    return row.is_given(request) && is_so(use, row.show(request));
}

bool is_broken(const OptionRule& rule, const Request& request) {
    return holds(rule.one, request) && holds(rule.other, request) &&
           (rule.unless.name.empty() || !holds(rule.unless, request));
}

void check_rule(const OptionRule& rule, const Request& request) {
    if (!is_broken(rule, request))
        return;
    throw OptionError(
        written(rule.one, request) +
        (rule.kind == RuleKind::exclude ? " cannot be used together with " : " has no effect with ") +
        written(rule.other, request) + "; " + std::string(rule.advice) + ".");
}

/// Returns "-surface <file>, -flow_ready <m> or -min_gap <m>".
std::string choices_of(const OptionNeed& need) {
    std::string text = option_synopsis(*find_option(need.needed));
    for (std::size_t i = 0; i < need.or_else.size() && !need.or_else[i].empty(); ++i) {
        const bool is_last = i + 1 == need.or_else.size() || need.or_else[i + 1].empty();
        text += (is_last ? " or " : ", ") + option_synopsis(*find_option(need.or_else[i]));
    }
    return text;
}

void check_need(const OptionNeed& need, const Request& request) {
    const OptionRow& needed = *find_option(need.needed);
    const bool has_another = std::ranges::any_of(need.or_else, [&](std::string_view other) {
        return !other.empty() && find_option(other)->is_given(request);
    });
    if (find_option(need.name)->is_given(request) && !needed.is_given(request) && !has_another)
        throw OptionError("-" + std::string(need.name) + " needs " + choices_of(need) + "; " +
                          std::string(need.advice) + ".");
}

void check_preset(const Request& request) {
    const Preset preset = request.options.preset;
    for (const OptionRow& row : option_table()) {
        if (row.has_meaning(preset) || !row.is_given(request))
            continue;
        const std::string value = row.show(request);
        const bool any = row.scope.elsewhere.empty();
        if (any || value != row.scope.elsewhere)
            throw OptionError("-" + row.name + (any ? "" : " " + value) + " has no effect with -preset " +
                              std::string(preset_name(preset)) + "; " + row.scope.why + ".");
    }
}

/// Rejects offsets that are too many intervals away, because thresholds would be off by a thousandth of an
/// interval and more, or coincide.
void check_offset(const LevelOptions& levels) {
    constexpr double most_intervals = 0x1p43;
    if (levels.interval && !(std::abs(levels.offset) <= most_intervals * *levels.interval))
        throw OptionError("-off " + number_text(levels.offset) + " is too far away to count intervals of " +
                          number_text(*levels.interval) + " from; give a base near the elevations.");
}

/// Requires an OBJ or STL, because -surface_solids has no effect on CityJSON and glTF.
void check_solids(const Request& request) {
    const auto is_parted = [](const std::string& name) {
        const std::string small = lower(name);
        return small.ends_with(".obj") || small.ends_with(".stl");
    };
    const std::vector<std::string>& files = request.options.write.surfaces;
    if (find_option("surface_solids")->is_given(request) && std::ranges::none_of(files, is_parted))
        throw OptionError(
            "-surface_solids has no effect without an OBJ or STL; give a -surface whose name "
            "ends in .obj or .stl.");
}

}  // namespace

void check_options(const Request& request) {
    for (const OptionRule& rule : option_rules())
        check_rule(rule, request);
    check_preset(request);
    for (const OptionNeed& need : option_needs())
        check_need(need, request);
    check_offset(request.options.levels);
    check_solids(request);
    if (!request.tool.sweep.empty() && !request.options.write.preview.empty())
        require_legible(request.tool.sweep_plan.trials(), request.options.write.preview_size);
}

bool has_effect(const OptionRow& row, const Request& request) {
    Request given = request;
    given.options.given.insert(row.name);
    return row.has_meaning(request.options.preset) &&
           std::ranges::none_of(option_rules(), [&](const OptionRule& rule) {
               return rule.one.name == row.name && is_broken(rule, given);
           });
}

std::string nearest_name(std::string_view typed, std::span<const std::string> candidates) {
    const std::string wanted = lower(typed);
    // Allows a third of the letters to be wrong, so that short names do not match arbitrary ones.
    std::size_t best = wanted.size() / 3 + 1;
    std::string nearest;
    for (const std::string& candidate : candidates) {
        const std::string name = lower(candidate);
        const bool begins = wanted.size() >= 3 && name.starts_with(wanted);
        const std::size_t distance = std::min(edit_distance(wanted, name), begins ? std::size_t{1} : best);
        if (distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace d2b
