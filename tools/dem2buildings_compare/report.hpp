#pragma once

#include <string>

#include "dem2buildings/compare.hpp"

namespace d2b {

/// A line for each figure. @param quiet only the numbers of changes
[[nodiscard]] std::string comparison_text(const SurveyComparison& comparison, bool quiet);
/// The same as JSON.
[[nodiscard]] std::string comparison_json(const SurveyComparison& comparison);

}  // namespace d2b
