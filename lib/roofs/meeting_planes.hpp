#pragma once

#include <cstddef>
#include <vector>

#include "roofs/building_grid.hpp"
#include "roofs/partition.hpp"
#include "roofs/plane.hpp"

namespace d2b::roofs {

/// Plane of a face.
struct FacePlane {
    Plane plane;
    bool fixed = false;  ///< true if its slope was reduced
    bool level = false;  ///< true if the data do not support any slope
};

/// Fits the planes of all faces of a building at once (least squares), such that faces which nearly meet in a
/// corner meet there exactly. A face that would be too steep, or have a corner far above or below its cells,
/// is level. @param first planes by face, from which the weights of cells follow @param cells of each face
[[nodiscard]] std::vector<FacePlane> meeting_planes(const std::vector<LabelledFace>& faces,
                                                    const std::vector<FaceEdge>& edges,
                                                    const std::vector<Plane>& first,
                                                    const std::vector<std::vector<std::size_t>>& cells,
                                                    const BuildingGrid& grid, const RoofLattice& lattice);

/// Faces to merge because a step of less than 25 cm is left between them: the lowest number of each group, by
/// face. @param price squared error in m2 of a cell that a border has to save per cell of its length
[[nodiscard]] std::vector<std::int32_t> merged_faces(const std::vector<FaceEdge>& edges,
                                                     const std::vector<FacePlane>& planes,
                                                     const std::vector<std::vector<std::size_t>>& cells,
                                                     double price, const BuildingGrid& grid,
                                                     const RoofLattice& lattice);

/// Elevations of the corners of faces in the order of their rings. Corners in which faces meet have one
/// elevation.
[[nodiscard]] std::vector<std::vector<double>> corner_elevations(const std::vector<LabelledFace>& faces,
                                                                 const std::vector<FacePlane>& planes,
                                                                 const RoofLattice& lattice);

}  // namespace d2b::roofs
