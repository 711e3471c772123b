#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "surface/extrude.hpp"
#include "surface/triangulate.hpp"

namespace d2b {

/// A surface of polygons. @param ids of the buildings, by their places
[[nodiscard]] SurfacePart assemble_faces(const Extrusion& extrusion, const Plan& plan,
                                         std::span<const std::int64_t> ids);

/// A surface of triangles, or the buildings of which a face could not be divided.
struct AssembledTriangles {
    SurfacePart part;
    std::vector<std::int32_t> failed;  ///< ascending; the part is of no use where there are any
};
[[nodiscard]] AssembledTriangles assemble_triangles(const Extrusion& extrusion, const Plan& plan,
                                                    std::span<const std::int64_t> ids,
                                                    const Triangulate& triangulate);

}  // namespace d2b
