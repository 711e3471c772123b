#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/elevation_sample.hpp"
#include "core/exact_sum.hpp"
#include "core/roof_elevations.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/records.hpp"
#include "levels/level_plan.hpp"
#include "outline/outline.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// What detection knows of a label.
struct Footprint {
    double ground = 0;      ///< elevation, in the DEM's vertical unit
    double confidence = 0;  ///< 0 to 1
    std::string_view doubt;
    std::int64_t parcel = ParcelCell::nobody;
    Label whole = 0;  ///< the same of all labels that a building was divided into; 0: it is not known
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

    /// Where the part of a contour begins and ends, as its record has it. @param i of the contour in the list
    [[nodiscard]] double base(std::size_t i) const { return parts_[i].base; }
    [[nodiscard]] double top(std::size_t i) const { return parts_[i].top; }
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
        std::int64_t whole = 0;  ///< number of the building that it is a part of; 0: it is one itself
    };
    [[nodiscard]] double ground_of(Label label, double lowest_outside) const;
    [[nodiscard]] double threshold(const ContourHead& head) const {
        return context_.plan.threshold(head.label, head.key.level);
    }
    void stack_parts();
    void find_wholes();

    const ContourList& contours_;
    AttributeContext context_;
    std::vector<Part> parts_;
    std::vector<StackFacts> stacks_;
};

/// Root mean square of the distances between the points of all stacks and the stacked surface: at a point,
/// the mean of its highest contour's own points. In the DEM's vertical unit. An exact sum: the
/// order in which contours come does not matter.
class StackRmse {
  public:
    /// @param own of a contour above level 0
    void add(const PointStats& own, const FixedPoint& fixed);
    [[nodiscard]] double value() const;

  private:
    ExactSum scatter_;
    std::int64_t points_ = 0;
};

[[nodiscard]] std::string_view status_name(OutlineStatus status);

}  // namespace d2b
