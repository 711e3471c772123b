#include "stages.hpp"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <utility>

#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"
#include "detect/detection.hpp"
#include "features/record_builder.hpp"
#include "ground/ground.hpp"
#include "outline/outline.hpp"
#include "prepared_run.hpp"
#include "support/memory_io.hpp"

namespace d2b::bench {

using namespace d2b::ground;

namespace {

using State = benchmark::State;

void count_points(State& state, const PreparedRun& run) {
    state.SetItemsProcessed(state.iterations() * run.points());
}

void read(State& state, PreparedRun& run) {
    for ([[maybe_unused]] auto _ : state) {
        const std::unique_ptr<DemSource> source = open_dem(run.decided.asked.read);
        ElevationReader reader(*source, run.context, {.keep_bytes = 0});
        reader.for_each([](const ElevationBand& band) { benchmark::DoNotOptimize(band.elevations.data()); });
    }
    count_points(state, run);
}

void ground(State& state, PreparedRun& run) {
    MetreGrid surface = run.surface();
    for ([[maybe_unused]] auto _ : state)
        benchmark::DoNotOptimize(estimate_ground(surface, run.cell, run.decided.asked.ground, run.context));
    count_points(state, run);
}

void detect(State& state, PreparedRun& run) {
    MetreGrid surface = run.surface();
    const Terrain terrain = estimate_ground(surface, run.cell, run.decided.asked.ground, run.context);
    const Scene scene{surface, terrain.elevation, run.cell};
    for ([[maybe_unused]] auto _ : state)
        benchmark::DoNotOptimize(
            detect_buildings(scene, run.decided.asked.detect, run.decided.building_m2, run.context));
    count_points(state, run);
}

void levels(State& state, PreparedRun& run) {
    for ([[maybe_unused]] auto _ : state)
        run.make_levels();
    count_points(state, run);
}

class Drain : public ContourSink {
  public:
    std::int64_t take(FinishedContour&& finished) override {
        const FinishedContour taken = std::move(finished);
        return taken.contour.key.level;
    }
};

void trace(State& state, PreparedRun& run) {
    for ([[maybe_unused]] auto _ : state) {
        Drain drain;
        run.trace(drain);
    }
    count_points(state, run);
}

void filter(State& state, PreparedRun& run) {
    for ([[maybe_unused]] auto _ : state) {
        state.PauseTiming();
        std::vector<FinishedContour> traced = run.traced;
        state.ResumeTiming();
        benchmark::DoNotOptimize(run.filter(std::move(traced)));
    }
    count_points(state, run);
}

void outline(State& state, PreparedRun& run) {
    Context context;
    const OutlineRules rules{run.decided.walls, run.decided.wall_tolerance(0), 0, 0, false};
    for ([[maybe_unused]] auto _ : state) {
        const Outliner outliner(*run.contours, choose_outline_method(rules, run.georeference), rules,
                                run.georeference,
                                x_stretch(run.georeference, run.crs, run.source->info().window), context);
        for (std::size_t i = 0; i < run.contours->size(); ++i)
            benchmark::DoNotOptimize(outliner.outline(i));
    }
    count_points(state, run);
}

void attributes(State& state, PreparedRun& run) {
    const Window& window = run.source->info().window;
    const AttributeContext given{
        run.plan, run.frame.fixed, run.found.footprints, 1, {{0, 0}, {window.rows, window.cols}}};
    for ([[maybe_unused]] auto _ : state) {
        const RecordBuilder maker(*run.contours, given);
        for (std::size_t i = 0; i < run.contours->size(); ++i)
            benchmark::DoNotOptimize(maker.contour(i, run.contours->fetch(i)));
    }
    count_points(state, run);
}

void write(State& state, PreparedRun& run) {
    test::MemorySink made;
    d2b::run(run.decided.asked, {*run.source}, {made});
    WriteOptions options;
    options.destination = (std::filesystem::temp_directory_path() / "stages_bench.gpkg").string();
    options.overwrite = true;
    for ([[maybe_unused]] auto _ : state) {
        const std::unique_ptr<FeatureSink> sink = open_sink(options);
        sink->begin(made.layers, made.provenance);
        for (std::size_t layer = 0; layer < made.layers.size(); ++layer) {
            for (const Feature& feature : made.features[layer])
                sink->add(layer, feature);
        }
        sink->finish();
        state.PauseTiming();
        std::filesystem::remove(options.destination);
        state.ResumeTiming();
    }
    count_points(state, run);
}

/// Made when it is first asked for: a filter may leave a preset out.
PreparedRun& prepared(bool detection) {
    if (detection) {
        static PreparedRun run(city_path, Preset::buildings);
        return run;
    }
    static PreparedRun run(city_path, Preset::thesis);
    return run;
}

using Body = void (*)(State&, PreparedRun&);

void add(const std::string& name, Body body, bool detection) {
    benchmark::RegisterBenchmark(name.c_str(), [=](State& state) { body(state, prepared(detection)); })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

}  // namespace

void register_stages() {
    add("ground", ground, true);
    add("detect", detect, true);
    for (const bool detection : {false, true}) {
        const std::string preset = detection ? "/buildings" : "/thesis";
        add("read" + preset, read, detection);
        add("levels" + preset, levels, detection);
        add("trace" + preset, trace, detection);
        add("filter" + preset, filter, detection);
        add("outline" + preset, outline, detection);
        add("attributes" + preset, attributes, detection);
        add("write" + preset, write, detection);
    }
}

}  // namespace d2b::bench
