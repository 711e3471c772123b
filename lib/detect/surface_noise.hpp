#pragma once

#include "detect/scene.hpp"

namespace d2b {

/// Estimates the standard deviation of the surface's noise in m from open ground, because nothing else bends
/// the surface there from cell to cell. Uses the second differences along rows of cells that are not
/// elevated: the mean between their quantiles 0.1 and 0.2, because gardens and cars bend more than that.
/// Returns 0 if there is hardly any open ground, or if values are repeated or rounded. Integer sums, so the
/// order does not matter.
[[nodiscard]] double surface_noise(const MetreGrid& surface, const Mask& elevated, Executor& threads);

}  // namespace d2b
