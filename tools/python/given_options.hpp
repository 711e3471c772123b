#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Options by the names of the table, each with its values as texts.
using GivenOptions = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Options with the given values, each checked by the table. @throws OptionError
[[nodiscard]] Options options_of(const GivenOptions& given);

}  // namespace d2b
