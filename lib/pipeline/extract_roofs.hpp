#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "contours/merge_regions.hpp"
#include "core/context.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/run_setup.hpp"
#include "features/stored_roofs.hpp"
#include "outline/outline.hpp"
#include "pipeline/find_buildings.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::pipeline {

/// True if walls are so blurred that no face gets a slope. @pre the report has the sampling of the whole run
[[nodiscard]] bool roofs_are_level(const RunReport& report);
[[nodiscard]] roofs::RoofParameters roof_parameters(const features::RunSetup& setup, const RunReport& report);
/// Returns the attributes of a building as a whole. @param metres per vertical unit
[[nodiscard]] RoofRecord roof_record(const roofs::Roof& roof, double metres);

/// Extracts roofs from the cells of buildings.
class RoofExtractor {
  public:
    /// @param buildings labels above have no roofs @param contours, outliner, context must outlive this
    RoofExtractor(const contours::ContourList& contours, const outline::Outliner& outliner, Label buildings,
                  const features::RunSetup& setup, Context& context);

    /// Extracts the roofs of the footprints of a label. Thread-safe for different labels.
    /// @param cells all of its cells @throws OutputError, Cancelled
    void extract(Label label, const contours::BuildingCells& cells);
    /// Moves out the roofs.
    [[nodiscard]] features::StoredRoofs take() { return std::move(roofs_); }

  private:
    const outline::Outliner& outliner_;
    Context& context_;
    roofs::RoofParameters parameters_;
    std::vector<std::vector<std::size_t>> footprints_;  ///< contours of level 1 by label
    features::StoredRoofs roofs_;
};

/// Extracts the roofs of all buildings, in one pass over the elevations. Memory holds the buildings that the
/// pass has begun but not finished. @throws InputError, OutputError, Cancelled
[[nodiscard]] features::StoredRoofs extract_roofs(ElevationReader& reader, const FoundBuildings& found,
                                                  const contours::ContourList& contours,
                                                  const outline::Outliner& outliner,
                                                  const features::RunSetup& setup, Context& context);

}  // namespace d2b::pipeline
