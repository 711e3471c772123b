#pragma once

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/square_area.hpp"
#include "dem2buildings/run.hpp"
#include "features/layer_specs.hpp"
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

}  // namespace d2b
