#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem2buildings/feature_sink.hpp"
#include "geometry/geos_handles.hpp"

namespace d2b {

/// Plain polygons into GEOS and back, in a context of its own; one object a thread.
class GeosPolygons {
  public:
    GeosPolygons();
    GeosPolygons(const GeosPolygons&) = delete;
    GeosPolygons& operator=(const GeosPolygons&) = delete;
    ~GeosPolygons() = default;

    [[nodiscard]] GEOSContextHandle_t context() const { return context_.get(); }
    /// @param geometry what a function of GEOS returned @throws Error with GEOS's message where it is null
    [[nodiscard]] GeometryPtr own(GEOSGeometry* geometry) const;
    /// The answer of a predicate. @throws Error with GEOS's message where it failed
    [[nodiscard]] bool answer(char value) const;

    /// A MultiPolygon. @param polygons rings of at least three finite positions @throws Error
    [[nodiscard]] GeometryPtr multi_polygon(std::span<const WorldPolygon> polygons) const;
    /// The rings as lines. @throws Error
    [[nodiscard]] GeometryPtr multi_line(std::span<const WorldPolygon> polygons) const;
    /// The polygons of a geometry of any type.
    [[nodiscard]] std::vector<WorldPolygon> polygons_of(const GEOSGeometry* geometry) const;
    /// The lines of a geometry of any type.
    [[nodiscard]] std::vector<std::vector<Position>> lines_of(const GEOSGeometry* geometry) const;

  private:
    [[nodiscard]] GeometryPtr ring(const WorldRing& points) const;
    [[nodiscard]] GeometryPtr polygon(const WorldPolygon& polygon) const;
    [[nodiscard]] GeometryPtr collection(int type, std::vector<GeometryPtr> parts) const;
    [[nodiscard]] std::vector<Position> positions(const GEOSGeometry* line) const;

    std::string message_;
    ContextPtr context_;
};

}  // namespace d2b
