#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "options/option_table.hpp"

namespace d2b {

/// Canonical names of options, without dash.
using OptionNames = std::set<std::string, std::less<>>;

/// Refuses what option_rules() and option_needs() forbid. @param given the options that were given
/// @param request what they were set to
/// @throws OptionError: two that exclude each other, one that has no effect beside another, or one without
/// the other that it needs
void check_conflicts(const OptionNames& given, const Request& request);

/// The candidate that a mistyped name most likely stands for; "" where none is near.
/// Letter case does not count; a beginning of at least three letters is near.
[[nodiscard]] std::string nearest_name(std::string_view typed, std::span<const std::string> candidates);

}  // namespace d2b
