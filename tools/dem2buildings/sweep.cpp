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
std::string aligned(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// Draws a trial.
class TrialMap final : public pipeline::TrialView {
  public:
    TrialMap(FeatureSink& discarded, const view::MapFrame& frame, writing::PictureFormat format,
             std::shared_ptr<view::FirstOutlines> first, view::PreviewSink::OnMap taken)
        : sink_(discarded, frame, format, std::move(taken), std::move(first)) {}
    [[nodiscard]] FeatureSink& features() override { return sink_; }
    [[nodiscard]] RasterSink& elevations() override { return sink_.relief(); }

  private:
    view::PreviewSink sink_;
};

std::string caption_of(const std::vector<std::string>& values, const SweepPlan& plan) {
    std::string caption;
    for (std::size_t i = 0; i < values.size(); ++i)
        caption += (i == 0 ? "" : ", ") + plan.options[i].name + " " + values[i];
    return caption;
}

std::vector<std::string> cells_of(const pipeline::Trial& trial) {
    const RunReport& report = trial.report;
    std::vector<std::string> cells = trial.values;
    cells.insert(cells.end(), {std::to_string(report.buildings), std::to_string(report.contours),
                               std::to_string(report.vertices), fixed_text(report.stack_rmse_m, 2),
                               fixed_text(trial.seconds, 2)});
    return cells;
}

Json number_json(const std::string& text) {
    return Json::parse(text);
}

}  // namespace

std::string sweep_table(const SweepPlan& plan, const std::vector<pipeline::Trial>& trials) {
    constexpr std::size_t least_width = 11;
    std::vector<std::string> titles;
    for (const SweptOption& option : plan.options)
        titles.push_back(option.name);
    titles.insert(titles.end(), {"buildings", "contours", "points", "rmse [m]", "seconds"});
    std::string text;
    const auto add_row = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            text += aligned(cells[i], std::max(least_width, titles[i].size() + 2));
        text += "\n";
    };
    add_row(titles);
    for (const pipeline::Trial& trial : trials)
        add_row(cells_of(trial));
    for (const pipeline::Saturation& found : pipeline::saturations(plan, trials))
        text +=
            "-" + found.option + " from " + found.first + " to " + found.last + " changes nothing here.\n";
    return text;
}

std::string sweep_json(const SweepPlan& plan, const std::vector<pipeline::Trial>& trials) {
    Json rows = Json::array();
    for (const pipeline::Trial& trial : trials) {
        Json row;
        for (std::size_t i = 0; i < plan.options.size(); ++i)
            row[plan.options[i].name] = number_json(trial.values[i]);
        row.update(Json{{"buildings", trial.report.buildings},
                        {"contours", trial.report.contours},
                        {"points", trial.report.vertices},
                        {"stack_rmse_m", trial.report.stack_rmse_m},
                        {"same_as_first", trial.digest == trials.front().digest},
                        {"seconds", trial.seconds}});
        rows.push_back(std::move(row));
    }
    Json unchanged = Json::object();
    for (const pipeline::Saturation& found : pipeline::saturations(plan, trials))
        unchanged[found.option] = Json::array({number_json(found.first), number_json(found.last)});
    return Json{{"trials", rows}, {"no_change", unchanged}}.dump(2) + "\n";
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
    writing::FileWriter file(writing::resolve_file_target(view::picture_target(options)));
    const writing::PictureFormat format = *writing::picture_format_of(options.write.preview);
    const int side = options.given.contains("preview_size")
                         ? options.write.preview_size
                         : std::max(options.write.preview_size, legible_side(plan.trials()));
    const view::SheetPlan sheet =
        view::plan_sheet(plan.trials(), plan.options.back().values.size(), side, view::page_words(options));
    const view::MapArea ground = view::map_area_of(options, sources.dem.info());
    const view::MapFrame frame(ground, view::map_size_on_sheet(ground, sheet));
    const auto first = std::make_shared<view::FirstOutlines>();
    std::vector<view::TrialPicture> pictures;
    const std::vector<pipeline::Trial> trials = pipeline::run_trials(
        options, sources, plan,
        [&](FeatureSink& discarded, const std::vector<std::string>& values) {
            return std::make_unique<TrialMap>(
                discarded, frame, format, first,
                [&pictures, caption = caption_of(values, plan)](view::MapPicture map) {
                    pictures.push_back({caption, std::move(map)});
                });
        },
        callbacks);
    file.write(view::draw_contact_sheet(pictures, sheet, format));
    file.prepare(commit);
    reader.prepare(trials);
    commit.publish([&] {
        if (callbacks.on_warning)
            std::ranges::for_each(file.take_warnings(), callbacks.on_warning);
        reader.show(trials);
    });
}

}  // namespace d2b
