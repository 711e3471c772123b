#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contours/contour.hpp"
#include "core/context.hpp"
#include "core/executor.hpp"
#include "core/grouped_indices.hpp"
#include "dem2buildings/report.hpp"
#include "features/drawn_stack.hpp"
#include "features/record_builder.hpp"
#include "features/reprojection.hpp"
#include "features/write_features.hpp"
#include "geometry/geos.hpp"
#include "geometry/overlay.hpp"
#include "outline/outline.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::features {

/// Returns the children of each contour in the tree of contours.
[[nodiscard]] GroupedIndices contour_children(const contours::ContourList& contours);

struct ValidParts {
    std::vector<WorldPolygon> parts;
    std::string invalid_reason;  ///< GEOS's reason why the first drawing is invalid; "" if it is valid
};

/// Draws the parts. May throw GeometryError.
using DrawParts = std::function<std::vector<WorldPolygon>()>;

/// Returns parts that GEOS accepts as valid: the drawn ones; otherwise, or if GEOS fails on them, the traced
/// ones; otherwise repaired ones; and none if repair fails as well. Fallbacks are counted. Never throws for a
/// bad polygon, because one feature must not end the run.
/// @param status set to kept_traced or repaired after a fallback
[[nodiscard]] ValidParts draw_valid(const DrawParts& drawn, const DrawParts& traced, Geos& geos,
                                    OutlineStatus& status, Tally& tally);

/// Parameters for converting outlines to polygons of the output.
struct PolygonParameters {
    const RunSetup& setup;
    const outline::Outliner& outliner;
    const GroupedIndices& children;  ///< may be empty if no tiers are drawn
    StopToken stop = {};
    bool with_cells = false;  ///< true to return the cells of each polygon
    double metres = 1;        ///< metres per vertical unit
};

/// Output polygon with its measures and the status of its outline.
struct FeaturePolygon {
    std::vector<WorldPolygon> parts;
    Geodesy::Measure measure;
    OutlineStatus status = OutlineStatus::traced;
    double deviation = 0;    ///< regularized outline from trace, units of the DEM's CRS (degrees of latitude)
    double simplified = 0;   ///< share of the length that is simplified although walls were asked for
    double kept_traced = 0;  ///< share of the length that is traced although more was asked for
    double area_change = 0;  ///< by regularization, as a share of the traced area
    std::string invalid_reason;        ///< GEOS's objection, if it is not written as drawn
    bool split_by_projection = false;  ///< torn by the output CRS, so without parts
    std::vector<RowSpan> cells;        ///< cells with their centres inside; empty if not asked for
};

/// Converts outlines to output polygons: draws them in the CRS of the DEM, reprojects, checks validity and
/// measures area and perimeter. An invalid polygon falls back to its traced form or is repaired instead of
/// throwing an exception, because one feature must not end a run of hours.
///
/// Not thread-safe, because GEOS and PROJ contexts are not: use one object per thread, as ContourDrawer does:
///
///     FeaturePolygon polygon = makers[thread].footprint(contour);
///     if (polygon.parts.empty())
///         ...  // torn by the output CRS, or lost; see status and tally()
class PolygonMaker {
  public:
    /// @param terms its references must outlive this
    explicit PolygonMaker(const PolygonParameters& terms);

    /// Returns the polygon of a contour.
    [[nodiscard]] FeaturePolygon whole(std::size_t contour) { return make(contour, Form::whole); }
    /// Returns the polygon of a contour of level 1 as a building, without the vertices that only higher
    /// levels need.
    [[nodiscard]] FeaturePolygon footprint(std::size_t contour) { return make(contour, Form::footprint); }
    /// Converts a lattice polygon without changing its shape.
    [[nodiscard]] FeaturePolygon as_traced(const LatticePolygon& polygon);
    /// Returns a contour minus the contours on top of it; no parts if they cover it completely.
    [[nodiscard]] FeaturePolygon tier(std::size_t contour) { return make(contour, Form::tier); }

    /// Returns the part of a contour, or with disjoint contours of its tier, within an area; no parts if
    /// there is none. @param area valid polygons in the CRS of the DEM
    [[nodiscard]] FeaturePolygon within(std::size_t contour, const std::vector<WorldPolygon>& area);

    /// Converts polygons without changing their shape. @param area valid polygons in the CRS of the DEM
    [[nodiscard]] FeaturePolygon given(const std::vector<WorldPolygon>& area);

    /// Converts a face of a roof, with the elevations of its corners. No parts if the output CRS tears it.
    [[nodiscard]] FeaturePolygon roof_face(const roofs::RoofFace& face);

    /// Direction of a step at a place of the raster, in degrees clockwise from the north of the output's CRS;
    /// NaN if it has no image there. @param step in metres along x and y of the raster's CRS
    [[nodiscard]] double azimuth(const Position& at, const Position& step);

    /// Metres per vertical unit.
    [[nodiscard]] double metres() const { return terms_.metres; }
    /// Returns times and outline counters since construction.
    [[nodiscard]] Tally& tally() { return tally_; }

  private:
    using Parts = std::vector<WorldPolygon>;
    using Draw = std::function<FinePolygon(std::size_t)>;
    enum class Form { whole, footprint, tier };

