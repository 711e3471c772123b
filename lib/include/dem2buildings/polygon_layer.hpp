#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// A feature with polygons.
struct PolygonFeature {
    std::vector<WorldPolygon> polygons;  ///< rings run as they ran in the file
    std::optional<double> height;        ///< of the field that was asked for; nothing where it is NULL
    bool open_ring = false;              ///< a ring did not end where it began; it is closed here
};

/// A layer of polygons, with all of it in memory.
struct PolygonLayer {
    std::string dataset;  ///< as the user gave it
    std::string name;
    std::string crs_wkt;       ///< WKT2:2019, empty where there is none
    std::string height_field;  ///< that was found; "" where there is none
    std::vector<PolygonFeature> features;
};

}  // namespace d2b
