#pragma once

#include "contours/level_plan.hpp"
#include "core/context.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/run.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/run_setup.hpp"
#include "pipeline/given_footprints.hpp"

namespace d2b::pipeline {

/// Survey of the elevations of a run.
struct ElevationFrame {
    FixedPoint fixed;
    ElevationRange range;
    const contours::LevelPlan& global;  ///< levels of the whole DEM
};

/// Measures the cells of given footprints, traces the contours in them, and writes both to the layers of the
/// setup, which have begun. Contours are cut off at the footprints.
/// @param given measured by the units; its labels are used up
/// @throws InputError, OutputError, Cancelled
void write_footprints(GivenFootprints&& given, ElevationReader& reader, const ElevationFrame& frame,
                      const features::RunSetup& setup, FeatureSink& sink, Context& context);

}  // namespace d2b::pipeline
