#pragma once

#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"
#include "read/polygon_layer.hpp"

namespace d2b {

/// Which layers and fields of heights the request asks for.
[[nodiscard]] LayerChoice found_choice(const ScoreRequest& request);
[[nodiscard]] LayerChoice reference_choice(const ScoreRequest& request);

/// Brings both sides to one CRS and measures. Warns where a side is empty.
/// @throws InputError: the area of interest or the raster cannot be read, or the sides do not meet
[[nodiscard]] ScoreRun compare_layers(const ScoreRequest& request, const PolygonLayer& found,
                                      const PolygonLayer& reference, Warnings& warnings);

}  // namespace d2b
