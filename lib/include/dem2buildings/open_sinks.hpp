#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// A vector dataset of any OGR driver that can create one.
/// - A new local file or folder is written in a hidden folder beside the destination, read back and counted,
///   forced to the disk, then renamed.
/// - With -overwrite or -append, a format with transactions (GeoPackage, SQLite) changes in one transaction,
///   in place: other layers stay, and so does what other processes see of the file until it is committed.
/// - With -overwrite, another format is replaced whole, in one step (a set of files, such as a .shp: the main
///   file last); with -append, it is changed as a copy that then takes its place.
/// - Streams (/vsistdout/, devices), /vsimem/ and other virtual files, and databases without transactions are
///   written in place: what fails half way stays half written there.
/// The checks that need no result are made here, so that a long run does not fail at its end.
/// @throws OptionError: unknown format or extension, an existing destination without -overwrite or -append or
/// that is something else, layers and files of others that would be lost. @throws OutputError: not writable
[[nodiscard]] std::unique_ptr<FeatureSink> open_sink(const WriteOptions& options,
                                                     const Callbacks& callbacks = {});

/// What the options name beside the destination; empty where they name nothing.
struct SideSinks {
    std::unique_ptr<RasterSink> ground;
    std::unique_ptr<RasterSink> height;
    std::unique_ptr<RasterSink> canopy;
    std::vector<std::unique_ptr<SurfaceSink>> surfaces;
    /// Of the page, which is among the surfaces: gets the terrain in metres, or where there is none the
    /// elevations, before the page is finished. nullptr where there is no page.
    std::unique_ptr<RasterSink> page_relief;
};

/// GeoTIFFs and files of surfaces, which appear whole or not at all. @throws OptionError, OutputError
[[nodiscard]] SideSinks open_side_sinks(const Options& options, const DemInfo& dem);

}  // namespace d2b
