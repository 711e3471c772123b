#pragma once

#include <vector>

#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Rows of a window that are looked at together. Rows count from the window's first.
struct Strip {
    RowBand own;   ///< what is said of these rows counts
    RowBand seen;  ///< and of these it is known that they are there
};

/// How many points are held at a time where ground and buildings are looked for.
struct StripSize {
    std::int64_t most_whole = std::int64_t{64} << 20;     ///< windows that are not divided
    std::int64_t most_in_strip = std::int64_t{48} << 20;  ///< with the rows around it, unless rows are long
};

/// Divides a window into strips of about the same height, which depend on its shape and on nothing else.
/// @param around metres on either side that a strip sees beside its own rows
[[nodiscard]] std::vector<Strip> strips_of(const Window& window, const CellSize& cell, double around,
                                           const StripSize& size = {});

}  // namespace d2b
