#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem2buildings/surfaces.hpp"
#include "surface/extrude.hpp"
#include "surface/triangulate.hpp"

namespace d2b {

/// Builds a surface of polygons. @param ids of the buildings, by index
[[nodiscard]] SurfacePart assemble_faces(const Extrusion& extrusion, const Plan& plan,
                                         std::span<const std::int64_t> ids);

/// Surface of triangles, or the buildings with a face that could not be triangulated.
struct AssembledTriangles {
    SurfacePart part;
    std::vector<std::int32_t> failed;  ///< ascending; if not empty, the part is unusable
};
[[nodiscard]] AssembledTriangles assemble_triangles(const Extrusion& extrusion, const Plan& plan,
                                                    std::span<const std::int64_t> ids,
                                                    const Triangulate& triangulate);

}  // namespace d2b
