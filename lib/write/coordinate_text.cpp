#include "write/coordinate_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/number_text.hpp"

namespace d2b {
namespace {

constexpr int millimetres = 3;
constexpr int most_decimals = 12;

/// True if `decimals` decimals represent the step exactly.
bool has_no_more(double step, int decimals) {
    const double units = step * std::pow(10, decimals);
    return units >= 1 && std::abs(units - std::round(units)) < 1e-9;
}

int decimals_of(const std::array<double, 2>& steps) {
    for (int decimals = 0; decimals <= most_decimals; ++decimals)
        if (has_no_more(steps[0], decimals) && has_no_more(steps[1], decimals))
            return decimals;
    constexpr double parts = 16;  // parts per step
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::min(steps[0], steps[1]) / parts))), 0,
                      most_decimals);
}

/// Rounds to a micrometre, because raster corners are not known more precisely.
double to_micrometre(double metres) {
    return std::round(metres * 1e6) / 1e6;
}

}  // namespace

std::string short_text(double value, int decimals) {
    std::string number = fixed_text(value, decimals);
    if (decimals > 0)
        number.erase(number.find_last_not_of('0') + 1);
    if (number.ends_with('.'))
        number.pop_back();
    return number == "-0" ? "0" : number;
}

CoordinateText::CoordinateText(const SurfaceFrame& frame)
    : frame_(frame),
      step_{frame.scale[0] * frame.horizontal_metres, frame.scale[1] * frame.horizontal_metres},
      shift_{to_micrometre(frame.translate[0] * frame.horizontal_metres - frame.origin[0]),
             to_micrometre(frame.translate[1] * frame.horizontal_metres - frame.origin[1])},
      decimals_(decimals_of(step_)) {}

std::string CoordinateText::operator()(const SurfacePoint& point) const {
    return short_text(shift_[0] + static_cast<double>(point.x) * step_[0], decimals_) + " " +
           short_text(shift_[1] + static_cast<double>(point.y) * step_[1], decimals_) + " " +
           short_text(frame_.local(point)[2], millimetres);
}

std::string origin_text(const SurfaceFrame& frame) {
    std::string text;
    for (const double metres : frame.origin)
        text += (text.empty() ? "" : " ") + short_text(metres, 0);
    return text;
}

}  // namespace d2b
