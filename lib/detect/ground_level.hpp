#pragma once

#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b::detect {

/// Ground elevation per label in m: the tenth percentile of the terrain in the cells along the label's
/// border, inside and outside. A building on a slope stands on its lower side, and a single pit does not pull
/// it down.
/// @return elevations by label; [0] is unused
[[nodiscard]] std::vector<double> ground_levels(const MetreGrid& terrain, const Grid<Label>& labels,
                                                Label count, Executor& threads);

}  // namespace d2b::detect
