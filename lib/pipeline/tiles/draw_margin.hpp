#pragma once

#include "core/lattice.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Returns the rows and columns around a building's cells within which its outline lies or another building
/// affects it.
[[nodiscard]] LatticePoint draw_reach(const RunSetup& setup, Context& context);
/// Returns draw_reach() plus the border that is needed to filter elevations.
[[nodiscard]] LatticePoint draw_margin(const RunSetup& setup, Context& context);

}  // namespace d2b
