#pragma once

#include <memory>

#include "dem2buildings/side_rasters.hpp"
#include "pipeline/pipeline.hpp"

namespace d2b {

/// What the options name to be read, opened.
struct Inputs {
    std::unique_ptr<DemSource> dem;
    SideSources side;

    [[nodiscard]] Sources sources() const {
        return {*dem, side.terrain.get(), side.mask.get(), side.ndvi.get()};
    }
};

/// @throws InputError, OptionError also where source and destination were given in the wrong order
[[nodiscard]] Inputs open_inputs(const Options& options, Context& context);

/// The whole job on files: reads what the options name and writes the destination, and the rasters and the
/// picture that they name beside it. The report is in the context.
/// @param options as check_options() takes them @return the layers that were written @throws Error
Layers extract_file(const Options& options, Context& context);

}  // namespace d2b
