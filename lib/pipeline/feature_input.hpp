#pragma once

#include <functional>

#include "dem2buildings/report.hpp"
#include "features/write_features.hpp"
#include "pipeline/run_setup.hpp"

namespace d2b {

/// What is drawn.
struct ToDraw {
    const StoredContours& contours;
    const Outliner& outliner;
    Label buildings;  ///< labels above are doubtful
    FixedPoint fixed;
    ParcelSource* parcels = nullptr;
};

/// What the features of a run need. @param setup which must outlive it, as what is drawn must
/// @param compare, kept as FeatureInput has them
[[nodiscard]] FeatureInput feature_input(const RunSetup& setup, const ToDraw& what, const RunReport& report,
                                         std::function<StackError(const DrawnStack&)> compare,
                                         BuildingRecords* kept = nullptr);

/// Which contours of a run the outlines of each depend on.
[[nodiscard]] OutlineReach reach_of(const ContourList& contours, const RunSetup& setup, Context& context);

/// The outlines of contours of a run.
[[nodiscard]] Outliner draw_outlines(const ContourList& contours, const RunSetup& setup, Context& context);

}  // namespace d2b
