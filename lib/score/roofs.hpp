#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"

namespace d2b::score {

/// Elevation in metres over positions relative to an origin.
struct RoofPlane {
    Position origin;
    double elevation = 0;  ///< at the origin
    double east = 0;       ///< rise per unit of x
    double north = 0;      ///< rise per unit of y

    [[nodiscard]] double at(const Position& p) const {
        return elevation + east * (p.x - origin.x) + north * (p.y - origin.y);
    }
};

/// The plane with the least squares of vertical distances from vertices; level if they lie on a line.
/// @param area not empty @param elevations one per vertex, ring by ring, in metres
[[nodiscard]] RoofPlane fitted_plane(const Polygons& area, std::span<const double> elevations);

/// One plane of a roof.
struct RoofFace {
    Polygons area;  ///< valid
    RoofPlane plane;
    std::optional<double> slope;    ///< degrees
    std::optional<double> azimuth;  ///< degrees clockwise from the y axis
};

/// A building and the form of its roof.
struct TypedBuilding {
    Polygons area;  ///< valid
    std::string type;
};

/// All in one plane.
struct RoofSide {
    std::vector<RoofFace> faces;
    std::vector<TypedBuilding> buildings;
};

struct RoofScoreOptions {
    std::optional<Polygons>
        region;         ///< faces and buildings of the reference and found faces are clipped to it
    double metres = 1;  ///< metres per unit of the coordinates
    double min_object_m2 = 50;
    double level_below_deg = 8;  ///< less steep faces are level: they have no azimuth
    double slope_deg = 5;
    double azimuth_deg = 10;
    double height_m = 1;
    double match_iou = 0.5;
};

/// Scores found planes of roofs against a reference. Faces are overlaid exactly, and the part of an overlap
/// where elevations are near is cut out along straight lines, because the difference of two planes is one.
/// An area on which faces of one side overlap counts for each of them. @throws Error if GEOS fails
[[nodiscard]] RoofScore score_roofs(const RoofSide& found, const RoofSide& reference,
                                    const RoofScoreOptions& options);

}  // namespace d2b::score
