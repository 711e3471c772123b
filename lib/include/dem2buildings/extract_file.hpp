#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"

namespace d2b {

/// Opened sources of the options.
struct Inputs {
    std::unique_ptr<DemSource> dem;
    AuxiliarySources side;

    [[nodiscard]] Sources sources() const {
        return {*dem,
                side.terrain.get(),
                side.mask.get(),
                side.ndvi.get(),
                side.parcels.get(),
                side.footprints.get(),
                side.exclusion.get(),
                side.corrections.get()};
    }
};

/// @throws InputError; OptionError, also if source and destination were given in the wrong order
[[nodiscard]] Inputs open_inputs(const Options& options, const Callbacks& callbacks = {},
                                 const AuxiliaryArrays& arrays = {});

/// Returns callbacks that report each warning once and also append it to `recorded`, which must outlive
/// them
[[nodiscard]] Callbacks recording_warnings(const Callbacks& callbacks, std::vector<std::string>& recorded);

/// Runs the complete job on files: reads the inputs named by the options and writes the destination and all
/// additional outputs. They become visible together, when all are complete, or not at all (see CommitList).
///
///     d2b::Options options;
///     options.read.source = "dem.tif";
///     options.write.destination = "buildings.gpkg";
///     d2b::extract_file(options);
///
/// @param arrays replace rasters named by the options
/// @return the report of the run with all warnings since the source was opened @throws Error
RunReport extract_file(const Options& options, const Callbacks& callbacks = {},
                       const ReportReader<RunReport>& reader = {}, const AuxiliaryArrays& arrays = {});

}  // namespace d2b
