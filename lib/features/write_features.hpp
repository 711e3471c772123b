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

/// Input for drawing and writing the features of a run.
struct FeatureInput {
    const RunPlan& plan;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the CRS of the DEM
    const StoredContours& contours;
    const Outliner& outliner;
    const LayerSpecs& layers;  ///< without styles
    Provenance provenance;
    Window window;
    Label buildings;     ///< labels above are low-confidence candidates
    double cell_size_m;  ///< side of a square with the area of a cell
    FixedPoint fixed;
    /// Measures the stack error, which reads the elevations again.
    std::function<StackError(const DrawnStack&)> compare;
    ParcelSource* parcels = nullptr;  ///< gives the names of parcels
    BuildingRecords* kept = nullptr;  ///< receives the records of all buildings, even of those not written
    /// Same for stacks truncated at level 1, 2, ...; empty if not asked for.
    std::function<std::vector<StackError>(const DrawnStack&, std::int32_t levels)> compare_cuts = {};

    [[nodiscard]] bool is_doubtful(std::size_t contour) const {
        return contours.head(contour).label > buildings;
    }
};

/// Draws, reprojects, validates and measures every outline and writes it with its attributes, in the order of
/// contours. Updates the report. Does not finish the sink.
/// @param records of the same contours @throws Error
void write_features(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink,
                    Context& context);

}  // namespace d2b
