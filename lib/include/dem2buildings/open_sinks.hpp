#pragma once

#include <memory>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// Opens a vector dataset of any OGR driver that can create one.
/// - A new local file or folder is written in a hidden folder next to the destination, read back and counted
///   because drivers may ignore write errors, flushed to disk, then renamed.
/// - With -overwrite or -append, a format with transactions (GeoPackage, SQLite) is changed in place in one
///   transaction: other layers stay, and other processes see no change until the commit.
/// - With -overwrite, another format is replaced as a whole, in one step (for a set of files, such as a .shp:
///   the main file last); with -append, a copy is changed and then replaces the original.
/// - Streams (/vsistdout/, devices), /vsimem/ and other virtual files, and databases without transactions are
///   written in place: a failure leaves a partial result.
///
/// Makes all checks that need no result, so that a long run does not fail at its end.
/// @throws OptionError: unknown format or extension; an existing destination without -overwrite or -append,
/// or of another kind; foreign layers or files that would be lost. @throws OutputError: not writable
[[nodiscard]] std::unique_ptr<FeatureSink> open_sink(const WriteOptions& options,
                                                     const Callbacks& callbacks = {});

/// Refuses to replace polygons that a run reads, because decisions of an editor cannot be made again: their
/// file, or in formats with transactions their layer. @throws OptionError
void keep_inputs(const Options& options);

/// Additional outputs named by the options; empty if there are none.
struct AuxiliarySinks {
    std::unique_ptr<RasterSink> ground;
    std::unique_ptr<RasterSink> height;
    std::unique_ptr<RasterSink> canopy;
    std::vector<std::unique_ptr<SurfaceSink>> surfaces;
    /// Raster for the page, which is among the surfaces: it receives the terrain in metres, or the elevations
    /// if there is no terrain, before the page is finished. nullptr if there is no page.
    std::shared_ptr<RasterSink> page_relief;
};

/// Opens GeoTIFFs and files of surfaces, each of which appears as a whole or not at all. @throws OptionError,
/// OutputError
[[nodiscard]] AuxiliarySinks open_auxiliary_sinks(const Options& options, const DemInfo& dem);

}  // namespace d2b
