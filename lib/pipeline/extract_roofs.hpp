#pragma once

#include "contours/contour_archive.hpp"
#include "core/context.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/run_setup.hpp"
#include "features/stored_roofs.hpp"
#include "outline/outline.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b::pipeline {

/// Extracts the roofs of all buildings, in one pass over the elevations. Memory holds the buildings that the
/// pass has begun but not finished. @throws InputError, OutputError, Cancelled
[[nodiscard]] features::StoredRoofs extract_roofs(ElevationReader& reader, const FoundBuildings& found,
                                                  const contours::ContourList& contours,
                                                  const outline::Outliner& outliner,
                                                  const features::RunSetup& setup, Context& context);

/// True if walls are so blurred that no face gets a slope.
[[nodiscard]] bool roofs_are_level(const RunReport& report);
[[nodiscard]] roofs::RoofParameters roof_parameters(const features::RunSetup& setup, const RunReport& report);
/// Returns the attributes of a building as a whole. @param metres per vertical unit
[[nodiscard]] RoofRecord roof_record(const roofs::Roof& roof, double metres);

}  // namespace d2b::pipeline
