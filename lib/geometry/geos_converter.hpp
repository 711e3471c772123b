#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <geos_c.h>

#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Frees a GEOS object with the context that created it. Takes two pointers, without an indirect call.
struct GeometryDeleter {
    GEOSContextHandle_t context = nullptr;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using GeometryPtr = std::unique_ptr<GEOSGeometry, GeometryDeleter>;

struct PreparedDeleter {
    GEOSContextHandle_t context = nullptr;
    void operator()(const GEOSPreparedGeometry* geometry) const {
        GEOSPreparedGeom_destroy_r(context, geometry);
    }
};
using PreparedPtr = std::unique_ptr<const GEOSPreparedGeometry, PreparedDeleter>;

struct ContextDeleter {
    void operator()(GEOSContextHandle_t context) const { GEOS_finish_r(context); }
};
using ContextPtr = std::unique_ptr<GEOSContextHandle_HS, ContextDeleter>;

/// Converts polygons to GEOS geometries and back, in a context of its own; one object per thread. Polygons
/// are WorldPolygon, or FinePolygon with x = column and y = -row; both come back with their own orientation.
class GeosConverter {
  public:
    /// @param stop checked between rings and after failures of GEOS
    explicit GeosConverter(StopToken stop = {});
    GeosConverter(const GeosConverter&) = delete;
    GeosConverter& operator=(const GeosConverter&) = delete;
    ~GeosConverter() = default;

    [[nodiscard]] GEOSContextHandle_t context() const { return context_.get(); }
    [[nodiscard]] const StopToken& stop() const { return stop_; }

    /// Takes ownership. @param geometry return value of GEOS @throws GeometryError, Cancelled if it is null
    [[nodiscard]] GeometryPtr wrap(GEOSGeometry* geometry) const;
    /// Result of a predicate. @throws GeometryError, Cancelled if it failed
    [[nodiscard]] bool predicate(char value) const;

    /// Throws after a failure of GEOS. @param what e.g. "on a polygon", precedes GEOS's message @throws
    /// GeometryError, or Cancelled if a stop was requested
    [[noreturn]] void fail(const char* what) const;

    /// @param polygon rings of at least three finite points @throws GeometryError, Cancelled
    template <typename Polygon>
    [[nodiscard]] GeometryPtr polygon(const Polygon& polygon) const;
    /// Creates a MultiPolygon. @param polygons a list of polygons as above @throws GeometryError, Cancelled
    template <typename List>
    [[nodiscard]] GeometryPtr multi_polygon(const List& polygons) const;
    /// Creates a LinearRing. @throws GeometryError, Cancelled
    [[nodiscard]] GeometryPtr line_ring(const WorldRing& points) const;
    /// Creates a MultiLineString of the rings. @throws GeometryError, Cancelled
    [[nodiscard]] GeometryPtr multi_line(std::span<const WorldPolygon> polygons) const;

    /// Creates a MultiLineString of segments. @throws GeometryError, Cancelled
    [[nodiscard]] GeometryPtr multi_line(std::span<const FineSegment> segments) const;

    /// Extracts the polygons of any geometry.
    /// @throws GeometryError if a vertex of a FinePolygon is not an integer
    template <typename Polygon>
    [[nodiscard]] std::vector<Polygon> polygons_of(const GEOSGeometry* geometry) const;
    /// Extracts the lines of any geometry.
    [[nodiscard]] std::vector<std::vector<Position>> lines_of(const GEOSGeometry* geometry) const;

  private:
    template <typename Point>
    [[nodiscard]] GeometryPtr ring(const std::vector<Point>& points) const;
    [[nodiscard]] GeometryPtr collection(int type, std::vector<GeometryPtr> parts) const;
    template <typename Point>
    [[nodiscard]] std::vector<Point> points_of(const GEOSGeometry* line) const;

    StopToken stop_;
    std::string message_;
    ContextPtr context_;
};

}  // namespace d2b
