#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "options/option_table.hpp"

namespace d2b {

enum class Match {
    any,    ///< any value
    equal,  ///< this value
    other   ///< any value except this one
};

/// Condition on a given option. Values are texts as returned by OptionRow::show.
struct OptionCondition {
    std::string_view name{};  ///< without dash
    Match match = Match::any;
    std::string_view value{};

    /// True for an option with the name that is set to `set`.
    [[nodiscard]] constexpr bool matches(std::string_view set) const {
        return match == Match::any || (set == value) == (match == Match::equal);
    }
};

enum class RuleKind {
    exclude,   ///< both cannot hold
    no_effect  ///< the first changes nothing if the second holds
};

/// Two uses of options that are refused together.
struct OptionRule {
    RuleKind kind = RuleKind::exclude;
    OptionCondition one{};
    OptionCondition other{};
    std::string_view advice{};  ///< ends the sentence
    OptionCondition
        unless{};  ///< exception: with this third use the two make sense; ignored if it has no name
};

/// Option that is meaningless without one of others.
struct OptionDependency {
    std::string_view name{};
    std::array<std::string_view, 4> needed{};  ///< alternatives; "" for none
    std::string_view advice{};                 ///< ends the sentence
};

/// Rules in the order of checking.
[[nodiscard]] std::span<const OptionRule> option_rules();
[[nodiscard]] std::span<const OptionDependency> option_dependencies();

/// Checks the options against the preset, option_rules() and option_dependencies(). Only options that were
/// given count, see OptionRow::is_given. @throws OptionError if an option has no meaning in the preset,
/// excludes another, has no effect with another or needs one that is missing, or if intervals cannot be
/// counted
void check_options(const Request& request);

/// Returns true if the value of an option matters, given the other options.
[[nodiscard]] bool has_effect(const OptionRow& row, const Request& request);

/// Returns the candidate closest to a mistyped name; "" if none is close. Ignores case; a prefix of at least
/// three letters is close.
[[nodiscard]] std::string nearest_name(std::string_view typed, std::span<const std::string> candidates);

}  // namespace d2b
