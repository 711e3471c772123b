#pragma once

#include <string>
#include <utility>
#include <vector>

#include "options/option_table.hpp"

namespace d2b {

/// Options by the names of the table, each with its values as texts.
using GivenOptions = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// What the options stand for, checked by the table and its rules. @throws OptionError
[[nodiscard]] Request request_of(const GivenOptions& given);

}  // namespace d2b
