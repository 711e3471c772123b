#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// The standard deviation of the surface's noise in metres, from open ground, where nothing else bends the
/// surface from cell to cell: of the second differences along rows between cells that are not elevated, the
/// mean of those between the smallest tenth and the smallest fifth. Gardens and cars bend more than that. 0
/// where there is next to no open ground, and where values are repeated or rounded. A sum over all cells in
/// whole numbers: their order does not matter.
[[nodiscard]] double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads);

}  // namespace d2b
