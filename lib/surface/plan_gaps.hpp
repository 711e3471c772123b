#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "core/grid.hpp"
#include "core/lattice.hpp"

namespace d2b {

/// A distance on the lattice: points are apart where one lies outside of a box of so many steps around the
/// other.
struct LatticeGap {
    std::int64_t rows = 1;
    std::int64_t cols = 1;

    [[nodiscard]] bool parts(FinePoint a, FinePoint b) const {
        return std::abs(a.row - b.row) >= rows || std::abs(a.col - b.col) >= cols;
    }
    friend bool operator==(const LatticeGap&, const LatticeGap&) = default;
};

/// The larger one of each side.
[[nodiscard]] inline LatticeGap largest_of(const LatticeGap& a, const LatticeGap& b) {
    return {std::max(a.rows, b.rows), std::max(a.cols, b.cols)};
}

/// The box around which all points lie at least a length away on the ground, in whole steps rounded up.
/// @param metres above 0 @param cell a column and a row of FinePoint::steps, whatever the angle between them
[[nodiscard]] LatticeGap lattice_gap(double metres, const CellSize& cell);

/// How far corners of a surface lie from each other. The defaults are the fewest steps of a lattice of which
/// no size is known.
struct PlanGaps {
    /// Programs that read solids take corners within a millimetre for one (the default of val3dity, and of
    /// others), so that touching corners are parted by ten times as much.
    static constexpr double pinch_m = 0.01;
    /// Corners nearer than this are made one beforehand.
    static constexpr double corner_m = 0.002;

    LatticeGap pinch{2, 2};
    LatticeGap corners{1, 1};
    std::int64_t heights = 1;  ///< of roofs that meet, and of a roof above its base, in millimetres

    /// Whether there is a solid between two heights.
    [[nodiscard]] bool stands_out(std::int64_t top, std::int64_t base) const { return top >= base + heights; }
};
[[nodiscard]] PlanGaps plan_gaps(const CellSize& cell);

}  // namespace d2b