    [[nodiscard]] FeaturePolygon make(std::size_t contour, Form form);
    [[nodiscard]] Parts shape(std::size_t contour, bool tier, const Draw& draw);
    [[nodiscard]] Parts traced_shape(std::size_t contour, bool tier);
    [[nodiscard]] Parts cut_off(const Parts& parts);
    [[nodiscard]] Parts in_target_crs(Parts parts);
    [[nodiscard]] Geodesy::Measure measured(const FeaturePolygon& made, const Parts& drawn);
    [[nodiscard]] bool is_valid_as_traced(const FeaturePolygon& made, Form form) const;

    PolygonParameters terms_;
    Geos geos_;
    std::optional<Overlay> overlay_;                   ///< made when it is needed
    const std::vector<WorldPolygon>* area_ = nullptr;  ///< contours are cut off at it
    Geodesy geodesy_;
    std::optional<RingTransform> to_target_;  ///< nullopt if nothing is reprojected
    bool split_by_projection_ = false;        ///< state of the current feature
    std::vector<RowSpan> cells_;              ///< cells of the current feature
    Tally tally_;
};

/// Returns one maker per thread of the context. @param outliner, children see PolygonParameters
[[nodiscard]] std::vector<PolygonMaker> polygon_makers(const RunSetup& setup,
                                                       const outline::Outliner& outliner,
                                                       const GroupedIndices& children, bool with_cells,
                                                       Context& context);

/// Counts vertices without the repeated last ones of rings.
[[nodiscard]] std::int64_t vertices_of(const std::vector<WorldPolygon>& parts);

/// Face of a roof as it is written. Its id and its building are those of no layer before number_faces().
struct DrawnFace {
    RoofFaceRecord record;
    std::vector<WorldPolygon> parts;
};

/// Records of a contour and its polygons. A polygon is empty if its layer is not written.
struct DrawnContour {
    contours::ContourKey key;
    std::int64_t parent = -1;          ///< index of the parent in the contour list
    std::int64_t building_index = -1;  ///< index of the building in the contour list
    bool is_low_confidence = false;
    ContourRecord record;
    PointStats own;
    PointStats whole;                ///< including the contours above
    BuildingRecord building_record;  ///< level 1 only
    std::optional<FeaturePolygon> building;
    std::optional<FeaturePolygon> contour;
    std::vector<DrawnFace> faces;  ///< of the roof, if the building and they are written
};

/// Adds the drawn cells of a contour and its building to the stack, if they are written.
void add_to_stack(const DrawnContour& drawn, const LayerIndices& indices, DrawnStack& stack);

/// Number of contours that a thread draws at a time, because handing over each would cost more.
inline constexpr std::size_t contours_per_task = 64;

/// Calls take(i, draw(i, thread)) for each i below `count`: draw() on all threads, take() in order on the
/// calling thread.
template <typename Draw, typename Take>
void draw_in_order(Executor& threads, std::size_t count, const Draw& draw, const Take& take) {
    using Values = std::vector<decltype(draw(std::size_t{}, std::size_t{}))>;
    threads.in_order((count + contours_per_task - 1) / contours_per_task,
                     [&](std::size_t task, std::size_t thread) {
                         Values values;
                         const std::size_t first = task * contours_per_task;
                         for (std::size_t i = first; i < std::min(count, first + contours_per_task); ++i)
                             values.push_back(draw(i, thread));
                         return values;
                     },
                     [&](std::size_t task, Values values) {
                         for (std::size_t i = 0; i < values.size(); ++i)
                             take(task * contours_per_task + i, std::move(values[i]));
                     });
}

/// Draws contours for the requested layers. Thread-safe, with one PolygonMaker per thread.
class ContourDrawer {
  public:
    /// @param input, records must outlive this
    ContourDrawer(const FeatureInput& input, const RecordBuilder& records, Context& context);
    ContourDrawer(const ContourDrawer&) = delete;
    ContourDrawer& operator=(const ContourDrawer&) = delete;
    ~ContourDrawer() = default;

    /// @param thread index of the calling thread
    [[nodiscard]] DrawnContour draw(std::size_t contour, std::size_t thread);
    /// Draws all contours and calls take(contour, drawn), see draw_in_order().
    template <typename Take>
    void draw_all(const Take& take) {
        draw_in_order(
            threads_, input_.contours.size(),
            [this](std::size_t i, std::size_t thread) { return draw(i, thread); }, take);
    }
    /// True if polygons come with their cells, because the stack error is measured on them.
    [[nodiscard]] bool returns_cells() const { return with_cells_; }
    /// Returns the makers, one per thread.
    [[nodiscard]] std::vector<PolygonMaker>& makers() { return makers_; }

  private:
    void draw_building(std::size_t contour, PolygonMaker& maker, DrawnContour& drawn) const;
    [[nodiscard]] bool has_faces(const DrawnContour& drawn) const;

    const FeatureInput& input_;
    const RecordBuilder& records_;
    Executor& threads_;
    GroupedIndices children_;
    bool with_cells_;
    std::vector<PolygonMaker> makers_;
};

/// Groups contours whose outlines depend on each other, and returns the reach of that dependence in cells.
[[nodiscard]] outline::OutlineDependencies outline_dependencies_of(const contours::ContourList& contours,
                                                                   const RunSetup& setup, Context& context);

/// Draws the outlines of the contours of a run.
[[nodiscard]] outline::Outliner draw_outlines(const contours::ContourList& contours, const RunSetup& setup,
                                              Context& context);

}  // namespace d2b::features
