#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/spool.hpp"
#include "features/drawn_stack.hpp"
#include "features/record_builder.hpp"
#include "geometry/geos.hpp"
#include "options/run_plan.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// Records of buildings with final outlines, kept in a spool.
class BuildingRecords {
  public:
    explicit BuildingRecords(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// @param building index of the building, as in ContourHead
    void put(std::int64_t building, const BuildingRecord& record);
    /// Thread-safe once all are added. @return nullopt if the building has no outline
    [[nodiscard]] std::optional<BuildingRecord> of(std::int64_t building) const;

  private:
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> entries_;  ///< by building; empty for a building without outline
};

/// Index of each layer in the list of layers; nullopt if it is not written.
struct LayerIndices {
    std::optional<std::size_t> buildings;
    std::optional<std::size_t> contours;
    std::optional<std::size_t> doubtful;
    std::optional<std::size_t> rejected;
    std::optional<std::size_t> problems;

    [[nodiscard]] std::optional<std::size_t> building_layer(bool is_low_confidence) const {
        return is_low_confidence ? doubtful : buildings;
    }
};

/// Layers of a run in the order of writing, without styles.
struct LayerSpecs {
    std::vector<LayerSpec> layers;
    LayerIndices indices;
};

/// @param source name of the DEM @param vertical_unit its name
/// @param sink gives the names of the layers in the destination
[[nodiscard]] LayerSpecs layer_specs(const RunPlan& plan, const std::string& source,
                                     const std::string& vertical_unit, const FeatureSink& sink);

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
    std::function<StackError(const DrawnStack&)> stack_error;
    ParcelSource* parcels = nullptr;  ///< gives the names of parcels
    BuildingRecords* building_records =
        nullptr;  ///< receives the records of all buildings, even of those not written
    /// Same for stacks truncated at level 1, 2, ...; empty if not asked for.
    std::function<std::vector<StackError>(const DrawnStack&, std::int32_t levels)> stack_errors_by_level = {};

    [[nodiscard]] bool is_low_confidence(std::size_t contour) const {
        return contours.head(contour).label > buildings;
    }
};

/// Draws, reprojects, validates and measures every outline and writes it with its attributes, in the order of
/// contours. Updates the report. Does not finish the sink.
/// @param records of the same contours @throws Error
void write_features(const FeatureInput& input, const RecordBuilder& records, FeatureSink& sink,
                    Context& context);

/// Styles of buildings and contours without the placement of 3D blocks. @param disjoint true if contours are
/// bands
[[nodiscard]] LayerStyle building_style(FieldNames names);
[[nodiscard]] LayerStyle contour_style(bool disjoint);

/// Sets the default styles of the input's layers: the same height classes in metres for all, contours ordered
/// from low to high, and in 3D the stack, or blocks of buildings if no contours are written.
/// @param vertical_metres metres per vertical unit of the DEM
void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres);

}  // namespace d2b
