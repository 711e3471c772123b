#pragma once

#include <array>
#include <memory>
#include <string>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// Name and colour of a kind of face in formats with materials.
struct FaceMaterial {
    const char* name;
    std::array<double, 3> colour;  ///< linear RGB
};
/// Indexed by FaceKind.
inline constexpr std::array face_materials{FaceMaterial{"roof", {0.45, 0.09, 0.05}},
                                           FaceMaterial{"wall", {0.6, 0.57, 0.5}},
                                           FaceMaterial{"ground", {0.2, 0.2, 0.2}}};

/// Formats local coordinates in metres with all decimals of a step, so that nothing is rounded and straight
/// edges stay straight. If a step has too many decimals, as in feet, uses enough to resolve 1/16 of a step;
/// this adds almost nothing to the rounding of readers in single precision.
class LocalCoordinateFormatter {
  public:
    explicit LocalCoordinateFormatter(const SurfaceFrame& frame);

    /// Returns for example "12.3457 -3.2500 7.123".
    [[nodiscard]] std::string operator()(const SurfacePoint& point) const;

  private:
    SurfaceFrame frame_;
    std::array<double, 2> step_;   ///< x and y, metres
    std::array<double, 2> shift_;  ///< offset of the point 0, 0 from the origin, metres
    int decimals_;                 ///< decimals of x and y; heights are whole millimetres
};

/// Formats a value with at most `decimals` decimals and without trailing zeros: "0.5", "12".
[[nodiscard]] std::string trimmed_decimal(double value, int decimals);

/// Returns whole metres, for example "84000 446000 -2".
[[nodiscard]] std::string origin_text(const SurfaceFrame& frame);

/// Wavefront OBJ: one object per building, named after its id, or one for all, with groups roof, wall and
/// ground, whose colours are in a second file. Vertices shared by touching buildings are written once, before
/// the first of them. Metadata are written as comments. @param materials file of FileKind::materials
[[nodiscard]] std::unique_ptr<SurfaceSink> open_obj_sink(FileDestination place, FileDestination materials,
                                                         SurfaceSolids solids = SurfaceSolids::each);

/// ASCII STL: one solid per building, named after its id, or one for all, with the origin of the coordinates
/// after the name. Without any building no file is written, because an STL without facets is invalid, and a
/// warning says so.
[[nodiscard]] std::unique_ptr<SurfaceSink> open_stl_sink(FileDestination place,
                                                         SurfaceSolids solids = SurfaceSolids::each);

}  // namespace d2b::writing
