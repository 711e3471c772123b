#include "dem2buildings/sweep.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "view/map_page.hpp"
#include "view/preview.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t width = 11;

std::string aligned(const std::string& text) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// Draws a trial.
class TrialMap final : public pipeline::TrialView {
  public:
    TrialMap(FeatureSink& nothing, const view::MapFrame& frame, writing::PictureFormat format,
             view::PreviewSink::OnMap taken)
        : sink_(nothing, frame, format, std::move(taken)) {}
    [[nodiscard]] FeatureSink& features() override { return sink_; }
    [[nodiscard]] RasterSink& elevations() override { return sink_.relief(); }

  private:
    view::PreviewSink sink_;
};

std::string caption_of(const pipeline::TrialValues& values, const SweepPlan& plan) {
    std::string caption = "lod " + std::to_string(values.lod) + ", nf " + std::to_string(values.noise_factor);
    if (!plan.details.empty())
        caption += ", detail " + number_text(values.detail);
    return caption;
}

}  // namespace

std::string sweep_table(const std::vector<pipeline::Trial>& trials) {
    std::string text;
    for (const char* title :
         {"lod", "nf", "detail", "buildings", "contours", "points", "rmse [m]", "seconds"})
        text += aligned(title);
    for (const pipeline::Trial& trial : trials) {
        const RunReport& report = trial.report;
        text += "\n" + aligned(std::to_string(trial.values.lod)) +
                aligned(std::to_string(trial.values.noise_factor)) +
                aligned(number_text(trial.values.detail)) + aligned(std::to_string(report.buildings)) +
                aligned(std::to_string(report.contours)) + aligned(std::to_string(report.vertices)) +
                aligned(fixed_text(report.stack_rmse_m, 2)) + aligned(fixed_text(trial.seconds, 2));
    }
    return text + "\n";
}

std::string sweep_json(const std::vector<pipeline::Trial>& trials) {
    Json rows = Json::array();
    for (const pipeline::Trial& trial : trials)
        rows.push_back(Json{{"lod", trial.values.lod},
                            {"nf", trial.values.noise_factor},
                            {"detail", trial.values.detail},
                            {"buildings", trial.report.buildings},
                            {"contours", trial.report.contours},
                            {"points", trial.report.vertices},
                            {"stack_rmse_m", trial.report.stack_rmse_m},
                            {"seconds", trial.seconds}});
    return Json{{"trials", rows}}.dump(2) + "\n";
}

void run_sweep(const Options& options, const Sources& sources, const SweepPlan& plan,
               const Callbacks& callbacks, const ReportReader<std::vector<pipeline::Trial>>& reader) {
    CommitList commit;
    if (options.write.preview.empty()) {
        const std::vector<pipeline::Trial> trials =
            pipeline::run_trials(options, sources, plan, {}, callbacks);
        reader.prepare(trials);
        commit.publish([&] { reader.show(trials); });
        return;
    }
    const std::unique_ptr<writing::PictureFile> file = writing::open_picture(view::picture_target(options));
    const view::SheetPlan sheet =
        view::plan_sheet(plan.trials(), plan.noise_factors.size(), options.write.preview_size);
    const view::MapArea ground = view::map_area_of(options, sources.dem.info());
    const view::MapFrame frame(ground, view::map_size_on_sheet(ground, sheet));
    std::vector<view::TrialPicture> pictures;
    const std::vector<pipeline::Trial> trials = pipeline::run_trials(
        options, sources, plan,
        [&](FeatureSink& nothing, const pipeline::TrialValues& values) {
            return std::make_unique<TrialMap>(
                nothing, frame, file->format(),
                [&pictures, caption = caption_of(values, plan)](view::MapPicture map) {
                    pictures.push_back({caption, std::move(map)});
                });
        },
        callbacks);
    file->write(view::draw_contact_sheet(pictures, sheet, file->format()));
    file->prepare(commit);
    reader.prepare(trials);
    commit.publish([&] {
        if (callbacks.on_warning)
            std::ranges::for_each(file->take_warnings(), callbacks.on_warning);
        reader.show(trials);
    });
}

}  // namespace d2b
