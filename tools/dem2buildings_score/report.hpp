#pragma once

#include <string>
#include <vector>

#include "dem2buildings/score.hpp"

namespace d2b {

/// A figure a line. @param quiet leaves out the compared files and the numbers behind the figures
[[nodiscard]] std::string score_text(const ScoreRequest& request, const ScoreRun& run, bool quiet);

/// A JSON object with a line feed at its end; keys always in the same order, null for unknown values.
[[nodiscard]] std::string score_json(const ScoreRequest& request, const ScoreRun& run,
                                     const std::vector<std::string>& warnings);

/// The same of planes of roofs.
[[nodiscard]] std::string roof_score_text(const ScoreRequest& request, const RoofScoreRun& run, bool quiet);
[[nodiscard]] std::string roof_score_json(const ScoreRequest& request, const RoofScoreRun& run,
                                          const std::vector<std::string>& warnings);

}  // namespace d2b
