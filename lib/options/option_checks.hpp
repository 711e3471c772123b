#pragma once

#include <span>
#include <string>
#include <string_view>

#include "options/option_table.hpp"

namespace d2b {

/// Checks the options against the preset, option_rules() and option_needs(). Only options that were given
/// count, see OptionRow::is_given. @throws OptionError if an option has no meaning in the preset, excludes
/// another, has no effect with another or needs one that is missing, or if intervals cannot be counted
void check_options(const Request& request);

/// Returns true if the value of an option matters, given the other options.
[[nodiscard]] bool has_effect(const OptionRow& row, const Request& request);

/// Returns the candidate closest to a mistyped name; "" if none is close. Ignores case; a prefix of at least
/// three letters is close.
[[nodiscard]] std::string nearest_name(std::string_view typed, std::span<const std::string> candidates);

}  // namespace d2b
