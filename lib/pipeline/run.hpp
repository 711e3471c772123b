#pragma once

#include "dem2buildings/run.hpp"
#include "detect/units.hpp"

namespace d2b::pipeline {

/// Same as run(), but with units of another size. The size affects the result.
RunReport run_in_units(const Options& options, const Sources& sources, const Sinks& sinks,
                       const Callbacks& callbacks, const detect::UnitSize& units, const BandSize& bands = {});

}  // namespace d2b::pipeline
