#pragma once

#include <span>

#include "core/context.hpp"
#include "dem2buildings/surfaces.hpp"
#include "features/surface_cluster.hpp"

namespace d2b::features {

/// Metadata of the surfaces. Fields are those of the buildings layer.
[[nodiscard]] SurfaceMeta surface_meta(const RunPlan& plan, const SurfaceLattice& lattice, const Crs& written,
                                       const UnitReport& units);

/// Makes the surfaces of all groups in parallel and passes them to the sinks in the order of groups, each in
/// its form. Updates the report. Does not finish the sinks.
/// @param input its features are already written @throws Error
void write_surfaces(const SurfaceInput& input, SurfaceMeta meta, std::span<SurfaceSink* const> sinks,
                    Context& context);

}  // namespace d2b::features
