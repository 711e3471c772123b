#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/report.hpp"
#include "features/ring_carrier.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"

namespace d2b {

/// The contours that stand on each contour.
class Children {
  public:
    Children() = default;
    explicit Children(const ContourList& contours);
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t contour) const {
        return std::span(children_).subspan(first_[contour], first_[contour + 1] - first_[contour]);
    }

  private:
    std::vector<std::uint32_t> children_;  ///< of one contour after the other
    std::vector<std::size_t> first_;       ///< of a contour; one more at the end
};

/// What outlines need to become polygons of the output.
struct Placement {
    const OutlineOptions& options;
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the DEM's
    Window window;
    const Outliner& outliner;
    const Children& children;  ///< may be empty where no tier is asked for
    StopRequest stop = {};
};

/// A polygon as it is written, with its measures and what became of its outline.
struct Placed {
    std::vector<WorldPolygon> parts;
    Geodesy::Measure measure;
    OutlineStatus status = OutlineStatus::traced;
    double deviation = 0;    ///< of a regularized outline from its trace, in units of the CRS of the DEM (in
                             ///< degrees of latitude where these are degrees)
    double kept_traced = 0;  ///< share of its length that stays as it was traced although more was asked for
    double area_change = 0;  ///< of a regularized outline, share of the traced area
    std::string trouble;     ///< what GEOS said of it, where it is not written as it was drawn
    bool torn = false;       ///< the CRS of the output tears it apart: it has no parts
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
    /// A polygon of the lattice as it is.
    [[nodiscard]] Placed as_traced(const LatticePolygon& polygon);
    /// What the contours that stand on it leave of it: no parts where they cover it whole.
    [[nodiscard]] Placed tier(std::size_t contour) { return place(contour, Form::tier); }

    /// Seconds, and what became of outlines, since it began.
    [[nodiscard]] Tally& tally() { return tally_; }

  private:
    using Parts = std::vector<WorldPolygon>;
    using Draw = std::function<FinePolygon(std::size_t)>;
    enum class Form { whole, footprint, tier };

    [[nodiscard]] Placed place(std::size_t contour, Form form);
    [[nodiscard]] Parts shape(std::size_t contour, bool tier, const Draw& draw);
    [[nodiscard]] Parts traced_shape(std::size_t contour, bool tier);
    [[nodiscard]] Parts in_target_crs(Parts parts);
    [[nodiscard]] Geodesy::Measure measured(const Placed& placed, const Parts& drawn);
    [[nodiscard]] bool is_valid_as_traced(const Placed& placed, Form form) const;

    Placement placement_;
    Geos geos_;
    Geodesy geodesy_;
    std::optional<RingCarrier> carrier_;  ///< empty: nothing is reprojected
    bool torn_ = false;                   ///< the feature at hand
    Tally tally_;
};

/// Without those that close rings.
[[nodiscard]] std::int64_t vertices_of(const std::vector<WorldPolygon>& parts);
/// The outlines of a run.
[[nodiscard]] Outliner make_outliner(const ContourList& contours, const OutlineOptions& options,
                                     const Georeference& georeference, const Crs& crs, const Window& window,
                                     Context& context);

}  // namespace d2b
