#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "detect/scene.hpp"
#include "detect/smoothness.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// First cell of a region in scan order.
struct FirstCell {
    std::int32_t row = 0;
    std::int32_t col = 0;

    friend bool operator==(const detect::FirstCell&, const detect::FirstCell&) = default;
};

/// Crown that was cut off a roof.
struct CutCrown {
    detect::FirstCell first;
    std::int64_t cells = 0;
};

/// Objects rejected before classification, identified by their first cells, so that objects seen by several
/// overlapping units are counted once.
struct RejectedObjects {
    std::vector<detect::FirstCell> small;  ///< objects with fewer cells than a building needs
    std::vector<detect::FirstCell> low;    ///< see low_roofs()
    std::vector<detect::CutCrown> crowns;  ///< see remove_attached_crowns(); independent of options
    std::vector<detect::FirstCell>
        parts;  ///< parts cut off by parcels that are too small or too narrow for buildings
};

/// Removes small regions and renumbers the others from 1.
/// @return first cells of the removed regions
[[nodiscard]] std::vector<detect::FirstCell> remove_small(Regions& regions, std::int64_t min_cells);

/// Finds potential roofs that are too low: smooth segments of the surface with the size of a building that
/// rise more than a metre above the ground, but nowhere by more than `min_height`.
/// @param flags result of smoothness()
/// @return their first cells
[[nodiscard]] std::vector<detect::FirstCell> low_roofs(const detect::Scene& scene,
                                                       const Grid<std::uint8_t>& flags, double min_height,
                                                       std::int64_t min_cells, Executor& threads);

/// Strongest evidence against an object being a building.
enum class CounterEvidence {
    rough,            ///< its surface is rough
    no_step,          ///< it does not rise from its surroundings in a step
    steep,            ///< its smooth segments are steep
    pieces,           ///< its smooth segments are small
    green,            ///< its NDVI is that of vegetation
    no_right_angles,  ///< its border follows no two perpendicular directions
    ragged,           ///< it is small and has arms and bays
    bridge,           ///< see doubt_bridges()
    ground            ///< see swallowed_roofs()
};
[[nodiscard]] std::string_view counter_evidence_name(detect::CounterEvidence doubt);

/// Reason why an object is left out although it resembles a building.
enum class LeftOut : std::uint8_t {
    no,
    excluded,  ///< half of it lies where there are no buildings
    denied,    ///< an editor has decided that it is none
};

/// Object above the ground that resembles a building.
struct DetectedObject {
    double confidence = 0;  ///< 0 to 1
    detect::CounterEvidence doubt = detect::CounterEvidence::rough;
    std::int64_t cells = 0;
    std::int64_t parcel = ParcelCell::no_parcel;  ///< parcel with most of its cells
    Label whole = 0;  ///< shared by all objects that one object was divided into; 0: unknown
    detect::LeftOut left_out = detect::LeftOut::no;
    bool confirmed = false;  ///< an editor has decided that it is a building
};

/// Detected objects and their cells.
struct Detection {
    Grid<Label> labels;  ///< labels up to `buildings` are buildings, higher ones doubtful objects
    std::vector<detect::DetectedObject> objects;  ///< by label - 1
    Label buildings = 0;
    detect::RejectedObjects rejected;
    SmoothnessThresholds smooth{};            ///< limits of smoothness in the usual pass
    std::vector<std::size_t> effective_cuts;  ///< index of cuts among all corrections

    [[nodiscard]] bool is_building(Label label) const { return label != 0 && label <= buildings; }
    /// Same, but not if it is left out.
    [[nodiscard]] bool is_kept_building(Label label) const {
        return is_building(label) && objects[label - 1].left_out == detect::LeftOut::no;
    }
};

/// Detects buildings by their shape. Elevated cells are joined to smooth segments, these grow over ridges,
/// dormers and chimneys, and each resulting object is classified by its roughness, the step at its border,
/// its shape, and the tilt and size of its segments (see classify()). Trees are rough, and crowns break up
/// into small, steep segments.
///
/// Corrections of the scene then make buildings of further objects (confirm_buildings()). Buildings are
/// divided by parcels and cuts if the scene has them (divide_buildings.hpp), and at steps of the surface if
/// options.split_height is set. The noise of the surface and the scale of
/// the smoothness thresholds (estimate_threshold_scale()) are estimated from the scene itself, so results for
/// a cut-out differ from those for the whole raster.
///
/// Halo: an object, the segments it meets, and 11 m and five cells around them. Memory: 5 to 9 bytes per cell
/// in addition to the scene, of which the result has four; 9 to 13 if buildings are divided.
/// @param min_area_m2 smaller objects are not buildings
[[nodiscard]] detect::Detection detect_buildings(const detect::Scene& scene, const DetectOptions& options,
                                                 double min_area_m2, Context& context);

/// Detection of the thesis preset: all cells above the ground level belong to one object with one label,
/// because the contours alone separate buildings. Pointwise: no halo, no state.
[[nodiscard]] LabelBand detect_one_label(const ElevationBand& elevations, Context& context);

}  // namespace d2b::detect
