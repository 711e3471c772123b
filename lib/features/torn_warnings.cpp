#include "features/torn_warnings.hpp"

#include "features/target_frame.hpp"

namespace d2b {
namespace {

constexpr std::int64_t most_torn_named = 10;

}  // namespace

void TornWarnings::note(const std::string& kind, std::int64_t id, const FeaturePolygon& made) {
    if (!made.torn || ++count_ > most_torn_named)
        return;
    names_ += (names_.empty() ? "" : ", ") + kind + " " + std::to_string(id);
}

void TornWarnings::finish(const std::string& target, Context& context) const {
    if (count_ == 0)
        return;
    const RunReport& report = context.report;
    if (report.buildings + report.contours + report.doubtful == 0)
        throw torn_apart(report.input, target);
    std::string text =
        count_ == 1 ? "1 feature is left out, which '" + target + "' tears apart"
                    : std::to_string(count_) + " features are left out, which '" + target + "' tears apart";
    text += " or stretches beyond use: " + names_;
    if (count_ > most_torn_named)
        text += " and " + std::to_string(count_ - most_torn_named) + " more";
    context.warn(text + "; choose a -t_srs that is made for the area to have them.");
}

}  // namespace d2b
