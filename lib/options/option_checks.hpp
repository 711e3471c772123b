#pragma once

#include <span>
#include <string>
#include <string_view>

#include "options/option_table.hpp"

namespace d2b {

/// Refuses what has no meaning in the preset, and what option_rules() and option_needs() forbid. Of an option
/// counts whether it was given: OptionRow::is_given.
/// @throws OptionError: an option without a meaning in the preset, two that exclude each other, one that has
/// no effect beside another, one without the other that it needs, or intervals that cannot be counted
void check_options(const Request& request);

/// Whether the value of an option changes anything beside those of the others.
[[nodiscard]] bool has_effect(const OptionRow& row, const Request& request);

/// The candidate that a mistyped name most likely stands for; "" where none is near.
/// Letter case does not count; a beginning of at least three letters is near.
[[nodiscard]] std::string nearest_name(std::string_view typed, std::span<const std::string> candidates);

}  // namespace d2b
