#include "features/record_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace d2b::features {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double no_limit = std::numeric_limits<double>::infinity();

bool touches(const LatticeBox& box, const LatticeBox& frame) {
    return box.low.row <= frame.low.row || box.low.col <= frame.low.col || box.high.row >= frame.high.row ||
           box.high.col >= frame.high.col;
}

}  // namespace

RecordBuilder::RecordBuilder(const contours::ContourList& contours, const AttributeContext& context)
    : contours_(contours), context_(context) {
    compute_part_heights();
    for (std::size_t i = 0; i < contours.size(); ++i) {
        const contours::ContourHead& head = contours.head(i);
        if (head.building < 0)
            continue;
        const auto building = static_cast<std::size_t>(head.building);
        stacks_.resize(std::max(stacks_.size(), building + 1));
        if (head.key.level == 1)
            stacks_[building].base = parts_[i].base;
        ++stacks_[building].parts;
        stacks_[building].levels = std::max(stacks_[building].levels, head.key.level);
    }
}

double RecordBuilder::ground_of(Label label, double lowest_outside) const {
    if (!context_.footprints.empty())
        return context_.footprints[label].ground;
    return std::isfinite(lowest_outside) ? lowest_outside : unknown;
}

/// Computes base and top of every part, from the lowest level to the highest.
void RecordBuilder::compute_part_heights() {
    parts_.assign(contours_.size(), {0, no_limit});
    // First pass: `top` is the lowest threshold of the contours on top of it.
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (const contours::ContourHead& head = contours_.head(i); head.parent >= 0) {
            double& above = parts_[static_cast<std::size_t>(head.parent)].top;
            above = std::min(above, threshold(head));
        }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const contours::ContourHead& head = contours_.head(i);
        auto& [base, top] = parts_[i];
        base = threshold(head);
        if (head.key.level == 1) {
            const double ground = ground_of(head.label, head.lowest_outside);
            base = std::isnan(ground) ? base : std::min(ground, base);
        } else if (head.key.level > 1) {
            base = parts_[static_cast<std::size_t>(head.parent)].top;
        }
        const double tier = std::isnan(head.tier_z) ? top : head.tier_z;
        top = std::max(base, std::min(tier, top));
        if (!std::isfinite(top))
            top = std::max(base, threshold(head));  // no points were counted
    }
}

ContourRecord RecordBuilder::contour(std::size_t i, const contours::Contour& contour) const {
    const contours::ContourHead& head = contours_.head(i);
    PointStats total = contour.own;
    total.merge(contour.above);
    ContourRecord record;
    record.level = head.key.level;
    record.threshold = threshold(head);
    record.base = parts_[i].base;
    record.top = parts_[i].top;
    const double ground = head.building < 0 ? unknown : stacks_[static_cast<std::size_t>(head.building)].base;
    record.height_m = (record.top - ground) * context_.metres;
    record.min_height_m = (record.base - ground) * context_.metres;
    record.tier_z = head.tier_z;
    record.points = total.n;
    record.lowest = total.n > 0 ? total.lowest : unknown;
    record.mean = total.n > 0 ? context_.fixed.mean(total.sum, total.n) : unknown;
    record.highest = total.n > 0 ? total.highest : unknown;
    record.confidence = context_.footprints.empty() ? unknown : context_.footprints[head.label].confidence;
    return record;
}

BuildingRecord RecordBuilder::building(std::size_t i, const contours::Contour& contour,
                                       const ContourRecord& record, const RoofElevations& roof) const {
    const contours::ContourHead& head = contours_.head(i);
    const StackSummary& stack = stacks_[static_cast<std::size_t>(head.building)];
    BuildingRecord building;
    building.ground = ground_of(head.label, head.lowest_outside);
    building.roof = roof.highest;
    building.height_m = (building.roof - building.ground) * context_.metres;
    building.heights_m = heights_above(building.ground, roof, context_.metres);
    building.parts = stack.parts;
    building.levels = stack.levels;
    building.points = record.points;
    building.cells = contour.squares();
    building.mean_m = (record.mean - building.ground) * context_.metres;
    const auto& footprints = context_.footprints;
    building.confidence = footprints.empty() ? unknown : footprints[head.label].confidence;
    if (!footprints.empty()) {
        building.doubt = footprints[head.label].doubt;
        building.parcel_number = footprints[head.label].parcel;
        building.whole = footprints[head.label].whole;
    }
    building.at_edge = touches(contour.exterior.box(), context_.frame);
    return building;
}

void StackRmse::add(const PointStats& own, const FixedPoint& fixed) {
    scatter_.add(fixed.sum_of_squared_deviations(own));
    points_ += own.n;
}

double StackRmse::value() const {
    return points_ > 0 ? std::sqrt(scatter_.value() / static_cast<double>(points_)) : 0;
}

std::string_view status_name(OutlineStatus status) {
    switch (status) {
        case OutlineStatus::traced:
            return "traced";
        case OutlineStatus::simplified:
            return "simplified";
        case OutlineStatus::regularized:
            return "regularized";
        case OutlineStatus::kept_traced:
            return "kept_traced";
        case OutlineStatus::repaired:
            return "repaired";
        case OutlineStatus::given:
            return "given";
    }
    return "";
}

}  // namespace d2b::features
