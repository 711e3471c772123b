#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plane.hpp"

namespace d2b::sample {

enum class Roof { flat, shed, gabled, hipped, cone, dome, mansard };
[[nodiscard]] std::string_view roof_name(Roof roof);

/// The slopes of a mansard roof break at this share of the way from the eave to the ridge, and at this share
/// of the rise.
inline constexpr double mansard_way = 0.3;
inline constexpr double mansard_rise = 0.7;

/// One wing, tower or storey set back: a rectangle in the building's frame and the roof over it. Heights in
/// metres above the building's ground. Where parts overlap, the higher one is seen.
struct RoofPart {
    Rect rect;
    Roof roof = Roof::flat;
    double eave = 0;
    double top = 0;             ///< of the ridge or peak; the eave's where the roof is flat
    bool ridge_along_x = true;  ///< gabled, hipped and mansard: the ridge; shed: the level line
};

/// The height of a part's roof over a point of its rectangle.
[[nodiscard]] double roof_height(const RoofPart& part, const Position& local);

/// A building as it is drawn, before it stands anywhere: corners in its own frame, in multiples of an eighth
/// of a metre where walls are shared.
struct Draft {
    std::string kind;
    WorldPolygon outline;
    std::vector<RoofPart> parts;
};

/// A building on the ground.
struct Building {
    std::int64_t id = 0;
    std::string kind;
    Frame frame;
    WorldPolygon footprint;       ///< scene coordinates
    std::vector<RoofPart> parts;  ///< in the frame
    double ground = 0;            ///< elevation in metres, at the middle of the box around the outline
    double width = 0;             ///< metres, of that box, along the frame's x axis
    double length = 0;            ///< along its y axis

    [[nodiscard]] double eave() const;                ///< lowest eave, metres above ground
    [[nodiscard]] double top() const;                 ///< highest point, metres above ground
    [[nodiscard]] const RoofPart& main_part() const;  ///< the largest one
    /// Elevation of the roof in metres; empty outside the footprint.
    [[nodiscard]] std::optional<double> elevation_at(const Position& p) const;
};

}  // namespace d2b::sample
