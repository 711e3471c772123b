#pragma once

#include <span>
#include <string>
#include <vector>

#include "building.hpp"

namespace d2b::sample {

/// Properties that the roofs of a draft share. Heights in metres above ground.
struct RoofStyle {
    Roof roof = Roof::flat;
    double eave = 6;
    double pitch = 0.8;  ///< rise per metre from the eave towards the ridge
};

[[nodiscard]] WorldPolygon rectangle(const Rect& rect);
/// 64 corners on the circle; found with square roots alone.
[[nodiscard]] WorldPolygon circle(const Position& centre, double radius);

/// The roof of a wing, its ridge along the longer side.
[[nodiscard]] RoofPart wing(const Rect& rect, const RoofStyle& style);

[[nodiscard]] Draft box_house(std::string kind, const Rect& rect, const RoofStyle& style);
/// Wings of the given width along the left and the bottom side of a box.
[[nodiscard]] Draft l_house(std::string kind, const Rect& box, double wing_width, const RoofStyle& style);
/// Wings along the left, bottom and right side.
[[nodiscard]] Draft u_house(std::string kind, const Rect& box, double wing_width, const RoofStyle& style);
/// Wings along the left and right side and a bar between their middles.
[[nodiscard]] Draft h_house(std::string kind, const Rect& box, double wing_width, const RoofStyle& style);
/// Four wings around a courtyard.
[[nodiscard]] Draft court_house(std::string kind, const Rect& box, double wing_width, const RoofStyle& style);
/// @param rise of a cone or dome; 0 for a flat top
[[nodiscard]] Draft round_house(std::string kind, const Position& centre, double radius,
                                const RoofStyle& style, double rise);

/// Adds to every outline the corners of the others that lie on its walls, so that houses that touch have the
/// same vertices along the shared wall. Walls must be parallel to the axes; coordinates are compared exactly.
void join_shared_walls(std::span<Draft> drafts);

}  // namespace d2b::sample
