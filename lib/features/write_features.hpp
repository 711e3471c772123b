#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "contours/contour_archive.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/spool.hpp"
#include "features/drawn_stack.hpp"
#include "features/record_builder.hpp"
#include "features/run_setup.hpp"
#include "features/stored_roofs.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b::features {

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

/// Contours of a run with their outlines, and all data needed to draw and write their features.
struct FeatureInput {
    const RunSetup& setup;
    const contours::StoredContours& contours;
    const outline::Outliner& outliner;
    Label buildings;  ///< labels above are low-confidence candidates
    FixedPoint fixed;
    ParcelSource* parcels = nullptr;  ///< gives the names of parcels
    /// Receives the records of all buildings, even of those not written.
    BuildingRecords* building_records = nullptr;
    const StoredRoofs* roofs = nullptr;      ///< null without -roofs
    std::vector<std::int64_t> divided = {};  ///< wholes of which several buildings are parts, ascending
    bool with_cuts = false;  ///< true to report the errors of the stacks truncated at level 1, 2, ...

    [[nodiscard]] bool is_low_confidence(std::size_t contour) const {
        return contours.head(contour).label > buildings;
    }
};

/// Draws, reprojects, validates and measures every outline and writes it with its attributes, in the order of
/// contours. Updates the report. Does not finish the sink.
/// @param records of the same contours @return see FeatureWriter::finish() @throws Error
std::optional<DrawnStack> write_features(const FeatureInput& input, const RecordBuilder& records,
                                         FeatureSink& sink, Context& context);

/// Styles of buildings and contours without the placement of 3D blocks. @param disjoint true if contours are
/// bands
[[nodiscard]] LayerStyle building_style(FieldNames names);
[[nodiscard]] LayerStyle contour_style(bool disjoint);
[[nodiscard]] LayerStyle roof_style();

/// Sets the default styles of the input's layers: the same height classes in metres for all, contours ordered
/// from low to high, and in 3D the stack, or blocks of buildings if no contours are written.
/// @param vertical_metres metres per vertical unit of the DEM
void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres);

}  // namespace d2b::features
