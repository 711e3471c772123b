#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <variant>

#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// Processing state of an outline between trace and file, or that it was given.
enum class OutlineStatus { traced, simplified, regularized, kept_traced, repaired, given };

/// Percentiles of a building's elevations that are recorded, as shares of its points.
inline constexpr std::array<double, 4> percentile_shares{0.50, 0.70, 0.90, 0.95};
/// Index of p90, which is the height of a building as a whole.
inline constexpr std::size_t p90_share = 2;
using Percentiles = std::array<double, percentile_shares.size()>;

/// Attributes of a contour, in the DEM's vertical unit and datum unless stated otherwise. NaN: unknown.
struct ContourRecord {
    std::int64_t id = 0;
    std::int64_t parent_id = 0;    ///< 0: none
    std::int64_t building_id = 0;  ///< 0: none
    std::int32_t level = 0;
    double threshold = 0;
    double base = 0;          ///< lower end of its part of the stack
    double top = 0;           ///< upper end of its part of the stack
    double height_m = 0;      ///< height of `top` above the ground of the stack; NaN in level 0
    double min_height_m = 0;  ///< height of `base` above the ground of the stack
    double tier_z = 0;        ///< mean of the points outside its children
    std::int64_t points = 0;
    double lowest = 0;
    double mean = 0;
    double highest = 0;
    double confidence = 0;  ///< confidence of its building, between 0 and 1; NaN without detection
    double area_m2 = 0;
    double perimeter_m = 0;
    OutlineStatus status = OutlineStatus::traced;
};

/// Roof of a building as a whole, from its faces. NaN: unknown.
struct RoofRecord {
    std::string_view type;  ///< "" without -roofs
    double flat_share = 0;  ///< area of flat faces as a share of the footprint
    double ridge_z = 0;     ///< highest corner of its faces, in the vertical unit
    double eave_z = 0;      ///< mean over its faces of their lowest corners, weighted by area
    double rmse_m = 0;      ///< of its faces against the elevations
};

/// Attributes of a building.
struct BuildingRecord {
    std::int64_t id = 0;
    std::int64_t whole = 0;  ///< lowest id among the parts of a divided building; 0: not divided
    double ground = 0;
    double roof = 0;
    double height_m = 0;
    Percentiles heights_m{};  ///< above ground
    std::int64_t parts = 0;   ///< contours in its stack
    std::int32_t levels = 0;  ///< highest level in its stack
    std::int64_t points = 0;
    std::int64_t cells = 0;  ///< unit squares of the footprint
    double mean_m = 0;       ///< mean height above ground
    double confidence = 0;   ///< between 0 and 1; NaN without detection
    std::string_view doubt;  ///< strongest evidence against a building
    std::int64_t parcel_number = ParcelCell::no_parcel;
    std::string_view parcel;  ///< identifier of its parcel; "" if there is none
    bool at_edge = false;
    double area_m2 = 0;
    double perimeter_m = 0;
    OutlineStatus status = OutlineStatus::traced;
    double deviation_m = 0;             ///< largest distance between the outline and its trace
    double area_change = 0;             ///< change by regularisation, share of the traced area
    double storey_m = 3;                ///< height of a storey, for the number of floors
    RoofRecord roof_shape;              ///< with -roofs
    double seen_share = unknown_share;  ///< cells of a given footprint that rise by -min_height
    double tree_share = unknown_share;  ///< cells of a given footprint that look like trees
    double shift_m = unknown_share;     ///< move that brings a given footprint onto walls

    static constexpr double unknown_share = std::numeric_limits<double>::quiet_NaN();
};

/// Attributes of an object that was dropped, filled or changed.
struct RejectedRecord {
    std::int64_t id = 0;
    std::string_view reason;    ///< one of reason_names
    std::int64_t building = 0;  ///< resulting building, whose outline differs; 0: none
    std::int64_t contour = 0;   ///< resulting contour; 0: none
    std::int32_t level = 0;
    double area_m2 = 0;
    double perimeter_m = 0;
};

/// Place at which outlines prevented a closed surface, and the solution.
struct ProblemRecord {
    std::int64_t id = 0;
    std::string_view kind;      ///< name as in the report
    std::int64_t building = 0;  ///< 0: none
    std::int64_t other = 0;     ///< second building of a pair; 0: none
    double before = 0;          ///< size in the unit of the kind: m, m2 or degrees
    double after = 0;           ///< size in the same unit
    bool changed = false;       ///< false if it was left as it is
};

/// Attributes of a face of a roof. NaN: unknown.
struct RoofFaceRecord {
    std::int64_t id = 0;
    std::int64_t building_id = 0;
    std::int64_t whole = 0;  ///< see BuildingRecord
    double slope = 0;        ///< degrees
    double azimuth = 0;      ///< degrees clockwise from north in which water runs
    double area_m2 = 0;      ///< in plan
    double roof_m2 = 0;      ///< along the slope
    double lowest = 0;       ///< of its corners, in the vertical unit
    double highest = 0;
    double rmse_m = 0;
    std::int64_t cells = 0;
    std::string_view kind;  ///< flat, pitched or doubtful
};

/// Typed attributes of a feature, from which the fields of its layer are made; std::monostate if a sink is
/// fed by other programs.
using FeatureRecord = std::variant<std::monostate, BuildingRecord, ContourRecord, RejectedRecord,
                                   ProblemRecord, RoofFaceRecord>;

}  // namespace d2b
