#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// What became of an outline on its way from the trace to the file.
enum class OutlineStatus { traced, simplified, regularized, kept_traced, repaired };

/// Shares of a building's points, and the elevations that they do not exceed.
inline constexpr std::array<double, 4> percentile_shares{0.50, 0.70, 0.90, 0.95};
/// Which of them is p90, the height of a building as a whole.
inline constexpr std::size_t p90_share = 2;
using Percentiles = std::array<double, percentile_shares.size()>;

/// What is known of a contour, in the DEM's vertical unit and datum where nothing else is said. NaN is
/// unknown.
struct ContourRecord {
    std::int64_t id = 0;
    std::int64_t parent_id = 0;    ///< 0: none
    std::int64_t building_id = 0;  ///< 0: none
    std::int32_t level = 0;
    double threshold = 0;
    double base = 0;          ///< where its part of the stack begins ...
    double top = 0;           ///< ... and ends
    double height_m = 0;      ///< of the top above the ground of the stack; NaN in level 0
    double min_height_m = 0;  ///< of the base above it
    double tier_z = 0;        ///< mean of the points that no child holds
    std::int64_t points = 0;
    double lowest = 0;
    double mean = 0;
    double highest = 0;
    double confidence = 0;  ///< of its building, 0 to 1; NaN where nothing was detected
    double area_m2 = 0;
    double perimeter_m = 0;
    OutlineStatus status = OutlineStatus::traced;
};

/// What is known of a building.
struct BuildingRecord {
    std::int64_t id = 0;
    std::int64_t whole = 0;  ///< of the parts that a building was divided into, the lowest id; 0: not divided
    double ground = 0;
    double roof = 0;
    double height_m = 0;
    Percentiles heights_m{};  ///< above ground
    std::int64_t parts = 0;   ///< contours of its stack
    std::int32_t levels = 0;  ///< highest level of its stack
    std::int64_t points = 0;
    std::int64_t cells = 0;  ///< unit squares of the footprint
    double mean_m = 0;       ///< mean height above ground
    double confidence = 0;   ///< 0 to 1; NaN where nothing was detected
    std::string_view doubt;  ///< what speaks most against it being a building
    std::int64_t parcel_number = ParcelCell::nobody;
    std::string_view parcel;  ///< what identifies it; "" for none
    bool at_edge = false;
    double area_m2 = 0;
    double perimeter_m = 0;
    OutlineStatus status = OutlineStatus::traced;
    double deviation_m = 0;  ///< largest distance between the outline and its trace
    double area_change = 0;  ///< by regularisation, share of the traced area
};

/// What is known of something that was dropped, filled or changed.
struct RejectedRecord {
    std::int64_t id = 0;
    std::string_view reason;    ///< as in the report
    std::int64_t building = 0;  ///< building that it became, whose outline is another one; 0: none
    std::int64_t contour = 0;   ///< contour that it became; 0: none
    std::int32_t level = 0;
    double area_m2 = 0;
    double perimeter_m = 0;
};

/// A place at which outlines stand in the way of a surface, and what became of it.
struct ProblemRecord {
    std::int64_t id = 0;
    std::string_view kind;      ///< as in the report
    std::int64_t building = 0;  ///< 0: none
    std::int64_t other = 0;     ///< the other one of two; 0: none
    double before = 0;          ///< in the unit of the kind: m, m2 or degrees
    double after = 0;           ///< likewise
    bool changed = false;       ///< else it was left as it is
};

/// What a feature is. The fields of its layer are made from it; std::monostate where a sink is fed by others.
using FeatureRecord =
    std::variant<std::monostate, BuildingRecord, ContourRecord, RejectedRecord, ProblemRecord>;

}  // namespace d2b
