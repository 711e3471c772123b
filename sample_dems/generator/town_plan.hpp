#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plane.hpp"
#include "scene.hpp"

namespace d2b::sample {

enum class Quarter { old_town, row_houses, villas, slabs, works, park };

/// A town of quarters between avenues: a lattice with moved corners. Any quarter can be made alone, so that
/// towns of any size can be rendered strip by strip.
struct TownPlan {
    std::uint64_t seed = 0;
    std::int32_t cols = 3;
    std::int32_t rows = 3;
    double pitch = 1000.0 / 3;      ///< metres from avenue to avenue
    double jitter = 48;             ///< how far a crossing may be moved; those on the town's rim stay on it
    std::vector<Quarter> quarters;  ///< row by row from the south; drawn from the seed where empty

    [[nodiscard]] Quarter quarter(std::int32_t col, std::int32_t row) const;
    /// Counter-clockwise from the lower left.
    [[nodiscard]] std::array<Position, 4> corners(std::int32_t col, std::int32_t row) const;
};

/// Adds the buildings and trees of a quarter to a scene, on the scene's ground.
void build_quarter(const TownPlan& plan, std::int32_t col, std::int32_t row, Scene& scene);
/// Adds all quarters that may reach into y0 <= y <= y1: all that the rows of a raster between them need.
/// Towns that are too large for memory are rendered this way, a strip at a time.
void build_strip(const TownPlan& plan, double y0, double y1, Scene& scene);

}  // namespace d2b::sample
