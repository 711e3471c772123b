#pragma once

#include <functional>
#include <optional>

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/run.hpp"
#include "features/surface_lattice.hpp"
#include "features/write_features.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// State of a run before any elevation is read: decided options, CRSs, geometry of the grid, layers.
struct RunSetup {
    RunPlan plan;
    const DemInfo& dem;
    Crs crs;
    Crs target;  ///< kind none: the CRS of the DEM
    Georeference georeference;
    SquareArea area;
    CellSize cell;      ///< set only if buildings are detected
    LayerSpecs layers;  ///< styles are added later

    /// Returns the side in metres of a square with the area of a cell.
    [[nodiscard]] double cell_m() const { return cell_size_m(dem.window, area); }
    /// Returns the CRS of the output.
    [[nodiscard]] const Crs& written() const { return target.kind() == Crs::Kind::none ? crs : target; }
};

/// Validates the options, decides the open ones, starts the threads, and asks the destination whether it can
/// hold the result, because an impossible request should fail before the work, not after it.
/// @throws OptionError, InputError, OutputError
[[nodiscard]] RunSetup set_up_run(const Options& asked, const DemInfo& dem, FeatureSink& sink,
                                  Context& context);

/// Contours and outlines to be drawn, with the values that their features need.
struct DrawingInput {
    const StoredContours& contours;
    const Outliner& outliner;
    Label buildings;  ///< labels above are low-confidence candidates
    FixedPoint fixed;
    ParcelSource* parcels = nullptr;
};

/// Collects the input of write_features(). @param setup must outlive the result, as must the referenced
/// contours
/// @param stack_error, building_records see FeatureInput
[[nodiscard]] FeatureInput feature_input(const RunSetup& setup, const DrawingInput& drawing,
                                         const RunReport& report,
                                         std::function<StackError(const DrawnStack&)> stack_error,
                                         BuildingRecords* building_records = nullptr);

/// Groups of contours whose outlines depend on each other, and the reach of that dependence in cells.
[[nodiscard]] OutlineDependencies outline_dependencies_of(const ContourList& contours, const RunSetup& setup,
                                                          Context& context);

/// Draws the outlines of the contours of a run.
[[nodiscard]] Outliner draw_outlines(const ContourList& contours, const RunSetup& setup, Context& context);

/// Creates the lattice of the run's surfaces and asks the sinks whether they can hold it. @return nullopt if
/// there are none
/// @throws OptionError, OutputError
[[nodiscard]] std::optional<SurfaceLattice> set_up_surfaces(const RunSetup& setup, const Sinks& sinks,
                                                            const UnitReport& units);

/// True if a sink takes the tiers of stacks.
[[nodiscard]] bool has_tiers(const Sinks& sinks);

/// Passes on the elevation range as soon as it is known. @param range in the vertical unit @throws
/// OptionError
void set_heights(SurfaceLattice& lattice, const ElevationRange& range, const Sinks& sinks);

}  // namespace d2b
