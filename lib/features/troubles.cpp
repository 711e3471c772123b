#include "features/troubles.hpp"

namespace d2b {
namespace {

constexpr std::int64_t most_by_id = 10;

std::string outcome(const Placed& placed) {
    if (placed.parts.empty())
        return "it is not written";
    return placed.status == OutlineStatus::repaired ? "it is written repaired"
                                                    : "it is written as it was traced";
}

}  // namespace

void Troubles::note(const std::string& kind, std::int64_t id, const Placed& placed) {
    if (placed.trouble.empty() || ++count_ > most_by_id)
        return;
    context_.warn(kind + " " + std::to_string(id) + " would not have been a valid polygon (" +
                  placed.trouble + "); " + outcome(placed) + ".");
}

void Troubles::finish() {
    if (count_ > most_by_id)
        context_.warn(
            std::to_string(count_ - most_by_id) +
            " more features would not have been valid polygons; -write_rejected writes them all, with what "
            "became of them.");
}

}  // namespace d2b
