#include "dem2buildings/sweep.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/number_text.hpp"
#include "pipeline/preview.hpp"
#include "preview/contact_sheet.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t width = 11;

std::string aligned(const std::string& text) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string fixed(double value) {
    std::array<char, 32> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 2);
    return {text.data(), end};
}

}  // namespace

std::string sweep_table(const std::vector<Trial>& trials) {
    std::string text;
    for (const char* title :
         {"lod", "nf", "detail", "buildings", "contours", "points", "rmse [m]", "seconds"})
        text += aligned(title);
    for (const Trial& trial : trials) {
        const RunReport& report = trial.report;
        text += "\n" + aligned(std::to_string(trial.values.lod)) +
                aligned(std::to_string(trial.values.noise_factor)) +
                aligned(number_text(trial.values.detail)) + aligned(std::to_string(report.buildings)) +
                aligned(std::to_string(report.contours)) + aligned(std::to_string(report.vertices)) +
                aligned(fixed(report.stack_rmse_m)) + aligned(fixed(trial.seconds));
    }
    return text + "\n";
}

std::string sweep_json(const std::vector<Trial>& trials) {
    Json rows = Json::array();
    for (const Trial& trial : trials)
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

std::vector<Trial> run_sweep(const Options& options, const Sources& sources, const SweepPlan& plan,
                             const Callbacks& callbacks) {
    if (options.write.preview.empty())
        return run_trials(options, sources, plan, {}, callbacks);
    constexpr int sheet_width = 2400;
    constexpr int least = 160;
    constexpr int most = 800;
    const std::unique_ptr<PictureFile> file = open_picture(picture_target(options));
    const int columns = static_cast<int>(std::max<std::size_t>(plan.noise_factors.size(), 1));
    std::vector<Image> pictures;
    std::vector<Trial> trials = run_trials(
        options, sources, plan,
        [&](FeatureSink& nothing, DemSource& dem, const TrialValues& values) {
            std::string heading =
                "lod " + std::to_string(values.lod) + " nf " + std::to_string(values.noise_factor);
            if (!plan.details.empty())
                heading += " detail " + number_text(values.detail);
            PreviewLook look = look_of(options, dem.info(), heading);
            look.longest = std::clamp(sheet_width / columns, least, most);
            return std::make_unique<PreviewSink>(nothing, dem, crs_of(options, dem.info()), look,
                                                 [&](const Image& image) { pictures.push_back(image); });
        },
        callbacks);
    file->write(contact_sheet(pictures, columns));
    file->publish();
    if (callbacks.on_warning)
        std::ranges::for_each(file->take_warnings(), callbacks.on_warning);
    return trials;
}

}  // namespace d2b
