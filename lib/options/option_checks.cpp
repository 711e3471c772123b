#include "options/option_checks.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

#include "dem2buildings/error.hpp"
#include "options/option_rules.hpp"

namespace d2b {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return result;
}

/// Letters to insert, remove, replace or swap with their neighbour to get from one to the other.
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

/// Whether an option that is set to `value` is used in this way.
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

/// The use as it is written on a command line.
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

}  // namespace

void check_conflicts(const OptionNames& given, const Request& request) {
    const auto holds = [&](const OptionUse& use) {
        return given.contains(use.name) && is_so(use, find_option(use.name)->show(request));
    };
    for (const OptionRule& rule : option_rules())
        if (holds(rule.one) && holds(rule.other) && (rule.unless.name.empty() || !holds(rule.unless)))
            throw OptionError(
                written(rule.one, request) +
                (rule.kind == RuleKind::exclude ? " cannot be used together with " : " has no effect with ") +
                written(rule.other, request) + "; " + std::string(rule.advice) + ".");
    for (const OptionNeed& need : option_needs())
        if (given.contains(need.name) && !given.contains(need.needed))
            throw OptionError("-" + std::string(need.name) + " needs " +
                              option_synopsis(*find_option(need.needed)) + "; " + std::string(need.advice) +
                              ".");
}

std::string nearest_name(std::string_view typed, std::span<const std::string> candidates) {
    const std::string wanted = lower(typed);
    // A third of the letters may be wrong, so that short names are not taken for just any other.
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
