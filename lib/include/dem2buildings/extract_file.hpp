#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"

namespace d2b {

/// What the options name to be read, opened.
struct Inputs {
    std::unique_ptr<DemSource> dem;
    SideSources side;

    [[nodiscard]] Sources sources() const {
        return {*dem, side.terrain.get(), side.mask.get(), side.ndvi.get(), side.parcels.get()};
    }
};

/// @throws InputError; OptionError, also where source and destination were given in the wrong order
[[nodiscard]] Inputs open_inputs(const Options& options, const Callbacks& callbacks = {},
                                 const SideArrays& arrays = {});

/// The same callbacks, told of each warning once, which is then in `heard` as well. @param heard must outlive
/// them
[[nodiscard]] Callbacks remembering(const Callbacks& callbacks, std::vector<std::string>& heard);

/// The whole job on files: reads what the options name and writes the destination, and all that they name
/// beside it. These show together, when all of them are complete, or not at all (see CommitList).
/// @param arrays that stand for rasters which the options name
/// @return the report of the run, with all that was warned of from opening the source on @throws Error
RunReport extract_file(const Options& options, const Callbacks& callbacks = {},
                       const ReportReader<RunReport>& reader = {}, const SideArrays& arrays = {});

}  // namespace d2b
