#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/int128.hpp"
#include "dem2buildings/surfaces.hpp"

namespace d2b::surface {

/// Fault of surfaces that stand side by side, with corners of equal coordinates taken for one; ""
/// if there is none:
/// - every corner of a part is used, and no two are equal;
/// - every directed edge is passed once, and once the other way;
/// - around each corner faces follow each other in one circle;
/// - no triangle is flat, roofs look up, grounds look down, walls are upright.
/// @param slanted true if roofs need not be level
[[nodiscard]] std::string fault_of(std::span<const SurfacePart> parts, bool slanted = false);

/// Six times the volume that faces or triangles enclose, in steps; positive where they look outwards.
[[nodiscard]] Int128 six_volumes(std::span<const SurfacePart> parts);
/// Twice the area of faces of a kind as seen from above.
[[nodiscard]] Int128 twice_plan_area(std::span<const SurfacePart> parts, FaceKind kind);

}  // namespace d2b::surface
