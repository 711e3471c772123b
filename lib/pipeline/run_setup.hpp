#pragma once

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/square_area.hpp"
#include "dem2buildings/run.hpp"
#include "features/layer_specs.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// What is known of a run before an elevation is read.
struct RunSetup {
    RunPlan plan;
    const DemInfo& dem;
    Crs crs;
    Crs target;  ///< kind none: the DEM's
    Georeference georeference;
    SquareArea area;
    CellSize cell;      ///< known where buildings are looked for
    LayerSpecs layers;  ///< without their styles

    /// Side of a square of a cell's area, in metres.
    [[nodiscard]] double cell_m() const { return cell_size_m(dem.window, area); }
    /// The CRS of what is written.
    [[nodiscard]] const Crs& written() const { return target.kind() == Crs::Kind::none ? crs : target; }
};

/// Checks what was asked for, decides what was left open, starts the threads, and asks the destination
/// whether it can hold the result: what cannot be is refused before the work.
/// @throws OptionError, InputError, OutputError
[[nodiscard]] RunSetup set_up_run(const Options& asked, const DemInfo& dem, FeatureSink& sink,
                                  Context& context);

}  // namespace d2b
