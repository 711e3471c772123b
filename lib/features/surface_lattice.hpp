#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/surfaces.hpp"
#include "features/ring_transform.hpp"
#include "surface/plan_gaps.hpp"

namespace d2b {

/// What a lattice for surfaces depends on.
struct SurfaceTerms {
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the DEM's
    Window window;
    LatticeBox frame;        ///< that outlines are drawn in
    double cell_size_m = 1;  ///< side of a square of a cell's area
    double vertical_metres = 1;
    std::optional<std::array<double, 3>> origin;  ///< of local coordinates, metres
    std::string_view asked_by = "-surface";       ///< the option that messages name

    [[nodiscard]] const Crs& written() const {
        return target_crs.kind() == Crs::Kind::none ? crs : target_crs;
    }
};

/// Where the corners of surfaces lie. Where rows and columns run along the axes and nothing is reprojected,
/// these are those of the fine lattice, exactly; else a grid as fine, of a power of two of the unit.
class SurfaceLattice {
  public:
    /// Its origin is the middle of the window, in whole metres, where none is given; its height 0 until it is
    /// known. @throws OptionError where the coordinates are no lengths
    explicit SurfaceLattice(const SurfaceTerms& terms);

    [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
    /// Of the window, in the CRS that is written, as SurfaceMeta has them.
    [[nodiscard]] const std::array<Position, 4>& window_corners() const { return corners_; }
    /// How far corners of surfaces lie apart on it: anywhere in the window as far on the ground as is wanted.
    [[nodiscard]] const PlanGaps& gaps() const { return gaps_; }
    /// Whether outlines come onto it without rounding.
    [[nodiscard]] bool is_exact() const { return is_exact_; }
    /// In millimetres. @param elevation in the vertical unit
    [[nodiscard]] std::int64_t height(double elevation) const;
    /// Where no origin is given: the whole metre below the lowest elevation. @param lowest in the vertical
    /// unit
    void set_lowest(double lowest);

    /// An outline on this lattice: columns to the east, rows to the south.
    /// @param transform to the CRS of the output; one a thread
    /// @return nothing where the CRS of the output tears it apart
    [[nodiscard]] std::optional<FinePolygon> place(const FinePolygon& outline,
                                                   std::optional<RingTransform>& transform) const;

    /// Whether single precision tells steps apart in the whole window. @throws OptionError where it does not,
    /// with the largest window in which it does
    void require_single_precision() const;
    /// The same of heights. @param lowest in the vertical unit @param highest likewise @throws OptionError
    void require_single_precision(double lowest, double highest) const;

  private:
    [[nodiscard]] FineRing exact_ring(const FineRing& ring) const;

    SurfaceTerms terms_;
    SurfaceFrame frame_;
    PlanGaps gaps_;
    std::array<Position, 4> corners_{};
    bool is_exact_;
    bool east_;         ///< columns run to the east
    bool south_;        ///< rows run to the south
    FinePoint corner_;  ///< south-western one of the frame
    double reach_ = 0;  ///< largest local coordinate of the window, metres
};

}  // namespace d2b
