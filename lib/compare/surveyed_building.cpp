#include "compare/surveyed_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace d2b::compare {
namespace {

constexpr double joint_share = percentile_shares[p90_share];

/// Returns the share of a building that does not exceed a height. Linear between its percentiles; the lowest
/// point is taken at half of the median, because it is not recorded.
double share_below(const RoofHeights& heights, double height) {
    const Percentiles& known = heights.percentiles;
    const bool complete = std::ranges::none_of(known, [](double h) { return std::isnan(h); });
    if (!complete || !(heights.highest >= known.back()))
        return height >= heights.p90() ? 1 : 0;
    double share = 0;
    double from = known.front() / 2;
    const auto passes = [&](double to, double share_to) {
        if (height < to) {
            share += (share_to - share) * std::clamp((height - from) / (to - from), 0.0, 1.0);
            return false;
        }
        share = share_to;
        from = to;
        return true;
    };
    for (std::size_t i = 0; i < known.size(); ++i)
        if (!passes(known[i], percentile_shares[i]))
            return share;
    static_cast<void>(passes(heights.highest, 1));
    return share;
}

}  // namespace

double joint_p90(std::span<const SurveyedBuilding* const> buildings) {
    if (buildings.size() == 1)
        return buildings.front()->heights.p90();
    double area = 0;
    double low = 0;
    double high = 0;
    for (const SurveyedBuilding* const building : buildings) {
        const RoofHeights& heights = building->heights;
        if (std::isnan(heights.p90()))
            return RoofHeights::nan;
        area += building->area_m2;
        high = std::max({high, heights.p90(), std::isnan(heights.highest) ? 0 : heights.highest});
    }
    constexpr double accuracy_m = 1e-4;
    while (high - low > accuracy_m) {
        const double middle = (low + high) / 2;
        double below = 0;
        for (const SurveyedBuilding* const building : buildings)
            below += building->area_m2 * share_below(building->heights, middle);
        (below >= joint_share * area ? high : low) = middle;
    }
    return high;
}

}  // namespace d2b::compare
