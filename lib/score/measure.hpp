#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/sinks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/overlay.hpp"

namespace d2b::score {

/// A part of a whole; 0 if the whole is 0.
[[nodiscard]] double share(double part, double whole);
[[nodiscard]] double share(std::size_t part, std::size_t whole);

/// Median; the mean of the middle two of an even number. @param values not empty
[[nodiscard]] double median(std::vector<double> values);

// Units are those of the coordinates and their squares.

void translate(Polygons& polygons, double right, double up);

/// Area of the exterior minus interiors, whatever the orientation of rings.
[[nodiscard]] double area_of(const WorldPolygon& polygon);
[[nodiscard]] double area_of(std::span<const WorldPolygon> polygons);

/// Number of vertices of all rings. @param closing counts the repetition of the first position
[[nodiscard]] std::size_t vertex_count(std::span<const WorldPolygon> polygons, bool closing);

/// Rings as closed lines.
[[nodiscard]] std::vector<Polyline> rings_of(std::span<const WorldPolygon> polygons);

/// Plane in which areas and lengths are measured.
struct MeasurePlane {
    Crs crs;             ///< none: unknown units
    double metres = 1;   ///< metres per unit of the coordinates
    bool local = false;  ///< a projection centred on the data

    [[nodiscard]] std::string name() const {
        return local ? "local transverse Mercator projection" : crs.name();
    }
};

/// Returns the CRS itself if it is projected or local, or a transverse Mercator projection in metres centred
/// on `box` if it is geographic. Warns if there is no CRS, because units are then assumed to be metres.
/// @param box in the CRS @throws InputError if the CRS has no plane coordinates (e.g. a geocentric one)
[[nodiscard]] MeasurePlane measure_plane(const Crs& crs, const Box& box, Warnings& warnings);

/// Densifies long edges, because straight edges become curves in another CRS.
enum class LongEdges { keep, divide };

/// Transforms areas to the CRS of the plane, in place. If either side has no CRS, warns and keeps the
/// coordinates. @param name of the dataset, for messages
/// @throws OptionError, InputError if there is no operation or a position cannot be transformed
void transform_to(const MeasurePlane& plane, const Crs& from, const std::string& name,
                  std::span<Polygons> areas, LongEdges long_edges, Warnings& warnings);

[[nodiscard]] Box box_of_all(std::span<const Polygons> areas);

}  // namespace d2b::score
