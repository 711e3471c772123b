#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/report.hpp"
#include "features/contour_children.hpp"
#include "features/ring_transform.hpp"
#include "features/row_spans.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// Parameters for converting outlines to polygons of the output.
struct PolygonTerms {
    const OutlineOptions& options;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the CRS of the DEM
    Window window;
    const Outliner& outliner;
    const ContourChildren& children;  ///< may be empty if no tiers are drawn
    StopRequest stop = {};
    bool with_cells = false;  ///< true to return the cells of each polygon
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
    std::string trouble;     ///< GEOS's objection, if it is not written as drawn
    bool torn = false;       ///< torn by the output CRS, so without parts
    std::vector<RowSpan> cells;  ///< cells with their centres inside; empty if not asked for
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
    explicit PolygonMaker(const PolygonTerms& terms);

    /// Returns the polygon of a contour.
    [[nodiscard]] FeaturePolygon whole(std::size_t contour) { return make(contour, Form::whole); }
    /// Returns the polygon of a contour of level 1 as a building, without the vertices that only higher
    /// levels need.
    [[nodiscard]] FeaturePolygon footprint(std::size_t contour) { return make(contour, Form::footprint); }
    /// Converts a lattice polygon without changing its shape.
    [[nodiscard]] FeaturePolygon as_traced(const LatticePolygon& polygon);
    /// Returns a contour minus the contours on top of it; no parts if they cover it completely.
    [[nodiscard]] FeaturePolygon tier(std::size_t contour) { return make(contour, Form::tier); }

    /// Returns times and outline counters since construction.
    [[nodiscard]] Tally& tally() { return tally_; }

  private:
    using Parts = std::vector<WorldPolygon>;
    using Draw = std::function<FinePolygon(std::size_t)>;
    enum class Form { whole, footprint, tier };

    [[nodiscard]] FeaturePolygon make(std::size_t contour, Form form);
    [[nodiscard]] Parts shape(std::size_t contour, bool tier, const Draw& draw);
    [[nodiscard]] Parts traced_shape(std::size_t contour, bool tier);
    [[nodiscard]] Parts in_target_crs(Parts parts);
    [[nodiscard]] Geodesy::Measure measured(const FeaturePolygon& made, const Parts& drawn);
    [[nodiscard]] bool is_valid_as_traced(const FeaturePolygon& made, Form form) const;

    PolygonTerms terms_;
    Geos geos_;
    Geodesy geodesy_;
    std::optional<RingTransform> to_target_;  ///< nullopt if nothing is reprojected
    bool torn_ = false;                       ///< state of the current feature
    std::vector<RowSpan> cells_;              ///< cells of the current feature
    Tally tally_;
};

/// Counts vertices without the repeated last ones of rings.
[[nodiscard]] std::int64_t vertices_of(const std::vector<WorldPolygon>& parts);
/// Creates the outliner of a run.
[[nodiscard]] Outliner make_outliner(const ContourList& contours, const OutlineRules& rules,
                                     const Georeference& georeference, const Crs& crs, const Window& window,
                                     Context& context);

}  // namespace d2b
