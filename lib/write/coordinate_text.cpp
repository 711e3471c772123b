#include "write/coordinate_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/number_text.hpp"

namespace d2b {
namespace {

constexpr int millimetres = 3;

}  // namespace

std::string short_text(double value, int decimals) {
    std::string number = fixed_text(value, decimals);
    if (decimals > 0)
        number.erase(number.find_last_not_of('0') + 1);
    if (number.ends_with('.'))
        number.pop_back();
    return number == "-0" ? "0" : number;
}

CoordinateText::CoordinateText(const SurfaceFrame& frame) : frame_(frame) {
    constexpr double parts = 16;  // of a step
    const double step = std::min(frame.scale[0], frame.scale[1]) * frame.horizontal_metres;
    decimals_ = std::clamp(static_cast<int>(std::ceil(-std::log10(step / parts))), 0, 12);
}

std::string CoordinateText::operator()(const SurfacePoint& point) const {
    const std::array<double, 3> at = frame_.local(point);
    return short_text(at[0], decimals_) + " " + short_text(at[1], decimals_) + " " +
           short_text(at[2], millimetres);
}

std::string origin_text(const SurfaceFrame& frame) {
    std::string text;
    for (const double metres : frame.origin)
        text += (text.empty() ? "" : " ") + short_text(metres, 0);
    return text;
}

}  // namespace d2b
