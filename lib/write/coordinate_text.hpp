#pragma once

#include <array>
#include <string>

#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// Local coordinates as text, in metres, with all decimals that a step has, so that nothing is rounded and
/// what is straight stays straight. Where a step has too many, as in feet, with as many as tell neighbouring
/// steps apart sixteen times over, which adds next to nothing to the rounding of a reader's single precision.
class CoordinateText {
  public:
    explicit CoordinateText(const SurfaceFrame& frame);

    /// "12.3457 -3.2500 7.123"
    [[nodiscard]] std::string operator()(const SurfacePoint& point) const;

  private:
    SurfaceFrame frame_;
    std::array<double, 2> step_;   ///< of x and y, metres
    std::array<double, 2> shift_;  ///< of the point 0, 0 from the origin, metres
    int decimals_;                 ///< of x and y; heights are whole millimetres
};

/// With no more than so many decimals, without zeroes at the end: "0.5", "12".
[[nodiscard]] std::string short_text(double value, int decimals);

/// "84000 446000 -2", whole metres.
[[nodiscard]] std::string origin_text(const SurfaceFrame& frame);

}  // namespace d2b
