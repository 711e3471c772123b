#pragma once

#include "core/lattice.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Rows and columns around a building's cells in which it is drawn, or another building has a say in how.
[[nodiscard]] LatticePoint draw_reach(const RunSetup& setup, Context& context);
/// With what must be known around these to say what is an elevation.
[[nodiscard]] LatticePoint draw_margin(const RunSetup& setup, Context& context);

}  // namespace d2b
