#pragma once

#include <functional>

#include "attributes/records.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/building_records.hpp"
#include "features/drawn_stack.hpp"
#include "features/layer_specs.hpp"
#include "filter/contour_store.hpp"
#include "geometry/geos.hpp"
#include "options/run_plan.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// What the outlines of a run need on their way to the sink.
struct FeatureInput {
    const RunPlan& plan;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the DEM's
    const StoredContours& contours;
    const Outliner& outliner;
    const LayerSpecs& layers;  ///< without their styles
    Provenance provenance;
    Window window;
    Label buildings;     ///< labels above are doubtful
    double cell_size_m;  ///< side of a square of a cell's area
    FixedPoint fixed;
    /// Goes through the elevations once more.
    std::function<StackError(const DrawnStack&)> compare;
    ParcelSource* parcels = nullptr;  ///< says how they are called
    BuildingRecords* kept = nullptr;  ///< gets the records of all buildings, whether or not they are written
    /// The same of the stacks that end at level 1, 2, ...; empty where that is not asked for.
    std::function<std::vector<StackError>(const DrawnStack&, std::int32_t levels)> compare_cuts = {};

    [[nodiscard]] bool is_doubtful(std::size_t contour) const {
        return contours.head(contour).label > buildings;
    }
};

/// Draws every outline, places it, has it checked, measures it, and hands it to the sink with its attributes,
/// in the order of the contours. What was found is added to the report. The sink is not finished.
/// @param records of the same contours @throws Error
void write_features(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink,
                    Context& context);

}  // namespace d2b
