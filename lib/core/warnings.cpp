#include "core/warnings.hpp"

#include <algorithm>

namespace d2b {

void Warnings::tell(const std::string& text) {
    if (std::ranges::find(said_, text) != said_.end())
        return;
    said_.push_back(text);
    if (held_)
        waiting_.push_back(text);
    else if (listener_)
        listener_(text);
}

void Warnings::add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    tell(text);
}

void Warnings::add_library_message(std::string_view speaker, const std::string& line) {
    constexpr std::ptrdiff_t most = 20;
    const std::string prefix = std::string(speaker) + ": ";
    const std::lock_guard lock(mutex_);
    const auto quotes =
        std::ranges::count_if(said_, [&](const std::string& text) { return text.starts_with(prefix); });
    const std::string text = prefix + line + ".";
    if (std::ranges::find(said_, text) == said_.end())
        tell(quotes < most ? text : prefix + "further warnings are left out.");
}

void Warnings::hold() {
    const std::lock_guard lock(mutex_);
    held_ = true;
    listener_ = {};
}

std::vector<std::string> Warnings::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
}

}  // namespace d2b
