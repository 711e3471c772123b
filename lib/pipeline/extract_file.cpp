#include "dem2buildings/extract_file.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"
#include "pipeline/report_run.hpp"
#include "view/preview.hpp"

namespace d2b::pipeline {

/// Forwards a raster to two sinks, either of which may be nullptr.
class RasterTee final : public RasterSink {
  public:
    RasterTee(RasterSink* one, RasterSink* other) : one_(one), other_(other) {}

    /// Returns the sink to write to; nullptr if neither sink exists.
    [[nodiscard]] RasterSink* sink() {
        return one_ != nullptr && other_ != nullptr ? this : one_ != nullptr ? one_ : other_;
    }
    void write(const Window& part, std::span<const float> values) override {
        one_->write(part, values);
        other_->write(part, values);
    }
    void finish() override {
        one_->finish();
        other_->finish();
    }
    void prepare(CommitList& commit) override {
        one_->prepare(commit);
        other_->prepare(commit);
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override {
        std::vector<std::string> warnings = one_->take_warnings();
        for (std::string& warning : other_->take_warnings())
            warnings.push_back(std::move(warning));
        return warnings;
    }

  private:
    RasterSink* one_;
    RasterSink* other_;
};

namespace {

std::vector<SurfaceSink*> pointers(const std::vector<std::unique_ptr<SurfaceSink>>& sinks) {
    std::vector<SurfaceSink*> all;
    all.reserve(sinks.size());
    for (const auto& sink : sinks)
        all.push_back(sink.get());
    return all;
}

}  // namespace
}  // namespace d2b::pipeline

namespace d2b {

Inputs open_inputs(const Options& options, const Callbacks& callbacks, const AuxiliaryArrays& arrays) {
    Inputs inputs;
    inputs.dem = open_dem(options.read, callbacks);
    inputs.side = open_auxiliary_sources(options, inputs.dem->info(), callbacks, arrays);
    return inputs;
}

Callbacks recording_warnings(const Callbacks& callbacks, std::vector<std::string>& recorded) {
    Callbacks all = callbacks;
    all.on_warning = [&recorded, tell = callbacks.on_warning](const std::string& text) {
        if (std::ranges::find(recorded, text) != recorded.end())
            return;
        recorded.push_back(text);
        if (tell)
            tell(text);
    };
    return all;
}

RunReport extract_file(const Options& options, const Callbacks& callbacks,
                       const ReportReader<RunReport>& reader, const AuxiliaryArrays& arrays) {
    std::vector<std::string> warnings;
    const Callbacks recorded = recording_warnings(callbacks, warnings);
    keep_inputs(options);
    const Inputs inputs = open_inputs(options, recorded, arrays);
    const auto sink = open_sink(options.write, recorded);
    const AuxiliarySinks side = open_auxiliary_sinks(options, inputs.dem->info());
    view::Preview preview(options, *sink, inputs.dem->info());
    // The page shows buildings on the terrain, or on the lowest elevations if there is no terrain because the
    // run does not detect buildings.
    const bool has_terrain = detects_buildings(options);
    pipeline::RasterTee ground(side.ground.get(), has_terrain ? side.page_relief.get() : nullptr);
    pipeline::RasterTee elevations(preview.elevations(), has_terrain ? nullptr : side.page_relief.get());
    const Sinks sinks{preview.features(), ground.sink(),     side.height.get(),
                      side.canopy.get(),  elevations.sink(), pipeline::pointers(side.surfaces)};
    CommitList commit;
    RunReport report = prepare_run(options, inputs.sources(), sinks, commit, recorded);
    preview.prepare(commit);
    report.warnings = warnings;
    if (reader.prepare)
        reader.prepare(report);
    commit.publish([&] {
        std::ranges::for_each(pipeline::take_warnings(sinks), recorded.on_warning);
        std::ranges::for_each(preview.take_warnings(), recorded.on_warning);
        report.warnings = warnings;
        if (reader.show)
            reader.show(report);
    });
    if (callbacks.on_progress)
        callbacks.on_progress(1);
    return report;
}

}  // namespace d2b
