#pragma once

#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// How the surface bends at a cell, as bits: second differences against thresholds that grow with the size of
/// the cells, since a roof's own relief and the error of gridding do, and with noise beyond what those cover.
enum Smooth : std::uint8_t {
    smooth_along_row =
        1,  ///< hardly any bend along the row: a roof's plane, or one with its fall line across
    smooth_along_column = 2,  ///< the same along the column
    smooth_any_way = 4,       ///< along the row, the column or a diagonal: planes of any direction, edges too
    smooth_enough = 8,        ///< along row or column, with a threshold that suits whole objects
};

/// One byte a cell. Halo: one row and column; the border continues outwards. A cell that is not valid is
/// smooth in no direction, its neighbours in none that meets it.
/// @param side of the cells, metres @param noise standard deviation of the surface's noise, metres
[[nodiscard]] Grid<std::uint8_t> smoothness(const MetreGrid& surface, double side, double noise,
                                            Executor& threads);

}  // namespace d2b
