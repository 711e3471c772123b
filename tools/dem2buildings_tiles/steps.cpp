#include "dem2buildings_tiles/steps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/json_report.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/progress.hpp"
#include "dem2buildings_tiles/plan_file.hpp"
#include "dem2buildings_tiles/source_mosaic.hpp"
#include "pipeline/tiles/tile_rasters.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "write/vector/layer_parts.hpp"

namespace d2b {
namespace {

// Measured on a dense town (docs/developers/scaling.md).
constexpr double find_seconds = 0.36e-6;   // per point that a tile sees, on one core
constexpr double draw_seconds = 0.23e-6;   // per point of its own
constexpr std::int64_t memory_bytes = 30;  // per point that it sees
/// A float a point, as most rasters have it.
constexpr std::int64_t point_bytes = 4;

TileCost cost_of(const tiles::TileGrid& tiles) {
    TileCost cost;
    std::int64_t seen = 0;
    std::int64_t own = 0;
    for (std::int64_t tile = 0; tile < tiles.count(); ++tile) {
        const detect::Unit whole = tiles.whole(tile);
        seen += whole.seen.points();
        own += whole.own.points();
        cost.memory_bytes = std::max(cost.memory_bytes, memory_bytes * whole.seen.points());
    }
    const auto count = static_cast<double>(tiles.count());
    cost.find_seconds = find_seconds * static_cast<double>(seen) / count;
    cost.draw_seconds = draw_seconds * static_cast<double>(own) / count;
    cost.bytes_read = point_bytes * (seen + own);
    return cost;
}

std::string rounded(double value) {
    return number_text(value < 10 ? std::ceil(value * 10) / 10 : std::ceil(value));
}

std::string spoken(const TilePlan& plan, const TileCost& cost, const std::string& work) {
    const bool one = plan.tiles == 1;
    return std::to_string(plan.tiles) + (one ? " tile" : " tiles") + " in " + work +
           ". With one thread a tile takes " + rounded(cost.find_seconds) + " s to find and " +
           rounded(cost.draw_seconds) + " s to draw, about, and " +
           rounded(static_cast<double>(cost.memory_bytes) / 1e9) + " GB of memory; " +
           rounded(static_cast<double>(cost.bytes_read) / 1e9) + " GB of elevations are read.\n";
}

/// All that the steps read beside each other's files.
std::vector<reading::SourceFile> files_behind(const Options& options) {
    std::vector<reading::SourceFile> files = reading::source_files(options.read);
    std::ranges::copy(reading::list_auxiliary_files(options), std::back_inserter(files));
    return files;
}

/// Refuses a folder with another plan, because that would be lost to its users.
void require_no_other(const std::filesystem::path& work, const TilePlan& plan) {
    if (!std::filesystem::exists(work / "plan.json"))
        return;
    const TilePlan known = read_plan(work).plan;
    if (known.words != plan.words || known.folder != plan.folder || known.side != plan.side ||
        known.files != plan.files || known.window != plan.window)
        refuse_other_plan(work);
}

void plan(const TileCommand& command, const Callbacks& callbacks) {
    const Options& options = command.request.options;
    tiles::require_tileable(options);
    const bool parts = writing::writes_parts(options.write);
    if (parts && (options.write.append || options.write.overwrite))
        throw OptionError(
            "The folder to which tiles add their files must be new; give another name, or delete it, and "
            "leave out -append and -overwrite.");
    if (parts && options.write.has_footprints())
        throw OptionError(
            "-footprints cannot be written in parts, because each footprint comes back once and in order; "
            "write one file, such as a GeoPackage.");
    const std::filesystem::path work(command.work);
    std::optional<SourceMosaic> mosaic;
    if (!std::filesystem::exists(work / "plan.json"))
        tiles::require_raster_names(options);
    if (!command.list.empty())
        mosaic.emplace(command.list, work, options.read.band);
    keep_inputs(options);
    const Inputs inputs = open_inputs(options, callbacks);
    const auto sink = open_sink(options.write, callbacks);
    tiles::TileRun run({work, 0, command.side, {}, {}}, options, inputs.sources(), *sink, callbacks);
    const TilePlan plan{command.words,
                        std::filesystem::current_path().string(),
                        run.setup().plan.layers,
                        parts,
                        command.side,
                        run.tiles().count(),
                        run.window(),
                        files_behind(options),
                        run.undeclared()};
    const TileCost cost = cost_of(run.tiles());
    require_no_other(work, plan);
    if (!std::filesystem::exists(work / "plan.json"))
        write_plan(work, plan, cost);
    if (options.write.has_footprints()) {
        Callbacks silent = callbacks;  // merge tells of invalid ones
        silent.on_warning = nullptr;
        tiles::PlannedSink nowhere(plan.layers);
        tiles::TileRun planned(read_plan(work).work, options, inputs.sources(), nowhere, silent);
        tiles::plan_footprints(planned);
    }
    if (mosaic)
        mosaic->keep();
    if (!command.quiet)
        std::cout << spoken(plan, cost, command.work);
}

/// Plan, options and inputs that a step after plan begins with.
struct Planned {
    KnownPlan known;
    Options options;
    Inputs inputs;
};

void require_same_source(const TilePlan& plan, const Options& options, const DemInfo& dem) {
    const std::vector<reading::SourceFile> files = files_behind(options);
    for (const reading::SourceFile& file : files)
        if (std::ranges::find(plan.files, file) == plan.files.end())
            throw InputError("'" + file.name +
                             "' has changed since the plan was made; plan again, with a new work folder.");
    if (files.size() != plan.files.size() || dem.window != plan.window)
        throw InputError(
            "'" + dem.name +
            "' is not made of the files that the plan was made for; plan again, with a new work folder.");
}

/// @return the work folder, whatever the current one becomes
Planned open_planned(const TileCommand& command, const Callbacks& callbacks) {
    const std::filesystem::path work = std::filesystem::absolute(command.work);
    Planned planned{read_plan(work), {}, {}};
    std::error_code error;
    std::filesystem::current_path(planned.known.plan.folder, error);
    if (error)
        throw InputError("The plan was made in the folder '" + planned.known.plan.folder +
                         "', which cannot be opened here: " + error.message() +
                         "; make it available under the same name on every machine.");
    planned.options = parse_command_line(planned.known.plan.words).options;
    if (command.threads > 0)
        planned.options.run.threads = command.threads;
    planned.inputs = open_inputs(planned.options, callbacks);
    require_same_source(planned.known.plan, planned.options, planned.inputs.dem->info());
    return planned;
}

/// Begins the run of a step. @param features the destination, or in its place a PlannedSink
/// @throws InputError where the plan is not the one that its options make
std::unique_ptr<tiles::TileRun> begin_step(const Planned& planned, FeatureSink& features,
                                           const Callbacks& callbacks) {
    auto run = std::make_unique<tiles::TileRun>(planned.known.work, planned.options, planned.inputs.sources(),
                                                features, callbacks);
    if (run->tiles().count() != planned.known.plan.tiles)
        throw InputError("'" + (planned.known.work.folder / "plan.json").string() +
                         "' has been changed: it has " + std::to_string(planned.known.plan.tiles) +
                         " tiles, and its options make " + std::to_string(run->tiles().count()) +
                         "; run 'dem2buildings_tiles plan' with a new work folder.");
    return run;
}

void require_tile(std::int64_t tile, const TilePlan& plan) {
    if (tile >= plan.tiles)
        throw InputError("There is no tile " + std::to_string(tile) + "; the plan has " +
                         std::to_string(plan.tiles) + ", numbered from 0.");
}

template <typename Step>
void on_tiles(const TileCommand& command, const Callbacks& callbacks, const Step& step) {
    const Planned planned = open_planned(command, callbacks);
    for (const std::int64_t tile : command.tiles)
        require_tile(tile, planned.known.plan);
    for (const std::int64_t tile : command.tiles) {
        tiles::PlannedSink nowhere(planned.known.plan.layers);
        step(*begin_step(planned, nowhere, callbacks), tile);
    }
}

void join(const TileCommand& command, const Callbacks& callbacks) {
    const Planned planned = open_planned(command, callbacks);
    tiles::PlannedSink nowhere(planned.known.plan.layers);
    tiles::join_tiles(*begin_step(planned, nowhere, callbacks));
}

/// Merges the tiles into the destination, or numbers them where each has files of its own.
RunReport merged(const Planned& planned, const ReportReader<RunReport>& reader, const Callbacks& callbacks) {
    const auto sink = open_sink(planned.options.write, callbacks);
    const auto run = begin_step(planned, *sink, callbacks);
    return planned.known.plan.parts ? tiles::number_tiles(*run, reader)
                                    : tiles::merge_tiles(*run, *sink, reader);
}

bool has_numbers(const Planned& planned) {
    if (!planned.known.plan.parts)
        return false;
    tiles::PlannedSink nowhere(planned.known.plan.layers);
    return tiles::are_numbered(*begin_step(planned, nowhere, {}));
}

void merge(const TileCommand& command, OwnStdout& own_stdout, const Callbacks& callbacks) {
    std::vector<std::string> warnings;
    const Callbacks heard = recording_warnings(callbacks, warnings);
    const Planned planned = open_planned(command, heard);
    if (has_numbers(planned))
        return;
    const auto whole = [&](RunReport report) {
        report.warnings = warnings;
        if (planned.known.plan.parts)
            report.output = planned.options.write.destination;
        return report;
    };
    ReportReader<RunReport> reader;
    if (command.json)
        reader =
            own_stdout.reader<RunReport>([&](const RunReport& report) { return json_report(whole(report)); });
    const RunReport report = whole(merged(planned, reader, heard));
    if (!command.quiet)
        std::cout << summary(report, report.layers, report.output);
}

/// Shows each layer as one when all parts are there.
void show_parts(const tiles::TileRun& run, std::int64_t after) {
    const std::optional<tiles::NumberedWhole> whole = tiles::written_totals(run, after);
    if (!whole)
        return;
    const features::RunSetup& setup = run.setup();
    CommitList commit;
    std::vector<std::unique_ptr<PendingResult>> files;
    for (std::size_t i = 0; i < setup.layers.layers.size(); ++i) {
        const tiles::NumberedLayer& layer = whole->layers.at(i);
        writing::LayerMosaic mosaic{setup.layers.layers[i],
                                    setup.written().wkt(),
                                    layer.features,
                                    {layer.bounds.left, layer.bounds.low},
                                    {layer.bounds.right, layer.bounds.high},
                                    layer.tiles};
        if (mosaic.parts.empty() || mosaic.parts.front() != 0)
            mosaic.parts.insert(mosaic.parts.begin(), 0);
        files.push_back(writing::prepare_layer_mosaic(setup.plan.asked.write, mosaic));
        commit.add(*files.back());
    }
    commit.publish();
}

void write(const TileCommand& command, const Callbacks& callbacks) {
    const Planned planned = open_planned(command, callbacks);
    if (!planned.known.plan.parts)
        throw InputError(
            "'" + command.work +
            "' is the plan of one file, which merge writes; use -f FlatGeobuf and a folder to write parts.");
    for (const std::int64_t tile : command.tiles)
        require_tile(tile, planned.known.plan);
    for (const std::int64_t tile : command.tiles) {
        const auto sink = writing::open_part_sink(planned.options.write, tile, callbacks);
        const auto run = begin_step(planned, *sink, callbacks);
        tiles::write_tile(*run, tile, *sink);
        if (tile == command.tiles.back())
            show_parts(*run, tile);
    }
}

}  // namespace

void run_step(const TileCommand& command, OwnStdout& own_stdout, const Callbacks& callbacks) {
    // Drops warnings, because plan has given them, or merge will give them once for all tiles.
    Callbacks silent = callbacks;
    silent.on_warning = nullptr;
    switch (command.kind) {
        case tiles::TileStep::plan:
            return plan(command, callbacks);
        case tiles::TileStep::find:
            return on_tiles(command, silent, tiles::find_tile);
        case tiles::TileStep::join:
            return join(command, silent);
        case tiles::TileStep::draw:
            return on_tiles(command, silent, tiles::draw_tile);
        case tiles::TileStep::merge:
            return merge(command, own_stdout, callbacks);
        case tiles::TileStep::write:
            return write(command, silent);
    }
}

}  // namespace d2b
