#pragma once

#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings_score/command_line.hpp"
#include "read/polygon_layer.hpp"
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

/// Which layers and fields of heights the request asks for.
[[nodiscard]] LayerChoice found_choice(const ScoreRequest& request);
[[nodiscard]] LayerChoice reference_choice(const ScoreRequest& request);

/// Brings both sides to one CRS and measures. Warns where a side is empty.
/// @throws InputError: the area of interest or the raster cannot be read, or the sides do not meet
[[nodiscard]] ScoreRun compare_layers(const ScoreRequest& request, const PolygonLayer& found,
                                      const PolygonLayer& reference, Warnings& warnings);

/// The same of two datasets. @throws InputError: also where one cannot be read. @throws OptionError: no such
/// layer or field
[[nodiscard]] ScoreRun compare_datasets(const ScoreRequest& request, const Callbacks& callbacks = {});

}  // namespace d2b
