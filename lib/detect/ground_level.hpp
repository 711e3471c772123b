#pragma once

#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"

namespace d2b {

/// The ground of each label in metres: the tenth percentile of the terrain in the cells along the label's
/// border, inside and out. A building on a slope stands on its lower side, and one pit does not pull it down.
/// @return by label; [0] is not used
[[nodiscard]] std::vector<double> ground_levels(const MetreGrid& terrain, const Grid<Label>& labels,
                                                Label count, Executor& threads);

}  // namespace d2b
