#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/report.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// What outlines need to become polygons of the output.
struct Placement {
    const std::vector<Contour>& contours;
    const OutlineOptions& options;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the DEM's
    Window window;
    const Outliner& outliner;
    /// of each contour: those that stand on it; may be empty where no tier is asked for
    const std::vector<std::vector<std::size_t>>& children;
};

/// A polygon as it is written, with its measures and what became of its outline.
struct Placed {
    std::vector<WorldPolygon> parts;
    Geodesy::Measure measure;
    OutlineStatus status = OutlineStatus::traced;
    double deviation = 0;    ///< of a regularized outline from its trace, in units of the CRS of the DEM (in
                             ///< degrees of latitude where these are degrees)
    double area_change = 0;  ///< of a regularized outline, share of the traced area
};

/// Draws outlines, places them in the CRS of the output, has them checked and measures them; one object a
/// thread.
class Placer {
  public:
    /// @param placement its references must outlive this
    explicit Placer(const Placement& placement);

    /// The polygon of a contour.
    [[nodiscard]] Placed whole(std::size_t contour) { return place(contour, Form::whole); }
    /// The polygon of a contour of level 1 as a building, without vertices that only higher levels need.
    [[nodiscard]] Placed footprint(std::size_t contour) { return place(contour, Form::footprint); }
    /// What the contours that stand on it leave of it: no parts where they cover it whole.
    [[nodiscard]] Placed tier(std::size_t contour) { return place(contour, Form::tier); }

    /// Seconds, and what became of outlines, since it began.
    [[nodiscard]] const Tally& tally() const { return tally_; }

  private:
    using Parts = std::vector<WorldPolygon>;
    using Draw = std::function<FinePolygon(std::size_t)>;
    enum class Form { whole, footprint, tier };

    [[nodiscard]] Placed place(std::size_t contour, Form form);
    [[nodiscard]] Parts shape(std::size_t contour, bool tier, const Draw& draw);
    [[nodiscard]] Parts in_target_crs(Parts parts);
    [[nodiscard]] bool is_exact_and_vast(const Placed& placed) const;

    Placement placement_;
    Geos geos_;
    Geodesy geodesy_;
    std::optional<CoordinateTransform> transform_;
    std::optional<Geodesy> target_geodesy_;
    Tally tally_;
};

/// Without those that close rings.
[[nodiscard]] std::int64_t vertices_of(const std::vector<WorldPolygon>& parts);
/// The contours that stand on each.
[[nodiscard]] std::vector<std::vector<std::size_t>> children_of(const std::vector<Contour>& contours);
/// The outlines of a run.
[[nodiscard]] Outliner make_outliner(const std::vector<Contour>& contours, const OutlineOptions& options,
                                     const Georeference& georeference, const Crs& crs, const Window& window,
                                     Executor& executor);

}  // namespace d2b
