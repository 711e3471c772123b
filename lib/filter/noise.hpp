#pragma once

#include <functional>

#include "core/context.hpp"
#include "core/options.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// Square metres of a unit square at a place; constant on a projected grid.
using SquareArea = std::function<double(LatticePoint)>;

/// What is left of a stack; empty where its lowest contour is noise.
struct FilteredStack {
    Stack stack;
    PointStats fallen;  ///< points that no contour of the stack holds any more
};

/// Drops noise from the low level to the high: a contour whose exterior ring passes fewer grid points than
/// the noise factor (Chittineni 2003, 4.2), or that is smaller than the smallest area as traced, is dropped
/// with all above it; a root never is, and a
/// footprint that was found by other means is not. The points of what is dropped go to the contour below.
/// Counted in the report.
[[nodiscard]] FilteredStack drop_noise(Stack&& stack, const FilterOptions& options,
                                       const SquareArea& square_area, Context& context);

/// Fills holes that are noise, from the low level to the high: one whose ring passes fewer grid points than
/// the noise factor, or that is smaller than the smallest area, where no contour stands in it and no hole of
/// the level below that remains lies in it. So contours stay nested and siblings disjoint. Counted in the
/// report.
/// @param contours all that are kept, sorted by key
void fill_holes(std::vector<Contour>& contours, const FilterOptions& options, const SquareArea& square_area,
                Context& context);

}  // namespace d2b
