#pragma once

#include <cstdint>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "geometry/geos.hpp"
#include "roofs/border_lines.hpp"
#include "roofs/building_grid.hpp"

namespace d2b::roofs {

/// Divides a step of the fine lattice, because corners of faces lie on walls between its points.
inline constexpr std::int64_t roof_steps = 1024;

/// Returns a polygon of the fine lattice on the lattice of roofs.
[[nodiscard]] FinePolygon refined(const FinePolygon& polygon);

/// Face of the partition of a footprint, and its label.
struct LabelledFace {
    FinePolygon outline;  ///< on the lattice of roofs
    std::int32_t label = 0;
};

/// Edge between two faces, or between a face and the outside.
struct FaceEdge {
    FinePoint from;
    FinePoint to;
    std::int32_t left = -1;  ///< face on its left with y up; -1: outside
    std::int32_t right = -1;
};

/// Edges of faces that share their corners. Each edge appears once, ordered by its ends.
[[nodiscard]] std::vector<FaceEdge> face_edges(const std::vector<LabelledFace>& faces);

/// Positions between the lattice of roofs and a building's grid.
class RoofLattice {
  public:
    RoofLattice(const BuildingGrid& grid, double cell_centre) : grid_(grid), shift_(cell_centre - 0.5) {}

    [[nodiscard]] FinePoint point(const Vec2& p) const;
    [[nodiscard]] Vec2 position(FinePoint p) const;
    /// Point on the lattice of outlines, relative to the grid, as row_spans() takes it.
    [[nodiscard]] FinePoint in_grid(FinePoint p) const;

  private:
    const BuildingGrid& grid_;
    double shift_;  ///< of cells on the lattice
};

/// Divides a footprint by lines and gives each face the label that most of its cells have. Neighbouring faces
/// of one label are one face; faces of less than a cell join their neighbour. @param footprint on the lattice
/// of roofs @throws GeometryError, Cancelled
[[nodiscard]] std::vector<LabelledFace> partition(const FinePolygon& footprint,
                                                  const std::vector<BorderLine>& lines,
                                                  const std::vector<std::int32_t>& labels,
                                                  const BuildingGrid& grid, const RoofLattice& lattice,
                                                  Geos& geos, const StopToken& stop = {});

/// Merges neighbours of one label. Faces without a label (-1) get that of the neighbour with the longest
/// edge.
/// @throws GeometryError
[[nodiscard]] std::vector<LabelledFace> dissolve(std::vector<LabelledFace> faces, Geos& geos);

/// Area in cells.
[[nodiscard]] double area_in_cells(const FinePolygon& polygon);

/// Cells of a grid whose centres lie in a face, as indices.
[[nodiscard]] std::vector<std::size_t> cells_of(const FinePolygon& face, const BuildingGrid& grid,
                                                const RoofLattice& lattice);

}  // namespace d2b::roofs
