#pragma once

#include <span>

#include "core/context.hpp"
#include "dem2buildings/surfaces.hpp"
#include "features/surface_cluster.hpp"

namespace d2b {

/// What surfaces say of themselves. Fields are those of the layer of buildings.
[[nodiscard]] SurfaceMeta surface_meta(const RunPlan& plan, const SurfaceLattice& lattice, const Crs& written,
                                       const UnitReport& units);

/// Makes the surfaces of all groups of contours, on all threads, and hands them to the sinks in the order of
/// the groups, each in the form that it holds. What was found is added to the report. The sinks are not
/// finished. @param input the features are written @throws Error
void write_surfaces(const SurfaceInput& input, SurfaceMeta meta, std::span<SurfaceSink* const> sinks,
                    Context& context);

}  // namespace d2b
