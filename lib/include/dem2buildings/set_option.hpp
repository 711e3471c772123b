#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Sets an option by the name that it has on the command line; docs/options.md lists them.
/// @param name with or without dashes, or an alias @param values as texts; none for a switch
/// @throws OptionError: no such option, or values that it does not take. What contradicts another option is
/// found when a run begins
void set_option(Options& options, std::string_view name, const std::vector<std::string>& values = {});

}  // namespace d2b
