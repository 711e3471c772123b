#include "dem2buildings/extract_file.hpp"

#include <algorithm>
#include <utility>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/open_sources.hpp"
#include "options/run_plan.hpp"
#include "pipeline/preview.hpp"
#include "pipeline/raster_tee.hpp"
#include "pipeline/report_run.hpp"
#include "read/source_advice.hpp"

namespace d2b {
namespace {

/// If the file names were given in the wrong order, the destination is the raster and the source cannot be
/// read.
std::unique_ptr<DemSource> open_source(const Options& options, const Callbacks& callbacks) {
    try {
        return open_dem(options.read, callbacks);
    } catch (const InputError&) {
        if (!are_swapped(options.read.source, options.write.destination))
            throw;
        throw OptionError("'" + options.read.source + "' is no raster and '" + options.write.destination +
                          "' is one; the source comes first, so change their order.");
    }
}

std::vector<SurfaceSink*> pointers(const std::vector<std::unique_ptr<SurfaceSink>>& sinks) {
    std::vector<SurfaceSink*> all;
    all.reserve(sinks.size());
    for (const auto& sink : sinks)
        all.push_back(sink.get());
    return all;
}

}  // namespace

Inputs open_inputs(const Options& options, const Callbacks& callbacks, const SideArrays& arrays) {
    Inputs inputs;
    inputs.dem = open_source(options, callbacks);
    inputs.side = open_side_sources(options, inputs.dem->info(), callbacks, arrays);
    return inputs;
}

Callbacks remembering(const Callbacks& callbacks, std::vector<std::string>& heard) {
    Callbacks all = callbacks;
    all.on_warning = [&heard, tell = callbacks.on_warning](const std::string& text) {
        if (std::ranges::find(heard, text) != heard.end())
            return;
        heard.push_back(text);
        if (tell)
            tell(text);
    };
    return all;
}

RunReport extract_file(const Options& options, const Callbacks& callbacks,
                       const ReportReader<RunReport>& reader, const SideArrays& arrays) {
    std::vector<std::string> warnings;
    const Callbacks heard = remembering(callbacks, warnings);
    const Inputs inputs = open_inputs(options, heard, arrays);
    const auto sink = open_sink(options.write, heard);
    const SideSinks side = open_side_sinks(options, inputs.dem->info());
    Preview preview(options, *sink, inputs.dem->info());
    // The page shows buildings on the terrain, or on the lowest elevations if there is no terrain because the
    // run does not detect buildings.
    const bool has_terrain = detects_buildings(options);
    RasterTee ground(side.ground.get(), has_terrain ? side.page_relief.get() : nullptr);
    RasterTee elevations(preview.elevations(), has_terrain ? nullptr : side.page_relief.get());
    const Sinks sinks{preview.features(), ground.sink(),     side.height.get(),
                      side.canopy.get(),  elevations.sink(), pointers(side.surfaces)};
    CommitList commit;
    RunReport report = prepare_run(options, inputs.sources(), sinks, commit, heard);
    preview.prepare(commit);
    report.warnings = warnings;
    if (reader.prepare)
        reader.prepare(report);
    commit.publish([&] {
        std::ranges::for_each(take_warnings(sinks), heard.on_warning);
        std::ranges::for_each(preview.take_warnings(), heard.on_warning);
        report.warnings = warnings;
        if (reader.show)
            reader.show(report);
    });
    if (callbacks.on_progress)
        callbacks.on_progress(1);
    return report;
}

}  // namespace d2b
