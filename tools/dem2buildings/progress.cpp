#include "dem2buildings/progress.hpp"

#include <algorithm>
#include <cstdint>
#include <ostream>

namespace d2b {
namespace {

constexpr int all_ticks = 40;

/// "1,234 buildings"
std::string counted(std::int64_t n, const std::string& noun) {
    std::string digits = std::to_string(n);
    for (std::size_t comma = digits.size(); comma > 3;) {
        comma -= 3;
        digits.insert(comma, ",");
    }
    return digits + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace

TerminalProgress::~TerminalProgress() {
    if (ticks_ >= 0 && ticks_ < all_ticks)
        out_ << std::endl;
}

void TerminalProgress::update(double share) {
    const int ticks = static_cast<int>(std::clamp(share, 0.0, 1.0) * all_ticks);
    while (ticks_ < ticks) {
        ++ticks_;
        if (ticks_ % 4 == 0)
            out_ << ticks_ / 4 * 10;
        else
            out_ << '.';
        if (ticks_ == all_ticks)
            out_ << " - done.\n";
    }
    out_.flush();
}

std::string summary(const RunReport& report, Layers layers, const std::string& destination) {
    std::string text;
    if (layers != Layers::contours)
        text = counted(report.buildings, "building");
    if (layers != Layers::buildings)
        text += (text.empty() ? "" : " and ") + counted(report.contours, "contour");
    return text + " in " + destination + "\n";
}

}  // namespace d2b
