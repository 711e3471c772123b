#include "compare/surveyed_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace d2b::compare {
namespace {

/// True if all percentiles are known, and in order.
bool is_complete(const RoofHeights& heights) {
    const Percentiles& known = heights.percentiles;
    return std::ranges::none_of(known, [](double h) { return std::isnan(h); }) &&
           std::ranges::is_sorted(known) && heights.highest >= known.back();
}

/// Returns the share of a building that does not exceed a height. Linear between its percentiles; the lowest
/// point is taken at half of the median, because it is not recorded.
double share_below(const RoofHeights& heights, double height) {
    if (!is_complete(heights))
        return height >= heights.p90() ? 1 : 0;
    double share = 0;
    double from = heights.percentiles.front() / 2;
    const auto part_up_to = [&](double to, double share_to) {
        const double part = to > from ? std::clamp((height - from) / (to - from), 0.0, 1.0)
                                      : static_cast<double>(height >= to);
        const double result = share + (share_to - share) * part;
        share = share_to;
        from = to;
        return result;
    };
    for (std::size_t i = 0; i < percentile_shares.size(); ++i) {
        const double to = heights.percentiles[i];
        const double result = part_up_to(to, percentile_shares[i]);
        if (height < to)
            return result;
    }
    return part_up_to(heights.highest, 1);
}

/// Height that a share of the area does not exceed.
double joint_percentile(std::span<const SurveyedBuilding* const> buildings, double joint_share, double high) {
    double area = 0;
    for (const SurveyedBuilding* const building : buildings)
        area += building->area_m2;
    constexpr double accuracy_m = 1e-4;
    double low = 0;
    while (high - low > accuracy_m) {
        const double middle = (low + high) / 2;
        double below = 0;
        for (const SurveyedBuilding* const building : buildings)
            below += building->area_m2 * share_below(building->heights, middle);
        (below >= joint_share * area ? high : low) = middle;
    }
    return high;
}

}  // namespace

RoofHeights joint_heights(std::span<const SurveyedBuilding* const> buildings) {
    if (buildings.size() == 1)
        return buildings.front()->heights;
    RoofHeights joint;
    double highest = 0;
    for (const SurveyedBuilding* const building : buildings) {
        const RoofHeights& heights = building->heights;
        if (std::isnan(heights.p90()))
            return {};
        highest = std::max(highest, is_complete(heights) ? heights.highest : heights.p90());
    }
    for (std::size_t i = 0; i < percentile_shares.size(); ++i)
        joint.percentiles[i] = joint_percentile(buildings, percentile_shares[i], highest);
    joint.highest = highest;
    return joint;
}

double rise_m(const RoofHeights& before, const RoofHeights& after) {
    const double of_p90 = after.p90() - before.p90();
    if (!is_complete(before) || !is_complete(after))
        return of_p90;
    std::array<double, p90_share + 1> changes{};
    for (std::size_t i = 0; i < changes.size(); ++i)
        changes[i] = after.percentiles[i] - before.percentiles[i];
    std::ranges::sort(changes);
    return changes[1];
}

}  // namespace d2b::compare
