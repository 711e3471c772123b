#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/georeference.hpp"
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
/// run.
class Placer {
  public:
    /// @param placement its references must outlive this
    Placer(const Placement& placement, Context& context);

    /// The polygon of a contour.
    [[nodiscard]] Placed whole(std::size_t contour) { return place(contour, Form::whole); }
    /// The polygon of a contour of level 1 as a building, without vertices that only higher levels need.
    [[nodiscard]] Placed footprint(std::size_t contour) { return place(contour, Form::footprint); }
    /// What the contours that stand on it leave of it: no parts where they cover it whole.
    [[nodiscard]] Placed tier(std::size_t contour) { return place(contour, Form::tier); }

  private:
    using Parts = std::vector<WorldPolygon>;
    using Draw = std::function<FinePolygon(std::size_t)>;
    enum class Form { whole, footprint, tier };

    [[nodiscard]] Placed place(std::size_t contour, Form form);
    [[nodiscard]] Parts shape(std::size_t contour, bool tier, const Draw& draw);
    [[nodiscard]] Parts in_target_crs(Parts parts);
    void find_children();

    Placement placement_;
    Context& context_;
    Outliner outliner_;
    Geos geos_;
    Geodesy geodesy_;
    std::optional<CoordinateTransform> transform_;
    std::vector<std::vector<std::size_t>>
        children_;  ///< of each contour; filled when the first tier is asked for
};

}  // namespace d2b
