#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Validity, repair and predicates of GEOS, through its reentrant C API; one object per thread. Unlike
/// Overlay, all calls can be cancelled. Error messages of GEOS become the text of exceptions:
///
///     Geos geos(stop);
///     if (!geos.invalidity(polygons).empty())
///         polygons = geos.repaired(polygons);
class Geos {
  public:
    /// @param stop also checked inside GEOS's algorithms, which then throw Cancelled
    explicit Geos(StopToken stop = {});
    Geos(Geos&&) noexcept;
    Geos& operator=(Geos&&) noexcept;
    ~Geos();

    /// @return reason and position if the polygons are invalid; "" if they are valid
    [[nodiscard]] std::string invalidity(const std::vector<WorldPolygon>& polygons);
    /// Polygonal part of GEOSMakeValid with the structure method. Oriented as WorldPolygon requires.
    /// @throws GeometryError
    [[nodiscard]] std::vector<WorldPolygon> repaired(const std::vector<WorldPolygon>& polygons);
    /// Rounds all corners to multiples of `step` and removes collapsed parts; the result is valid.
    /// @throws GeometryError
    [[nodiscard]] std::vector<WorldPolygon> snap_to_grid(const std::vector<WorldPolygon>& polygons,
                                                         double step);
    /// True if the interiors intersect, up to rounding errors. @throws GeometryError
    [[nodiscard]] bool overlap(const std::vector<WorldPolygon>& one, const std::vector<WorldPolygon>& other);
    /// Subtracts `parts`, which lie in `whole` and share only whole edges or points with its rings and each
    /// other. This is exact on the lattice because no new vertices arise. @throws GeometryError
    [[nodiscard]] std::vector<FinePolygon> difference(const FinePolygon& whole,
                                                      const std::vector<FinePolygon>& parts);
    /// Divides a polygon by lines: the faces of the arrangement of its rings and the lines that lie in it.
    /// Crossings are rounded to the lattice (snap rounding), so faces share their corners exactly and rings
    /// of the polygon move by less than a step. Lines that end inside a face have no effect.
    /// @throws GeometryError
    [[nodiscard]] std::vector<FinePolygon> divide(const FinePolygon& whole,
                                                  const std::vector<FineSegment>& lines);
    /// Polygons bounded by edges that meet in their ends only. @throws GeometryError
    [[nodiscard]] std::vector<FinePolygon> polygonize(const std::vector<FineSegment>& edges);
    /// Constrained Delaunay triangulation of the corners of a polygon.
    /// @throws GeometryError, also for some valid polygons with holes
    [[nodiscard]] std::vector<std::array<FinePoint, 3>> triangles(const FinePolygon& polygon);
    /// Area of `inner` minus `outer`; 0 if they are exactly nested. @throws GeometryError
    [[nodiscard]] double area_outside(const WorldPolygon& inner, const WorldPolygon& outer);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Version of the library, e.g. "3.11.1".
[[nodiscard]] std::string geos_version();

}  // namespace d2b
