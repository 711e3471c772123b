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

/// What speaks most against an object being a building.
enum class Doubt {
    rough,            ///< its surface bends from cell to cell
    no_step,          ///< it does not rise from its surroundings in a step
    steep,            ///< its smooth pieces are steep
    pieces,           ///< its smooth pieces are small
    green,            ///< its NDVI is that of plants
    no_right_angles,  ///< its border keeps to no two directions
    ragged            ///< it is small and has arms and bays
};
[[nodiscard]] std::string_view doubt_name(Doubt doubt);

/// Something that stands on the ground and looks like a building, or nearly so.
struct DetectedObject {
    double confidence = 0;  ///< 0 to 1
    Doubt doubt = Doubt::rough;
    std::int64_t cells = 0;
    std::int64_t parcel = ParcelCell::nobody;  ///< that holds most of it
    Label whole = 0;  ///< the same of all objects that one was divided into; 0: it is not known
};

/// Objects and where they are.
struct Detection {
    Grid<Label> labels;                   ///< 1 to buildings: buildings; above: what is doubtful
    std::vector<DetectedObject> objects;  ///< by label - 1
    Label buildings = 0;
    LeftOut left_out;

    [[nodiscard]] bool is_building(Label label) const { return label != 0 && label <= buildings; }
};

/// Finds buildings by their form: elevated cells are joined to smooth segments, these grow over what roofs
/// have between them, and each object that results is judged by its smoothness, the step along its border,
/// and the tilt and size of its segments. Trees are rough, and crowns shatter into small, steep segments.
/// Where the scene has parcels, buildings are cut by them, see detect/cut_by_parcels.hpp; where
/// options.split_height is set, they are then divided, see detect/split.hpp.
/// @param smallest_m2 what covers less is none
/// Halo: an object, the segments that it meets, and 11 m and five cells around them. Memory: 5 to 9 bytes
/// a cell beside the scene, the result's four among them; 9 to 13 where buildings are divided.
/// The noise of the surface, and how smooth a roof must be, see roof_strictness(), are found from the scene.
[[nodiscard]] Detection detect_buildings(const Scene& scene, const DetectOptions& options, double smallest_m2,
                                         Context& context);

}  // namespace d2b
