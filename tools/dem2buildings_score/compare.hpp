#pragma once

#include <string>

#include "core/context.hpp"
#include "dem2buildings_score/command_line.hpp"
#include "score/score.hpp"

namespace d2b {

/// What was compared with what, and the result.
struct ScoreRun {
    std::string found_layer;
    std::string reference_layer;
    std::string reference_height_field;  ///< "" for none
    std::string crs;                     ///< in which it was measured; "" for none
    double metres = 1;                   ///< in one unit of it
    bool limited = false;                ///< by an area of interest or a raster
    Score score;
};

/// Reads both sides, brings them to one CRS and measures. Warns where a side is empty.
/// @throws InputError: cannot be read, or the sides do not meet. @throws OptionError: no such layer or field
[[nodiscard]] ScoreRun compare_datasets(const ScoreRequest& request, Context& context);

}  // namespace d2b
