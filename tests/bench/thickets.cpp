#include "thickets.hpp"

#include <algorithm>
#include <cmath>

#include "cells.hpp"
#include "draft.hpp"
#include "ground.hpp"
#include "random.hpp"

namespace d2b::bench {

namespace {

/// Height above the ground; 0 where nothing grows.
double height_at(std::uint64_t seed, const Position& p) {
    constexpr double edge = 0.5;
    constexpr double twig = 0.75;  // metres
    const double density = sample::value_noise(seed, 40, p);
    if (density < edge - 0.05 || density + 0.1 * (sample::value_noise(seed + 1, 6, p) - 0.5) < edge)
        return 0;
    const double leaves = sample::uniform_at(seed + 2, std::llround(p.x / twig), std::llround(p.y / twig));
    const double crown = sample::value_noise(seed + 3, 8, p);
    const double twigs = sample::value_noise(seed + 4, 2.2, p);
    return (2 + 13 * crown) * (0.55 + 0.15 * leaves + 0.75 * twigs);
}

sample::Rect extent(const sample::Building& building) {
    sample::Rect all = building.parts.front().rect;
    for (const sample::RoofPart& part : building.parts)
        all = {std::min(all.x0, part.rect.x0), std::min(all.y0, part.rect.y0), std::max(all.x1, part.rect.x1),
               std::max(all.y1, part.rect.y1)};
    return all;
}

}  // namespace

void mark_built(const sample::Scene& scene, const sample::Grid& grid, std::int32_t first_row,
                std::int32_t rows, std::span<char> built) {
    constexpr double yard = 3;  // metres
    for (const sample::Building& building : scene.buildings) {
        const sample::Rect place = extent(building).grown(yard);
        const WorldPolygon corners = building.frame.to_scene(sample::rectangle(place));
        for_cells(sample::bounds(corners.exterior), grid, first_row, rows,
                  [&](std::size_t at, const Position& p) {
                      if (place.contains(building.frame.to_local(p)))
                          built[at] = 1;
                  });
    }
}

void plant_thickets(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
                    std::span<const char> built, std::span<double> metres) {
    std::size_t at = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        for (std::int32_t col = 0; col < grid.cols; ++col, ++at) {
            if (built[at] == 0)
                metres[at] += height_at(seed, grid.centre(row, col));
        }
    }
}

}  // namespace d2b::bench
