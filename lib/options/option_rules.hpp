#pragma once

#include <array>
#include <span>
#include <string_view>

namespace d2b {

enum class Match {
    any,    ///< whatever its value
    equal,  ///< with this value
    other,  ///< with any value but this one
    names   ///< with a value that names this: "lod" in "lod=1..6,nf=5"
};

/// An option as it was given. Values are texts as OptionRow::show gives them.
struct OptionUse {
    std::string_view name{};  ///< without dash
    Match match = Match::any;
    std::string_view value{};
};

enum class RuleKind {
    exclude,   ///< both cannot hold
    no_effect  ///< the first changes nothing beside the second
};

/// Two uses of options that are refused together.
struct OptionRule {
    RuleKind kind = RuleKind::exclude;
    OptionUse one{};
    OptionUse other{};
    std::string_view advice{};  ///< ends the sentence
    OptionUse unless{};         ///< a third that makes sense of the two; without a name there is none
};

/// An option that says more of another.
struct OptionNeed {
    std::string_view name{};
    std::string_view needed{};
    std::string_view advice{};                  ///< ends the sentence
    std::array<std::string_view, 3> or_else{};  ///< others that will do
};

/// In the order in which they are looked at.
[[nodiscard]] std::span<const OptionRule> option_rules();
[[nodiscard]] std::span<const OptionNeed> option_needs();

}  // namespace d2b
