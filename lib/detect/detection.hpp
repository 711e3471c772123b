#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "detect/left_out.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Strongest evidence against an object being a building.
enum class Doubt {
    rough,            ///< its surface is rough
    no_step,          ///< it does not rise from its surroundings in a step
    steep,            ///< its smooth segments are steep
    pieces,           ///< its smooth segments are small
    green,            ///< its NDVI is that of vegetation
    no_right_angles,  ///< its border follows no two perpendicular directions
    ragged            ///< it is small and has arms and bays
};
[[nodiscard]] std::string_view doubt_name(Doubt doubt);

/// Object above the ground that resembles a building.
struct DetectedObject {
    double confidence = 0;  ///< 0 to 1
    Doubt doubt = Doubt::rough;
    std::int64_t cells = 0;
    std::int64_t parcel = ParcelCell::nobody;  ///< parcel with most of its cells
    Label whole = 0;  ///< shared by all objects that one object was divided into; 0: unknown
};

/// Detected objects and their cells.
struct Detection {
    Grid<Label> labels;  ///< labels up to `buildings` are buildings, higher ones doubtful objects
    std::vector<DetectedObject> objects;  ///< by label - 1
    Label buildings = 0;
    LeftOut left_out;

    [[nodiscard]] bool is_building(Label label) const { return label != 0 && label <= buildings; }
};

/// Detects buildings by their shape. Elevated cells are joined to smooth segments, these grow over ridges,
/// dormers and chimneys, and each resulting object is classified by its roughness, the step at its border,
/// its shape, and the tilt and size of its segments (see judge()). Trees are rough, and crowns break up into
/// small, steep segments.
///
/// Buildings are then divided by parcels if the scene has them (detect/cut_by_parcels.hpp), and at steps of
/// the surface if options.split_height is set (detect/split.hpp). The noise of the surface and the scale of
/// the smoothness thresholds (roof_strictness()) are estimated from the scene itself, so results for a
/// cut-out differ from those for the whole raster.
///
/// Halo: an object, the segments it meets, and 11 m and five cells around them. Memory: 5 to 9 bytes per cell
/// in addition to the scene, of which the result has four; 9 to 13 if buildings are divided.
/// @param smallest_m2 smaller objects are not buildings
[[nodiscard]] Detection detect_buildings(const Scene& scene, const DetectOptions& options, double smallest_m2,
                                         Context& context);

}  // namespace d2b
