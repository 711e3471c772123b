#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/band.hpp"

namespace d2b {

/// Adapts collapsed contouring (-trace points) to the tracer of cells: a unit square between four grid points
/// belongs to the levels that all four have, so its count is the smallest count of its corners. Above level 0
/// all four must have the same label. Halo: one row below and one column to the right.
/// @param upper, lower counts of two adjacent rows of points @param squares output, one element fewer
template <typename Count>
void squares_between(std::span<const Count> upper, std::span<const Count> lower,
                     std::span<const Label> upper_labels, std::span<const Label> lower_labels,
                     std::vector<Count>& squares) {
    squares.resize(upper.size() - 1);
    for (std::size_t c = 0; c < squares.size(); ++c)
        squares[c] = std::min(std::min(upper[c], upper[c + 1]), std::min(lower[c], lower[c + 1]));
    if (upper_labels.empty())
        return;
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const Label label = upper_labels[c];
        if (label != upper_labels[c + 1] || label != lower_labels[c] || label != lower_labels[c + 1])
            squares[c] = std::min(squares[c], Count{1});
    }
}

}  // namespace d2b
