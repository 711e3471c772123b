#include "write/coordinate_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace d2b {
namespace {

/// Zeroes at the end are left out: "0.5", "12".
void append_fixed(double value, int decimals, std::string& text) {
    std::array<char, 400> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals)
            .ptr;
    std::string number(buffer.data(), end);
    if (decimals > 0)
        number.erase(number.find_last_not_of('0') + 1);
    if (number.ends_with('.'))
        number.pop_back();
    text += number == "-0" ? "0" : number;
}

}  // namespace

CoordinateText::CoordinateText(const SurfaceFrame& frame) : frame_(frame) {
    constexpr double parts = 16;  // of a step
    const double step = std::min(frame.scale[0], frame.scale[1]) * frame.horizontal_metres;
    decimals_ = std::clamp(static_cast<int>(std::ceil(-std::log10(step / parts))), 0, 12);
}

std::string CoordinateText::operator()(const SurfacePoint& point) const {
    constexpr int millimetres = 3;
    const std::array<double, 3> at = frame_.local(point);
    std::string text;
    append_fixed(at[0], decimals_, text);
    text += ' ';
    append_fixed(at[1], decimals_, text);
    text += ' ';
    append_fixed(at[2], millimetres, text);
    return text;
}

std::string origin_text(const SurfaceFrame& frame) {
    std::string text;
    for (const double metres : frame.origin) {
        text += text.empty() ? "" : " ";
        append_fixed(metres, 0, text);
    }
    return text;
}

}  // namespace d2b
