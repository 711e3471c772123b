#pragma once

#include <array>
#include <span>
#include <string_view>

namespace d2b {

enum class Match {
    any,    ///< any value
    equal,  ///< this value
    other,  ///< any value except this one
    names   ///< a value that names this: "lod" in "lod=1..6,nf=5"
};

/// Condition on a given option. Values are texts as returned by OptionRow::show.
struct OptionUse {
    std::string_view name{};  ///< without dash
    Match match = Match::any;
    std::string_view value{};
};

enum class RuleKind {
    exclude,   ///< both cannot hold
    no_effect  ///< the first changes nothing if the second holds
};

/// Two uses of options that are refused together.
struct OptionRule {
    RuleKind kind = RuleKind::exclude;
    OptionUse one{};
    OptionUse other{};
    std::string_view advice{};  ///< ends the sentence
    OptionUse unless{};  ///< exception: with this third use the two make sense; ignored if it has no name
};

/// Option that is meaningless without another.
struct OptionNeed {
    std::string_view name{};
    std::string_view needed{};
    std::string_view advice{};                  ///< ends the sentence
    std::array<std::string_view, 3> or_else{};  ///< alternatives to `needed`
};

/// Rules in the order of checking.
[[nodiscard]] std::span<const OptionRule> option_rules();
[[nodiscard]] std::span<const OptionNeed> option_needs();

}  // namespace d2b
