#include "dem2buildings/progress.hpp"

#include <algorithm>
#include <cstdint>
#include <ostream>

namespace d2b {
namespace {

constexpr int all_ticks = 40;

/// "1,234"
std::string grouped(std::int64_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t comma = digits.size(); comma > 3;) {
        comma -= 3;
        digits.insert(comma, ",");
    }
    return digits;
}

/// "1,234 buildings"
std::string counted(std::int64_t n, const std::string& noun) {
    return grouped(n) + " " + noun + (n == 1 ? "" : "s");
}

/// What options left out, or "".
std::string left_out(const RunReport& report) {
    const std::int64_t small = report.counted(Reason::building_small) + report.counted(Reason::contour_small);
    const std::int64_t low = report.counted(Reason::building_low);
    const std::int64_t doubtful = report.counted(Reason::building_doubtful) - report.doubtful;
    std::string text;
    const auto add = [&text](std::int64_t n, const char* why) {
        if (n > 0)
            text += (text.empty() ? " (left out: " : ", ") + grouped(n) + why;
    };
    add(small, " below -min_area");
    add(low, " below -min_height");
    add(doubtful, " below -min_confidence");
    return text.empty() ? text : text + ")";
}

}  // namespace

TerminalProgress::~TerminalProgress() {
    if (line_is_open())
        out_ << std::endl;
}

bool TerminalProgress::line_is_open() const {
    return line_begun_ && ticks_ < all_ticks;
}

void TerminalProgress::update(double share) {
    const std::lock_guard lock(mutex_);
    const int ticks = static_cast<int>(std::clamp(share, 0.0, 1.0) * all_ticks);
    while (ticks_ < ticks) {
        ++ticks_;
        line_begun_ = true;
        if (ticks_ % 4 == 0)
            out_ << ticks_ / 4 * 10;
        else
            out_ << '.';
        if (ticks_ == all_ticks)
            out_ << " - done.\n";
    }
    out_.flush();
}

void TerminalProgress::interrupt(bool shared, const std::function<void()>& say) {
    const std::lock_guard lock(mutex_);
    if (shared && line_is_open()) {
        out_ << std::endl;
        line_begun_ = false;
    }
    say();
}

std::string summary(const RunReport& report, Layers layers, const std::string& destination) {
    std::string text;
    if (layers != Layers::contours)
        text = counted(report.buildings, "building");
    if (layers != Layers::buildings)
        text += (text.empty() ? "" : " and ") + counted(report.contours, "contour");
    return text + " in " + destination + left_out(report) + "\n";
}

}  // namespace d2b
