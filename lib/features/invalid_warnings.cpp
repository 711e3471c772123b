#include "features/invalid_warnings.hpp"

namespace d2b {
namespace {

constexpr std::int64_t most_by_id = 10;

std::string outcome(const FeaturePolygon& made) {
    if (made.parts.empty())
        return "it is not written";
    return made.status == OutlineStatus::repaired ? "it is written repaired"
                                                  : "it is written as it was traced";
}

}  // namespace

void InvalidWarnings::note(const std::string& kind, std::int64_t id, const FeaturePolygon& made) {
    if (made.trouble.empty() || ++count_ > most_by_id)
        return;
    context_.warn(kind + " " + std::to_string(id) + " would not have been a valid polygon (" + made.trouble +
                  "); " + outcome(made) + ".");
}

void InvalidWarnings::finish() {
    if (count_ > most_by_id)
        context_.warn(std::to_string(count_ - most_by_id) +
                      " more features would not have been valid polygons; -write_rejected writes them all, "
                      "with the reason.");
}

}  // namespace d2b
