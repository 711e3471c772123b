#pragma once

#include <functional>

#include "dem2buildings/report.hpp"
#include "features/write_features.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// Contours and outlines to be drawn, with the values that their features need.
struct ToDraw {
    const StoredContours& contours;
    const Outliner& outliner;
    Label buildings;  ///< labels above are low-confidence candidates
    FixedPoint fixed;
    ParcelSource* parcels = nullptr;
};

/// Collects the input of write_features(). @param setup must outlive the result, as must the referenced
/// contours
/// @param stack_error, building_records see FeatureInput
[[nodiscard]] FeatureInput feature_input(const RunSetup& setup, const ToDraw& what, const RunReport& report,
                                         std::function<StackError(const DrawnStack&)> compare,
                                         BuildingRecords* kept = nullptr);

/// Groups of contours whose outlines depend on each other, and the reach of that dependence in cells.
[[nodiscard]] OutlineReach reach_of(const ContourList& contours, const RunSetup& setup, Context& context);

/// Draws the outlines of the contours of a run.
[[nodiscard]] Outliner draw_outlines(const ContourList& contours, const RunSetup& setup, Context& context);

}  // namespace d2b
