#pragma once

#include <span>
#include <string>

#include "core/crs.hpp"
#include "core/warnings.hpp"
#include "geometry/box.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/overlay.hpp"

namespace d2b {

/// The plane in which areas and lengths are measured.
struct MeasurePlane {
    Crs crs;             ///< none: plain units
    double metres = 1;   ///< in one unit of the coordinates
    bool local = false;  ///< a projection of our own about the middle of what is measured
};

/// The CRS itself where it is a projected or a local one; about the middle of `box`, a transverse Mercator
/// projection in metres where it is geographic. Warns where there is no CRS: its units are taken as metres.
/// @param box in the CRS @throws InputError where the CRS has no plane coordinates (a geocentric one, say)
[[nodiscard]] MeasurePlane measure_plane(const Crs& crs, const Box& box, Warnings& warnings);

/// Whether edges get vertices where they are long, since they bend on the way.
enum class LongEdges { keep, divide };

/// Areas from one CRS to that of the plane, in place. Coordinates without a CRS, or for a plane without one,
/// stay as they are, with a warning. @param name of what is brought, for messages
/// @throws OptionError, InputError: no operation, or a position without an image
void bring_to(const MeasurePlane& plane, const Crs& from, const std::string& name, std::span<Polygons> areas,
              LongEdges long_edges, Warnings& warnings);

[[nodiscard]] Box box_of_all(std::span<const Polygons> areas);

}  // namespace d2b
