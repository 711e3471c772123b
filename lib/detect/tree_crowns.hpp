#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/candidates.hpp"
#include "detect/object_features.hpp"
#include "detect/scene.hpp"
#include "detect/smoothness.hpp"

namespace d2b::detect {

/// Position in m from the raster's first corner.
struct MetricPoint {
    double x = 0;  ///< across
    double y = 0;  ///< down
};

/// Straight seam between a protruding part and its roof.
struct BoundaryLine {
    MetricPoint middle;
    MetricPoint along;   ///< unit vector
    MetricPoint inward;  ///< perpendicular unit vector towards the roof
    double first = 0;    ///< start of the seam, in m along from its middle
    double last = 0;
};

/// Wall of a seam, as offsets in m inward of the seam's line.
struct WallLine {
    double at_first = 0;  ///< offset at the start of the seam
    double at_last = 0;   ///< offset at its end
};

/// Finds the wall that continues straight for some metres beyond both ends of a seam, in line with it;
/// nullopt if there is none, as at the corner of a roof.
/// @param objects cells of all objects
/// @param eaves maximum distance of a seam outside of its wall, in cells
[[nodiscard]] std::optional<WallLine> wall_beyond(const BoundaryLine& seam, const Mask& objects,
                                                  const CellSize& cell, int eaves);

/// Same, beyond the end farther from a point, such as the one at which another wall meets this one.
[[nodiscard]] std::optional<WallLine> wall_away_from(const MetricPoint& meeting, const BoundaryLine& seam,
                                                     const Mask& objects, const CellSize& cell, int eaves);

/// Same, beyond either end, if a crown hides the other one: the wall ends behind it, or another building
/// stands there.
[[nodiscard]] std::optional<WallLine> wall_beyond_one_end(const BoundaryLine& seam, const Mask& objects,
                                                          const CellSize& cell, int eaves);

/// Clears the cells between a seam and its wall.
/// @param roofs cells that are kept
void clear_beyond_wall(const BoundaryLine& seam, const WallLine& wall, const Mask& roofs,
                       const CellSize& cell, Mask& objects);

/// Two straight parts of a seam around a corner.
struct CornerBoundary {
    BoundaryLine one;
    BoundaryLine other;
};

/// Border of a part of an object: the seam with the rest of the object, and the free border.
class SharedBoundary {
  public:
    /// Adds an edge between a cell of the part and its neighbour.
    /// @param down, across offset of the neighbour in cells
    void add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell);
    void add_free() { ++free_; }

    /// Share of the border that belongs to the object's outline; 1 if there is no seam.
    [[nodiscard]] double free_share() const;
    /// Least-squares line of the seam, if it is straight.
    [[nodiscard]] std::optional<BoundaryLine> straight_line(const CellSize& cell) const;
    /// Two lines that fit the seam best, if both are straight and meet at an angle like the walls at the
    /// corner of a roof.
    [[nodiscard]] std::optional<CornerBoundary> corner(const CellSize& cell) const;

  private:
    struct Edge {
        MetricPoint middle;
        MetricPoint to_rest;  // vector across the edge
    };
    [[nodiscard]] std::optional<BoundaryLine> fitted_line(double most_squared) const;
    [[nodiscard]] SharedBoundary half(const std::vector<std::uint8_t>& is_second, std::uint8_t which) const;

    std::vector<Edge> edges_;  // edges of the seam
    std::int64_t free_ = 0;
};

/// Computes the border of each part, by label - 1.
/// @param parts cells of objects, and the regions of these cells that are parts
/// @param rest cells of objects on the other side of seams
[[nodiscard]] std::vector<SharedBoundary> shared_boundaries(const ObjectRegions& parts, const Mask& rest,
                                                            const CellSize& cell, Executor& threads);

/// Cuts tree crowns off the walls they touch. Cells more than a metre (or a cell, if larger) away from the
/// large smooth segments of an object are divided into connected parts. A part is removed if most of its
/// border belongs to the outline of the object, so that it protrudes; if the wall continues straight on both
/// sides of it (at a corner: each wall on its own side; with stronger evidence: on one side); and if it is
/// not certainly a roof, see crown_cuts(). The cut follows the lines of the walls. Objects without a large
/// segment do not change. The remaining objects keep their confidence, unless they are too small. Halo:
/// objects, the segments they meet, and ten metres and four cells around.
/// @param flags result of smoothness()
/// @param min_cells minimum size of an object
/// @param cells cells of the objects
/// @param judged objects of these cells; changed
/// @return the crowns
[[nodiscard]] std::vector<CutCrown> remove_attached_crowns(const Scene& scene, const SmoothSegments& segments,
                                                           const Grid<std::uint8_t>& flags,
                                                           std::int64_t min_cells, Mask cells,
                                                           Candidates& judged, Executor& threads);

}  // namespace d2b::detect
