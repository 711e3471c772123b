#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detect/candidates.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::test {

inline constexpr double min_area_m2 = 30;
inline constexpr Block smooth_house{4, 4, 10, 10};
inline constexpr Block rough_house{15, 20, 21, 26};

/// Odd rows and odd columns are 0.3 m higher each, so that all bend by 0.6 m, and every other cell of the
/// diagonals by more. Where a quarter of the cells was filled that is too much for a first look (0.51 m) and
/// little enough for wider limits (0.71 m) and for a second look (0.82 m).
inline void build_rough(Town& town, const Block& block) {
    town.build([&](std::int32_t r, std::int32_t c) {
        const bool in = r >= block.top && r < block.bottom && c >= block.left && c < block.right;
        return in ? 106 + 0.3F * static_cast<float>(r % 2 + c % 2) : unknown;
    });
}

inline void build_smooth(Town& town, const Block& block) {
    town.block(block.top, block.left, block.bottom, block.right, 106);
}

inline Town two_houses() {
    Town town(30, 40, {2.5, 2.5});
    build_smooth(town, smooth_house);
    build_rough(town, rough_house);
    return town;
}

/// Objects of a drawing with confidences, in scan order.
inline detect::Candidates judged(const std::vector<std::string>& rows,
                                 const std::vector<double>& confidences) {
    detect::Candidates result;
    result.regions = connected_regions(drawn(rows), 1, 0, threads());
    for (const double confidence : confidences) {
        detect::ObjectFeatures features;
        features.smooth = confidence;
        result.features.push_back(features);
        result.objects.push_back(
            {confidence, detect::CounterEvidence::rough, result.regions.cells[result.objects.size() + 1]});
    }
    return result;
}

}  // namespace d2b::test
