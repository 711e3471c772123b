#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/surfaces.hpp"
#include "features/reprojection.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::features {

/// Parameters of the surface lattice.
struct SurfaceLatticeParameters {
    const Georeference& georeference;
    const Crs& crs;
    const Crs& target_crs;  ///< kind none: the CRS of the DEM
    Window window;
    LatticeBox frame;        ///< bounds of the outlines
    double cell_size_m = 1;  ///< side of a square with the area of a cell
    double vertical_metres = 1;
    std::optional<std::array<double, 3>> origin;  ///< origin of local coordinates, metres
    std::string_view option_name = "-surface";    ///< option named in messages
    bool slanted =
        false;  ///< true to divide steps up to 0.6 mm, because slanted roofs meet in rounded points

    [[nodiscard]] const Crs& written() const {
        return target_crs.kind() == Crs::Kind::none ? crs : target_crs;
    }
};

/// Lattice of the vertices of surfaces. Equals the fine lattice of outlines if rows and columns are parallel
/// to the axes and nothing is reprojected; otherwise a grid of similar resolution, with a power of two of the
/// unit as its step.
class SurfaceLattice {
  public:
    /// Default origin: centre of the window in whole metres, with height 0 until set_lowest().
    /// @throws OptionError if coordinates are not lengths
    explicit SurfaceLattice(const SurfaceLatticeParameters& terms);

    [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
    /// Returns the corners of the window in the output CRS, in the order of SurfaceMeta.
    [[nodiscard]] const std::array<Position, 4>& window_corners() const { return corners_; }
    /// Returns the minimum distances between vertices, large enough to hold on the ground everywhere in the
    /// window.
    [[nodiscard]] const surface::GapTolerances& gaps() const { return gaps_; }
    /// Returns the area of the middle of the window in the plane of the output CRS, divided by that on the
    /// ground; 1 if the latter is unknown.
    [[nodiscard]] double area_scale() const { return area_scale_; }
    /// True if outlines need no rounding.
    [[nodiscard]] bool is_exact() const { return is_exact_; }
    /// Returns a height in millimetres. @param elevation in the vertical unit
    [[nodiscard]] std::int64_t height(double elevation) const;
    /// Sets the default origin's height to the whole metre below the lowest elevation. @param lowest in the
    /// vertical unit
    void set_lowest(double lowest);

    /// Maps an outline to this lattice: columns eastwards, rows southwards.
    /// @param transform to the output CRS; one per thread @param divisor points of the outline per fine step
    /// @return nullopt if the output CRS tears it
    [[nodiscard]] std::optional<FinePolygon> place(const FinePolygon& outline,
                                                   std::optional<RingTransform>& transform,
                                                   std::int64_t divisor = 1) const;
    /// Fits the plane of a face of a roof. @param elevations of the corners of its rings, in metres
    /// @return nullopt if the output CRS tears it
    [[nodiscard]] std::optional<surface::RoofPlane> place_plane(
        const FinePolygon& outline, std::span<const double> elevations, std::int64_t divisor,
        std::optional<RingTransform>& transform) const;

    /// Checks that single precision resolves one step in the whole window. @throws OptionError naming the
    /// largest window that works
    void require_single_precision() const;
    /// Same for heights. @param lowest, highest in the vertical unit @throws OptionError
    void require_single_precision(double lowest, double highest) const;

  private:
    [[nodiscard]] FineRing exact_ring(const FineRing& ring) const;
    /// Row and column of a position, in steps.
    [[nodiscard]] std::array<double, 2> steps_to(const Position& p) const {
        return {(frame_.translate[1] - p.y) / frame_.scale[1], (p.x - frame_.translate[0]) / frame_.scale[0]};
    }

    SurfaceLatticeParameters terms_;
    SurfaceFrame frame_;
    surface::GapTolerances gaps_;
    std::array<Position, 4> corners_{};
    double area_scale_ = 1;
    bool is_exact_;
    bool east_;                   ///< columns run eastwards
    bool south_;                  ///< rows run southwards
    std::int64_t divisions_ = 1;  ///< of a fine step
    FinePoint corner_;            ///< south-western corner of the frame
    double reach_ = 0;            ///< largest local coordinate of the window, metres
};

}  // namespace d2b::features
