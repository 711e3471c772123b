#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/make_surfaces.hpp"

namespace d2b::surface {

/// A town on a grid of cells of 1024 steps, written row by row from the north: each letter is a building,
/// each digit a height above the ground in units of 10 steps, ' ' and '0' are ground.
struct LetterGrid {
    std::vector<std::string> rows;

    [[nodiscard]] char at(int row, int col) const {
        const bool in = row >= 0 && row < static_cast<int>(rows.size()) && col >= 0 &&
                        col < static_cast<int>(rows[static_cast<std::size_t>(row)].size());
        return in ? rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(col)] : ' ';
    }
};

/// A cluster of blocks: each letter that hangs together by its edges is a building.
/// @param heights by letter, `a` first; the last one holds for all others @param bases likewise
[[nodiscard]] SurfaceCluster blocks_of(const LetterGrid& grid, const std::vector<std::int64_t>& heights,
                                       const std::vector<std::int64_t>& bases = {0});

/// A cluster of stacks: cells of digits that hang together are a building, which has a contour for each
/// digit that its cells reach, 10 steps high each.
[[nodiscard]] SurfaceCluster stacks_of(const LetterGrid& grid);

/// GEOS's triangulation.
[[nodiscard]] std::vector<FineTriangle> with_geos(const FinePolygon& polygon);

/// Both forms, with GEOS's triangulation.
[[nodiscard]] MadeSurfaces surfaces_of(const SurfaceCluster& cluster, const GapTolerances& gaps = {});

}  // namespace d2b::surface
