#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// @return nullopt if there are no errors
[[nodiscard]] std::optional<HeightErrors> height_errors(std::span<const double> errors);

/// Height per object: area-weighted mean of the heights of the features in it.
/// @param heights one per feature @param areas one per feature, valid
/// @return one per object; nullopt unless it contains an interior point of a feature with a height
[[nodiscard]] std::vector<std::optional<double>> object_heights(
    std::span<const std::optional<double>> heights, std::span<const Polygons> areas, const Polygons& objects,
    Overlay& overlay);

}  // namespace d2b
