#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/elevation_sample.hpp"
#include "core/roof_elevations.hpp"
#include "levels/level_plan.hpp"
#include "outline/outline.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

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
    double area_m2 = 0;
    double perimeter_m = 0;
    OutlineStatus status = OutlineStatus::traced;
};

/// What is known of a building.
struct BuildingRecord {
    std::int64_t id = 0;
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

/// What detection knows of a label.
struct Footprint {
    double ground = 0;      ///< elevation, in the DEM's vertical unit
    double confidence = 0;  ///< 0 to 1
    std::string_view doubt;
};

struct AttributeContext {
    const LevelPlan& plan;
    const FixedPoint& fixed;
    /// by label; empty where nothing was detected: then the ground is the lowest point beside a building
    const std::vector<Footprint>& footprints;
    double metres = 1;  ///< in one vertical unit
    LatticeBox frame;   ///< of the lattice: what touches it is cut by the raster's edge
    std::int64_t first_id = 1;
};

/// Makes records of contours, one at a time: all attributes that need no coordinates. Areas, perimeters and
/// status are filled in with the outlines.
///
/// The stack stands without gaps: a contour's part begins where that of the contour below ends (level 1: at
/// the ground) and ends at the mean of the points that no child holds, or at the children's threshold where
/// that is lower or there are no such points.
class RecordMaker {
  public:
    /// @param contours they and what the context refers to stay the caller's and must outlive this
    RecordMaker(const ContourList& contours, const AttributeContext& context);

    [[nodiscard]] std::size_t buildings() const { return stacks_.size(); }
    /// Which id the first contour has; 1 where nothing else is said.
    void number_from(std::int64_t first_id) { context_.first_id = first_id; }
    /// @param i of the contour in the list
    [[nodiscard]] ContourRecord contour(std::size_t i, const Contour& contour) const;
    /// @param record of the same contour, which is of level 1
    [[nodiscard]] BuildingRecord building(std::size_t i, const Contour& contour, const ContourRecord& record,
                                          const RoofElevations& roof) const;

  private:
    struct Part {
        double base = 0;
        double top = 0;
    };
    /// Of a building: how many contours it has, its highest level, and where it stands.
    struct StackFacts {
        std::int64_t parts = 0;
        std::int32_t levels = 0;
        double base = 0;
    };
    [[nodiscard]] double ground_of(Label label, double lowest_outside) const;
    [[nodiscard]] double threshold(const ContourHead& head) const {
        return context_.plan.threshold(head.label, head.key.level);
    }
    void stack_parts();

    const ContourList& contours_;
    AttributeContext context_;
    std::vector<Part> parts_;
    std::vector<StackFacts> stacks_;
};

/// Root mean square of the distances between the points of all stacks and the stacked surface: at a point,
/// the mean of its highest contour's own points. In the DEM's vertical unit.
class StackRmse {
  public:
    /// @param own of a contour above level 0
    void add(const PointStats& own, const FixedPoint& fixed);
    [[nodiscard]] double value() const;

  private:
    double scatter_ = 0;
    std::int64_t points_ = 0;
};

[[nodiscard]] std::string_view status_name(OutlineStatus status);

}  // namespace d2b
