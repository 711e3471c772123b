#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "geometry/geos_handles.hpp"

namespace d2b {

/// Plain polygons into GEOS and back, in a context of its own; one object per thread. Polygons are
/// WorldPolygon, or FinePolygon with the columns as x and the rows as -y; both come back oriented as they
/// say.
class GeosPolygons {
  public:
    /// @param stop asked between rings, and where GEOS gives up
    explicit GeosPolygons(StopRequest stop = {});
    GeosPolygons(const GeosPolygons&) = delete;
    GeosPolygons& operator=(const GeosPolygons&) = delete;
    ~GeosPolygons() = default;

    [[nodiscard]] GEOSContextHandle_t context() const { return context_.get(); }
    [[nodiscard]] const StopRequest& stop() const { return stop_; }

    /// @param geometry what a function of GEOS returned @throws GeometryError, Cancelled where it is null
    [[nodiscard]] GeometryPtr own(GEOSGeometry* geometry) const;
    /// The answer of a predicate. @throws GeometryError, Cancelled where it failed
    [[nodiscard]] bool answer(char value) const;

    /// @param what "on a polygon", before GEOS's message @throws GeometryError, Cancelled where that is the
    /// reason
    [[noreturn]] void fail(const char* what) const;

    /// @param polygon rings of at least three finite points @throws GeometryError, Cancelled
    template <typename Polygon>
    [[nodiscard]] GeometryPtr polygon(const Polygon& polygon) const;
    /// A MultiPolygon. @param polygons a list of such @throws GeometryError, Cancelled
    template <typename List>
    [[nodiscard]] GeometryPtr multi_polygon(const List& polygons) const;
    /// The rings as lines. @throws GeometryError, Cancelled
    [[nodiscard]] GeometryPtr multi_line(std::span<const WorldPolygon> polygons) const;

    /// The polygons of a geometry of any type.
    /// @throws GeometryError where a vertex of a FinePolygon would not be whole
    template <typename Polygon>
    [[nodiscard]] std::vector<Polygon> polygons_of(const GEOSGeometry* geometry) const;
    /// The lines of a geometry of any type.
    [[nodiscard]] std::vector<std::vector<Position>> lines_of(const GEOSGeometry* geometry) const;

  private:
    template <typename Point>
    [[nodiscard]] GeometryPtr ring(const std::vector<Point>& points) const;
    [[nodiscard]] GeometryPtr collection(int type, std::vector<GeometryPtr> parts) const;
    template <typename Point>
    [[nodiscard]] std::vector<Point> points_of(const GEOSGeometry* line) const;

    StopRequest stop_;
    std::string message_;
    ContextPtr context_;
};

}  // namespace d2b
