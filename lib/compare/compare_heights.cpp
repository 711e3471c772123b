#include "compare/compare_heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/statistics.hpp"

namespace d2b::compare {
namespace {

constexpr double tall_m = 2;
constexpr double tall_share = 0.5;
constexpr double same_m = 1;
constexpr double same_share = 0.25;
constexpr double moved_share = 0.6;
constexpr double sure_confidence = 0.8;
constexpr double known_share = 0.5;

/// Share of the differences that are within 1 m of a value.
double share_near(std::span<const double> differences, double value) {
    const auto near =
        std::ranges::count_if(differences, [&](double d) { return std::abs(d - value) <= same_m; });
    return static_cast<double>(near) / static_cast<double>(differences.size());
}

}  // namespace

StandsThere stands_there(std::span<const double> own, std::span<const double> other, double confidence) {
    std::vector<double> differences;
    std::size_t tall = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (std::isnan(own[i]) || std::isnan(other[i]))
            continue;
        differences.push_back(other[i] - own[i]);
        tall += other[i] >= tall_m ? 1U : 0U;
    }
    const auto known = static_cast<double>(differences.size());
    if (known == 0 || known < known_share * static_cast<double>(own.size()) ||
        static_cast<double>(tall) < tall_share * known)
        return {};
    if (share_near(differences, 0) >= same_share)
        return {true, 0};
    if (const double rise = upper_median(differences); share_near(differences, rise) >= moved_share)
        return {true, rise};
    return {confidence < sure_confidence, RoofHeights::nan};
}

}  // namespace d2b::compare
