#include "dem2buildings/extract_file.hpp"

#include "dem2buildings/error.hpp"
#include "dem2buildings/preview.hpp"
#include "read/gdal_dem_source.hpp"
#include "read/source_advice.hpp"
#include "write/ogr_feature_sink.hpp"

namespace d2b {
namespace {

/// Who gives the file names in the wrong order reads nothing of the raster that he gave.
std::unique_ptr<DemSource> open_source(const Options& options, Context& context) {
    try {
        return open_dem(options.read, context);
    } catch (const InputError&) {
        if (!are_swapped(options.read.source, options.write.destination))
            throw;
        throw OptionError("'" + options.read.source + "' is no raster and '" + options.write.destination +
                          "' is one; the source comes first, so change their order.");
    }
}

}  // namespace

Inputs open_inputs(const Options& options, Context& context) {
    Inputs inputs;
    inputs.dem = open_source(options, context);
    inputs.side = open_side_sources(options, inputs.dem->info(), context);
    return inputs;
}

Layers extract_file(const Options& options, Context& context) {
    const Inputs inputs = open_inputs(options, context);
    const auto sink = open_sink(options.write, context);
    const SideSinks side = open_side_sinks(options, inputs.dem->info(), context);
    Preview preview(options, *sink, *inputs.dem, context);
    run(options, inputs.sources(),
        {preview.features(), side.ground.get(), side.height.get(), side.canopy.get()}, context);
    preview.publish();
    return sink->layers(options.write.layers);
}

}  // namespace d2b
