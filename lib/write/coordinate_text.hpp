#pragma once

#include <array>
#include <string>

#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// Formats local coordinates in metres with all decimals of a step, so that nothing is rounded and straight
/// edges stay straight. If a step has too many decimals, as in feet, uses enough to resolve 1/16 of a step;
/// this adds almost nothing to the rounding of readers in single precision.
class CoordinateText {
  public:
    explicit CoordinateText(const SurfaceFrame& frame);

    /// Returns for example "12.3457 -3.2500 7.123".
    [[nodiscard]] std::string operator()(const SurfacePoint& point) const;

  private:
    SurfaceFrame frame_;
    std::array<double, 2> step_;   ///< x and y, metres
    std::array<double, 2> shift_;  ///< offset of the point 0, 0 from the origin, metres
    int decimals_;                 ///< decimals of x and y; heights are whole millimetres
};

/// Formats a value with at most `decimals` decimals and without trailing zeros: "0.5", "12".
[[nodiscard]] std::string short_text(double value, int decimals);

/// Returns whole metres, for example "84000 446000 -2".
[[nodiscard]] std::string origin_text(const SurfaceFrame& frame);

}  // namespace d2b
