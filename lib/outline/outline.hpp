#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/context.hpp"
#include "core/georeference.hpp"
#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/records.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// What outlines are to look like.
struct OutlineRules {
    Walls walls = Walls::off;
    double wall_tolerance = 0;  ///< cells: no outline with walls leaves its trace by more
    double wall_inset = 0;      ///< cells: walls move inward by it, as far as the tolerance lets them
    double simplify = 0;        ///< tolerance in units of the CRS; 0: every corner is kept
    bool reprojected = false;   ///< corners are moved afterwards
};

/// How outlines are drawn from contours.
enum class Drawing {
    traced,      ///< corner by corner: exact where rows and columns run along the axes and nothing moves them
    noded,       ///< with every corner that another outline has on it, so that what is shared stays shared
    simplified,  ///< from shared arcs, straightened
    regularized  ///< with straight walls, right angles and arcs in place of the staircase
};

/// How an outline differs from its trace.
struct OutlineQuality {
    OutlineStatus status = OutlineStatus::traced;
    double simplified = 0;       ///< share of the length that is simplified although walls were asked for
    double kept_traced = 0;      ///< share of the length that runs as it was traced although walls were asked
                                 ///< for
    double deviation_cells = 0;  ///< outline and trace are nowhere farther apart, either way; a cell is the
                                 ///< square root of its area. Regularized outlines alone: else 0
    double area_change = 0;      ///< share of the traced area. Regularized outlines alone: else 0
};

/// Draws outlines of contours on the lattice, one at a time. What is const may be called from several
/// threads.
class Outliner {
  public:
    /// @param contours they stay the caller's and must outlive this
    /// @param x_stretch length on the ground of a unit of x over that of a unit of y: what is a right angle
    /// @param context its threads fit walls, which wait in a spool of its
    Outliner(const ContourList& contours, Drawing drawing, const OutlineRules& rules,
             const Georeference& georeference, double x_stretch, Context& context);
    Outliner(Outliner&&) noexcept;
    Outliner& operator=(Outliner&&) noexcept;
    ~Outliner();

    /// Draws a contour like this from now on, and its footprint where this is no other. While nobody else
    /// asks for outlines.
    void replace(std::size_t contour, const FinePolygon& outline);
    /// Draws its own footprint like this from now on, where there are such. While nobody else asks for
    /// outlines.
    void replace_footprint(std::size_t contour, const FinePolygon& outline);

    [[nodiscard]] OutlineQuality quality(std::size_t contour) const;
    [[nodiscard]] FinePolygon outline(std::size_t contour) const;
    /// The outline of a contour of level 0 or 1 for those who do not look at higher levels. Where outlines
    /// are regularized, footprints are drawn as if nothing stood on them: without vertices that higher levels
    /// need, and also where their outline keeps its traced form for the sake of what stands on it.
    [[nodiscard]] FinePolygon footprint(std::size_t contour) const;
    [[nodiscard]] OutlineQuality footprint_quality(std::size_t contour) const;
    /// Whether footprints may differ from outlines at all.
    [[nodiscard]] bool has_own_footprints() const;
    /// Divides the contours into groups whose outlines nowhere meet those of other groups, but that outlines
    /// of level 0 may meet all. @return the contours of each, ascending; sorted by their first contours
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> groups(const StopRequest& stop) const;
    /// The outline without simplification: the way back where a polygon would be invalid.
    [[nodiscard]] FinePolygon traced(std::size_t contour) const;

  private:
    struct Impl;
    [[nodiscard]] OutlineQuality changed_quality(OutlineQuality known, const FinePolygon& before,
                                                 const FinePolygon& after) const;
    std::unique_ptr<Impl> impl_;
};

/// What an outline depends on beside its own contour.
struct OutlineReach {
    LatticePoint cells;  ///< rows and columns of the lattice over which outlines get into each other's way
    /// Contours that may do so, ascending, and what stands on them; sorted by their first contours.
    std::vector<std::vector<std::uint32_t>> groups;
};
/// The outlines of a group depend on nothing but its contours. Not where they are simplified.
/// @param x_stretch as Outliner's
[[nodiscard]] OutlineReach outline_reach(const ContourList& contours, const OutlineRules& rules,
                                         const Georeference& georeference, double x_stretch,
                                         const StopRequest& stop);

/// What the rules and the grid call for: nothing is noded that cannot come apart.
[[nodiscard]] Drawing choose_drawing(const OutlineRules& rules, const Georeference& georeference);

}  // namespace d2b
