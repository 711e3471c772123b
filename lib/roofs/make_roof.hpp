#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "contours/merge_regions.hpp"
#include "core/grid.hpp"
#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "geometry/geos.hpp"
#include "roofs/border_lines.hpp"
#include "roofs/partition.hpp"
#include "roofs/roof_type.hpp"
#include "roofs/segment_planes.hpp"

namespace d2b::roofs {

struct RoofParameters {
    SegmentOptions segments;
    BorderOptions borders;
    CellSize cell;
    double metres = 1;  ///< metres per unit of the elevations
    /// Instead of planes, level tiers with these options: for surfaces without slopes to trust.
    std::optional<contours::RegionOptions> tiers{};
    double cell_centre = 0.5;  ///< position of the centre of cell 0 on the lattice: 0 with -trace points
};

enum class FaceKind { flat, pitched, doubtful };

struct FaceMeasure {
    double area = 0;       ///< in plan, as a share of the footprint
    double slope_col = 0;  ///< rise per metre along a row
    double slope_row = 0;  ///< rise per metre down a column
    double slope = 0;      ///< rise per metre along its fall
    double rmse_m = 0;
    double near = 0;         ///< share of the cells within half a metre of the plane
    std::int64_t cells = 0;  ///< valid cells with their centres in it
    FaceKind kind = FaceKind::flat;
};

/// Face of a roof.
struct RoofFace {
    FinePolygon outline;             ///< in 1/1024 of a fine step: corners are shared with other faces
    std::vector<double> elevations;  ///< of its corners in the order of its rings, in m
    FaceMeasure measure;
};

/// Names of the types of roofs.
inline constexpr std::array<std::string_view, 9> roof_types{
    "flat", "shed", "gabled", "hipped", "pyramidal", "mansard", "domed", "complex", "unknown"};

/// Roof of a building: faces that tile its footprint.
struct Roof {
    std::vector<RoofFace> faces;
    std::string_view type;  ///< one of roof_types
    double rmse_m = 0;
};

/// Slope in degrees.
[[nodiscard]] double slope_degrees(const FaceMeasure& face);

/// Extracts the faces of a roof from the cells of a building and its outline. Two faces either meet along an
/// edge or are a step apart.
/// @throws Cancelled, GeometryError
[[nodiscard]] Roof make_roof(const contours::BuildingCells& cells, const FinePolygon& footprint,
                             const RoofParameters& options, Geos& geos, const StopToken& stop);

}  // namespace d2b::roofs
