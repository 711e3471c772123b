#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "building.hpp"

namespace d2b::sample {

struct RoofCorner {
    Position at;           ///< scene coordinates
    double elevation = 0;  ///< metres
};

/// A visible piece of one plane of a roof.
struct RoofFace {
    std::vector<std::vector<RoofCorner>> rings;  ///< the exterior counter-clockwise, then the holes
    double slope = 0;                            ///< degrees
    std::optional<double> azimuth;  ///< direction in which water runs, in degrees clockwise from the y axis;
                                    ///< empty below 8 degrees
};

/// The planes of a building's roof as they are seen from above. They cover the footprint without a gap or an
/// overlap. Pieces of one plane that touch along a line are one face. None for a building with a cone or a
/// dome. @throws OutputError if GEOS fails
[[nodiscard]] std::vector<RoofFace> roof_faces(const Building& building);

/// Form of the roof of the largest part: flat, shed, gabled, hipped, pyramidal (hipped with a ridge of at
/// most 1 m), mansard, domed (a cone or a dome).
[[nodiscard]] std::string_view roof_type(const Building& building);

}  // namespace d2b::sample
