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

/// What outlines need to become polygons of the output.
struct PolygonTerms {
    const OutlineOptions& options;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the DEM's
    Window window;
    const Outliner& outliner;
    const ContourChildren& children;  ///< may be empty where no tier is asked for
    StopRequest stop = {};
    bool with_cells = false;  ///< whether it is asked which cells a polygon holds
};

/// A polygon as it is written, with its measures and what became of its outline.
struct FeaturePolygon {
    std::vector<WorldPolygon> parts;
    Geodesy::Measure measure;
    OutlineStatus status = OutlineStatus::traced;
    double deviation = 0;    ///< of a regularized outline from its trace, in units of the CRS of the DEM (in
                             ///< degrees of latitude where these are degrees)
    double simplified = 0;   ///< share of its length that is simplified although walls were asked for
    double kept_traced = 0;  ///< share of its length that stays as it was traced although more was asked for
    double area_change = 0;  ///< of a regularized outline, share of the traced area
    std::string trouble;     ///< what GEOS said of it, where it is not written as it was drawn
    bool torn = false;       ///< the CRS of the output tears it apart: it has no parts
    std::vector<RowSpan>
        cells;  ///< whose middles it holds, as it is drawn; none where they are not asked for
};

/// Draws outlines, places them in the CRS of the output, has them checked and measures them; one object a
/// thread.
class PolygonMaker {
  public:
    /// @param terms its references must outlive this
    explicit PolygonMaker(const PolygonTerms& terms);

    /// The polygon of a contour.
    [[nodiscard]] FeaturePolygon whole(std::size_t contour) { return make(contour, Form::whole); }
    /// The polygon of a contour of level 1 as a building, without vertices that only higher levels need.
    [[nodiscard]] FeaturePolygon footprint(std::size_t contour) { return make(contour, Form::footprint); }
    /// A polygon of the lattice as it is.
    [[nodiscard]] FeaturePolygon as_traced(const LatticePolygon& polygon);
    /// What the contours that stand on it leave of it: no parts where they cover it whole.
    [[nodiscard]] FeaturePolygon tier(std::size_t contour) { return make(contour, Form::tier); }

    /// Seconds, and what became of outlines, since it began.
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
    std::optional<RingTransform> to_target_;  ///< empty: nothing is reprojected
    bool torn_ = false;                       ///< the feature at hand
    std::vector<RowSpan> cells_;              ///< likewise
    Tally tally_;
};

/// Without those that close rings.
[[nodiscard]] std::int64_t vertices_of(const std::vector<WorldPolygon>& parts);
/// The outlines of a run.
[[nodiscard]] Outliner make_outliner(const ContourList& contours, const OutlineRules& rules,
                                     const Georeference& georeference, const Crs& crs, const Window& window,
                                     Context& context);

}  // namespace d2b
