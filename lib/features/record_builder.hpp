#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "contours/contour.hpp"
#include "contours/level_plan.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/records.hpp"
#include "outline/outline.hpp"

namespace d2b::features {

/// Results of detection for a label.
struct Footprint {
    double ground = 0;      ///< elevation, in the DEM's vertical unit
    double confidence = 0;  ///< between 0 and 1
    std::string_view doubt;
    std::int64_t parcel = ParcelCell::no_parcel;
    std::int64_t whole = 0;  ///< shared by all labels into which a building was divided; 0: not divided
};

struct AttributeContext {
    const contours::LevelPlan& plan;
    const FixedPoint& fixed;
    /// by label; empty if nothing was detected: the ground is then the lowest point next to a building
    const std::vector<Footprint>& footprints;
    double metres = 1;  ///< metres per vertical unit
    LatticeBox frame;   ///< bounds of the lattice: an object that touches them is cut by the raster's edge
};

/// Computes the records of contours, one at a time: all attributes that need no coordinates. Areas,
/// perimeters and status are filled in with the outlines, ids when they are written.
///
/// The parts of a stack join without gaps: the part of a contour begins at the end of that of the
/// contour below (in level 1: at the ground). It ends at the mean of the points outside its children, or at
/// the threshold of the children if that is lower or there are no such points.
class RecordBuilder {
  public:
    /// @param contours must outlive this object, as must all that the context refers to
    RecordBuilder(const contours::ContourList& contours, const AttributeContext& context);

    /// Base and top of the part of a contour, as in its record. @param i index of the contour in the list
    [[nodiscard]] double base(std::size_t i) const { return parts_[i].base; }
    [[nodiscard]] double top(std::size_t i) const { return parts_[i].top; }
    /// @param i index of the contour in the list
    [[nodiscard]] ContourRecord contour(std::size_t i, const contours::Contour& contour) const;
    /// The whole of the record is that of the footprint, which FeatureWriter replaces by an id.
    /// @param record of the same contour, which must be of level 1
    [[nodiscard]] BuildingRecord building(std::size_t i, const contours::Contour& contour,
                                          const ContourRecord& record, const RoofElevations& roof) const;

  private:
    struct Part {
        double base = 0;
        double top = 0;
    };
    /// Number of contours, highest level and base of a building.
    struct StackSummary {
        std::int64_t parts = 0;
        std::int32_t levels = 0;
        double base = 0;
    };
    [[nodiscard]] double ground_of(Label label, double lowest_outside) const;
    [[nodiscard]] double threshold(const contours::ContourHead& head) const {
        return context_.plan.threshold(head.label, head.key.level);
    }
    void compute_part_heights();

    const contours::ContourList& contours_;
    AttributeContext context_;
    std::vector<Part> parts_;
    std::vector<StackSummary> stacks_;
};

/// Root mean square distance between the points of all stacks and the stacked surface (at a point: the mean
/// of the own points of its highest contour), in the DEM's vertical unit. The sum is exact, so the order of
/// contours does not matter.
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

}  // namespace d2b::features
