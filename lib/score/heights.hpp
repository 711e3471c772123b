#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// @return nothing where there is no error
[[nodiscard]] std::optional<HeightErrors> height_errors(std::span<const double> errors);

/// The height of each object: the mean of the heights of the features in it, weighted by their areas.
/// @param heights one a feature @param areas one a feature, valid
/// @return one an object; nothing where no feature with a height has a point of its inside in it
[[nodiscard]] std::vector<std::optional<double>> object_heights(
    std::span<const std::optional<double>> heights, std::span<const Polygons> areas, const Polygons& objects,
    Overlay& overlay);

}  // namespace d2b
