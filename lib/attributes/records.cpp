#include "attributes/records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace d2b {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Points of each contour with all that stands on it: children come after their parents.
std::vector<PointStats> totals(const std::vector<Contour>& contours) {
    std::vector<PointStats> result(contours.size());
    for (std::size_t i = contours.size(); i-- > 0;) {
        result[i].merge(contours[i].own);
        if (contours[i].parent >= 0)
            result[static_cast<std::size_t>(contours[i].parent)].merge(result[i]);
    }
    return result;
}

/// The lowest threshold among each contour's children, +infinity where it has none.
std::vector<double> child_thresholds(const std::vector<ContourRecord>& records) {
    std::vector<double> result(records.size(), std::numeric_limits<double>::infinity());
    const std::int64_t first = records.empty() ? 0 : records.front().id;
    for (const ContourRecord& record : records)
        if (record.parent_id > 0) {
            double& lowest = result[static_cast<std::size_t>(record.parent_id - first)];
            lowest = std::min(lowest, record.threshold);
        }
    return result;
}

ContourRecord contour_record(const ContourTable& table, std::size_t i, const PointStats& total,
                             const AttributeContext& context) {
    const Contour& contour = table.contours[i];
    ContourRecord record;
    record.id = context.first_id + static_cast<std::int64_t>(i);
    record.parent_id = contour.parent < 0 ? 0 : context.first_id + contour.parent;
    record.building_id = table.building[i] < 0 ? 0 : context.first_id + table.building[i];
    record.level = contour.key.level;
    record.threshold = context.plan.threshold(contour.label, record.level);
    record.tier_z = contour.own.n > 0 ? context.fixed.mean(contour.own.sum, contour.own.n) : unknown;
    record.points = total.n;
    record.lowest = total.n > 0 ? total.lowest : unknown;
    record.mean = total.n > 0 ? context.fixed.mean(total.sum, total.n) : unknown;
    record.highest = total.n > 0 ? total.highest : unknown;
    return record;
}

double ground_of(const ContourTable& table, const Contour& contour) {
    if (!table.footprints.empty())
        return table.footprints[contour.label].ground;
    return std::isfinite(contour.lowest_outside) ? contour.lowest_outside : unknown;
}

/// Base and top of every part, from the low level to the high.
void stack_parts(const ContourTable& table, std::vector<ContourRecord>& records) {
    const std::vector<double> above = child_thresholds(records);
    for (std::size_t i = 0; i < records.size(); ++i) {
        ContourRecord& record = records[i];
        record.base = record.threshold;
        const double ground = record.level == 1 ? ground_of(table, table.contours[i]) : unknown;
        if (record.level == 1)
            record.base = std::isnan(ground) ? record.threshold : std::min(ground, record.threshold);
        else if (record.level > 1)
            record.base = records[static_cast<std::size_t>(table.contours[i].parent)].top;
        const double tier = std::isnan(record.tier_z) ? above[i] : record.tier_z;
        record.top = std::max(record.base, std::min(tier, above[i]));
        if (!std::isfinite(record.top))
            record.top = std::max(record.base, record.threshold);  // no point was counted for it
    }
}

/// Heights of every part above the ground of its stack, which is the base of level 1.
void measure_parts(const ContourTable& table, double metres, std::vector<ContourRecord>& records) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        ContourRecord& record = records[i];
        record.height_m = record.min_height_m = unknown;
        if (record.level == 0 || table.building[i] < 0)
            continue;
        const auto building = static_cast<std::size_t>(table.building[i]);
        const double ground = records[static_cast<std::size_t>(table.buildings[building])].base;
        record.height_m = (record.top - ground) * metres;
        record.min_height_m = (record.base - ground) * metres;
    }
}

BuildingRecord building_record(const ContourTable& table, std::size_t b, const ContourRecord& base,
                               const AttributeContext& context) {
    const Contour& contour = table.contours[static_cast<std::size_t>(table.buildings[b])];
    BuildingRecord record;
    record.id = context.first_id + static_cast<std::int64_t>(b);
    record.ground = ground_of(table, contour);
    record.roof = base.highest;
    record.height_m = (record.roof - record.ground) * context.metres;
    for (std::size_t i = 0; i < percentile_shares.size(); ++i)
        record.heights_m[i] =
            base.points > 0
                ? (std::min(table.percentiles[b][i], base.highest) - record.ground) * context.metres
                : unknown;
    record.points = base.points;
    record.cells = contour.squares();
    record.mean_m = (base.mean - record.ground) * context.metres;
    record.confidence = table.footprints.empty() ? unknown : table.footprints[contour.label].confidence;
    if (!table.footprints.empty())
        record.doubt = table.footprints[contour.label].doubt;
    const LatticeBox box = contour.exterior.box();
    record.at_edge = box.low.row <= context.frame.low.row || box.low.col <= context.frame.low.col ||
                     box.high.row >= context.frame.high.row || box.high.col >= context.frame.high.col;
    return record;
}

}  // namespace

Records make_records(const ContourTable& table, const AttributeContext& context) {
    const std::vector<PointStats> total = totals(table.contours);
    Records records;
    for (std::size_t i = 0; i < table.contours.size(); ++i)
        records.contours.push_back(contour_record(table, i, total[i], context));
    stack_parts(table, records.contours);
    measure_parts(table, context.metres, records.contours);
    for (std::size_t b = 0; b < table.buildings.size(); ++b)
        records.buildings.push_back(building_record(
            table, b, records.contours[static_cast<std::size_t>(table.buildings[b])], context));
    for (std::size_t i = 0; i < table.contours.size(); ++i)
        if (table.building[i] >= 0) {
            BuildingRecord& building = records.buildings[static_cast<std::size_t>(table.building[i])];
            ++building.parts;
            building.levels = std::max(building.levels, table.contours[i].key.level);
        }
    return records;
}

double stack_rmse(const std::vector<Contour>& contours, const FixedPoint& fixed, Label last_building) {
    double scatter = 0;
    std::int64_t points = 0;
    for (const Contour& contour : contours)
        if (contour.key.level > 0 && contour.label <= last_building) {
            scatter += fixed.scatter(contour.own);
            points += contour.own.n;
        }
    return points > 0 ? std::sqrt(scatter / static_cast<double>(points)) : 0;
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
    }
    return "";
}

}  // namespace d2b
