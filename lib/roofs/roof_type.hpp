#pragma once

#include <limits>
#include <span>
#include <string_view>

namespace d2b::roofs {

/// Slope in degrees below which a face is flat.
inline constexpr double flat_degrees = 8;

/// Face as far as the type of its roof depends on it.
struct FaceShape {
    double area = 0;
    double slope = 0;    ///< degrees
    double azimuth = 0;  ///< degrees in which water runs; any if flat
    double taper = 1;    ///< length near its top as a share of the longest one below: a hip ends in a point
    bool doubtful = false;  ///< drawn level, as no plane can be trusted
    double low = 0;         ///< elevation of its lowest corner, in m
    double high = 0;
    double top = std::numeric_limits<double>::infinity();  ///< length of its upper end, in m
};

/// Name of the type of a roof: flat, shed, gabled, hipped, pyramidal, mansard, domed, complex or unknown.
/// @param roundness of the footprint: 4 pi times its area by the square of its perimeter, 1 for a circle
/// @param cell side of a cell in m; the ridge of a pyramidal roof is not longer than that, or than 1 m
[[nodiscard]] std::string_view roof_type(std::span<const FaceShape> faces, double roundness, double cell);

}  // namespace d2b::roofs
