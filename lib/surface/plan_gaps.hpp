#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "core/grid.hpp"
#include "core/lattice.hpp"

namespace d2b {

/// Minimum distance on the lattice: points are separated if one is outside the box of this size around the
/// other.
struct LatticeGap {
    std::int64_t rows = 1;
    std::int64_t cols = 1;

    [[nodiscard]] bool parts(FinePoint a, FinePoint b) const {
        return std::abs(a.row - b.row) >= rows || std::abs(a.col - b.col) >= cols;
    }
    friend bool operator==(const LatticeGap&, const LatticeGap&) = default;
};

/// Returns the larger value of each side.
[[nodiscard]] inline LatticeGap largest_of(const LatticeGap& a, const LatticeGap& b) {
    return {std::max(a.rows, b.rows), std::max(a.cols, b.cols)};
}

/// Returns the box outside of which all points are at least `metres` away on the ground, rounded up to whole
/// steps. @param metres above 0 @param cell a column and a row of FinePoint::steps, at any angle
[[nodiscard]] LatticeGap lattice_gap(double metres, const CellSize& cell);

/// Minimum distances between the corners of a surface. The defaults are for a lattice of unknown cell size.
struct PlanGaps {
    /// Distance between corners that touched. Ten times the millimetre within which programs that read solids
    /// merge vertices (the default of val3dity and others).
    static constexpr double pinch_m = 0.01;
    /// Corners closer than this are merged beforehand.
    static constexpr double corner_m = 0.002;

    LatticeGap pinch{2, 2};
    LatticeGap corners{1, 1};
    std::int64_t heights = 1;  ///< millimetres between roofs that meet and between a roof and its base

    /// Returns true if there is a solid between two heights.
    [[nodiscard]] bool stands_out(std::int64_t top, std::int64_t base) const { return top >= base + heights; }
};
[[nodiscard]] PlanGaps plan_gaps(const CellSize& cell);

}  // namespace d2b
