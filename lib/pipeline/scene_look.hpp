#pragma once

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "core/row_bands.hpp"
#include "detect/scene.hpp"
#include "diagnose/ground_fit.hpp"

namespace d2b {

/// Adds how a surface lies above a ground in some of its rows.
void add_fit(const MetreGrid& surface, const MetreGrid& ground, RowBand rows, GroundFit& fit,
             Executor& threads);

/// Whether there is a cell in these rows where the surface is known and the mask is not 0, or the values are
/// known. Looks no farther than the first.
[[nodiscard]] bool meets(const MetreGrid& surface, const Mask& mask, RowBand rows);
[[nodiscard]] bool meets(const MetreGrid& surface, const MetreGrid& values, RowBand rows);

}  // namespace d2b
