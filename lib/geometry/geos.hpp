#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// GEOS through its reentrant C API; one object per thread. Its messages become the text of exceptions.
class Geos {
  public:
    /// @param stop asked in the midst of what GEOS does as well, which then ends with a Cancelled
    explicit Geos(StopRequest stop = {});
    Geos(Geos&&) noexcept;
    Geos& operator=(Geos&&) noexcept;
    ~Geos();

    /// @return what makes the polygons invalid, with the place; "" where they are valid
    [[nodiscard]] std::string invalidity(const std::vector<WorldPolygon>& polygons);
    /// The polygonal part of GEOS's structural repair, which keeps the areas that are covered once. Oriented
    /// as WorldPolygon says. @throws GeometryError
    [[nodiscard]] std::vector<WorldPolygon> repaired(const std::vector<WorldPolygon>& polygons);
    /// The polygons with all corners on the multiples of a step, without what collapses there; valid.
    /// @throws GeometryError
    [[nodiscard]] std::vector<WorldPolygon> on_grid(const std::vector<WorldPolygon>& polygons, double step);
    /// Whether each of `inner` lies in `outer`, borders included, but for what rounding coordinates to
    /// doubles makes of corners on a border. @throws GeometryError
    [[nodiscard]] std::vector<bool> covered(const std::vector<WorldPolygon>& outer,
                                            const std::vector<std::vector<WorldPolygon>>& inner);
    /// Whether two share more than their borders, likewise. @throws GeometryError
    [[nodiscard]] bool overlap(const std::vector<WorldPolygon>& one, const std::vector<WorldPolygon>& other);
    /// `whole` less `parts`, which lie in it and share only whole edges or points with its rings and each
    /// other: then no new point arises, and the result is exact on the lattice. @throws GeometryError
    [[nodiscard]] std::vector<FinePolygon> difference(const FinePolygon& whole,
                                                      const std::vector<FinePolygon>& parts);
    /// The triangles of a polygon's constrained Delaunay triangulation, on its own corners.
    /// @throws GeometryError, also for some polygons with holes that are valid
    [[nodiscard]] std::vector<std::array<FinePoint, 3>> triangles(const FinePolygon& polygon);
    /// Area of what lies in `inner` and not in `outer`: 0 where they are nested exactly. @throws
    /// GeometryError
    [[nodiscard]] double area_outside(const WorldPolygon& inner, const WorldPolygon& outer);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Version of the library, e.g. "3.11.1".
[[nodiscard]] std::string geos_version();

}  // namespace d2b
