#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "contours/contour.hpp"
#include "core/context.hpp"
#include "core/georeference.hpp"
#include "core/lattice.hpp"
#include "core/stop_token.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/records.hpp"

namespace d2b::outline {

/// Options for drawing outlines.
struct OutlineRules {
    Walls walls = Walls::off;
    double wall_tolerance = 0;   ///< cells; largest distance between a wall and the midpoints of its steps
    double wall_price = 1;       ///< area in cells that a wall has to be worth
    double wall_inset = 0;       ///< cells by which walls move inward, within the tolerance
    double simplify = 0;         ///< tolerance in units of the CRS; 0 keeps every corner
    bool reprojected = false;    ///< corners are transformed afterwards
    double vertical_metres = 1;  ///< metres per unit of elevation
    std::optional<LatticeBox> frame = {};  ///< of the raster, which cuts buildings off
};

/// Largest distance in cells between an outline with walls and its trace: walls lie near the midpoints of
/// steps, and the corners of the trace lie up to half a step farther away.
[[nodiscard]] double wall_distance(double tolerance);

/// Methods of drawing outlines from contours.
enum class OutlineMethod {
    traced,  ///< only corners: exact if rows and columns run along the axes and corners are not transformed
    noded,   ///< includes corners of other outlines, so that shared edges stay shared
    simplified,  ///< simplified arcs, shared by neighbours
    regularized  ///< straight walls, right angles and circular arcs instead of staircases
};

/// Difference between an outline and its trace.
struct OutlineQuality {
    OutlineStatus status = OutlineStatus::traced;
    double simplified = 0;   ///< share of the length that is only simplified although walls were requested
    double kept_traced = 0;  ///< share of the length that keeps the trace although walls were requested
    double deviation_cells = 0;  ///< upper bound of both Hausdorff distances between outline and trace, in
                                 ///< cells (square root of the cell area); 0 unless regularized
    double area_change = 0;      ///< relative to the traced area; 0 unless regularized
};

/// Draws the outlines of contours on the lattice. The work that needs all contours (noding, simplification,
/// fitting walls) is done by the constructor, so that outlines can be fetched one at a time:
///
///     const auto method = choose_outline_method(rules, georeference);
///     const Outliner outliner(contours, method, rules, georeference, x_stretch, context);
///     for (std::size_t i = 0; i < contours.size(); ++i)
///         write(outliner.outline(i));
///
/// Outlines of neighbours and of other levels share vertices exactly in all modes except `traced`. Results
/// are on the fine lattice and not transformed to the CRS. An outline may be invalid after a transformation;
/// callers then fall back to traced(), or replace() it. Const members are thread-safe.
class Outliner {
  public:
    /// @param contours must outlive this
    /// @param x_stretch ratio of the ground lengths of one unit of x and one of y; needed for right angles
    /// @param context provides threads for fitting walls and a spool for the results
    Outliner(const contours::ContourList& contours, OutlineMethod method, const OutlineRules& rules,
             const Georeference& georeference, double x_stretch, Context& context);
    Outliner(Outliner&&) noexcept;
    Outliner& operator=(Outliner&&) noexcept;
    ~Outliner();

    /// Replaces the outline of a contour, and its footprint unless that is separate. Not thread-safe.
    void replace(std::size_t contour, const FinePolygon& outline);
    /// Replaces the separate footprint of a contour. Requires has_own_footprints(); not thread-safe.
    void replace_footprint(std::size_t contour, const FinePolygon& outline);

    [[nodiscard]] OutlineQuality quality(std::size_t contour) const;
    [[nodiscard]] FinePolygon outline(std::size_t contour) const;
    /// Outline of a contour of level 0 or 1 for users who ignore higher levels. Regularized footprints lack
    /// the vertices that only higher levels need, and are regularized even if the outline keeps its trace
    /// because of a higher level.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const;
    [[nodiscard]] OutlineQuality footprint_quality(std::size_t contour) const;
    /// True if footprints may differ from outlines.
    [[nodiscard]] bool has_own_footprints() const;
    /// Divides contours into groups whose outlines do not touch other groups; outlines of level 0 may touch
    /// all of them. @return contours of each group, ascending; groups sorted by their first contours
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> groups(const StopToken& stop) const;
    /// Outline without simplification: the fallback for invalid polygons.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    struct Impl;
    [[nodiscard]] OutlineQuality changed_quality(OutlineQuality known, const FinePolygon& before,
                                                 const FinePolygon& after) const;
    std::unique_ptr<Impl> impl_;
};

/// Neighbourhood on which an outline depends.
struct OutlineDependencies {
    LatticePoint cells;  ///< rows and columns within which outlines may conflict
    /// Contours that may conflict and the contours on top of them, ascending; groups sorted by their first
    /// contours.
    std::vector<std::vector<std::uint32_t>> groups;
};
/// Finds groups of contours whose outlines depend only on the contours of the group. Not valid for simplified
/// outlines.
/// @param x_stretch as for Outliner
[[nodiscard]] OutlineDependencies outline_dependencies(const contours::ContourList& contours,
                                                       const OutlineRules& rules,
                                                       const Georeference& georeference, double x_stretch,
                                                       const StopToken& stop);

/// Chooses the cheapest method that satisfies the rules, because noding is unnecessary on axis-parallel
/// grids.
[[nodiscard]] OutlineMethod choose_outline_method(const OutlineRules& rules,
                                                  const Georeference& georeference);

}  // namespace d2b::outline
