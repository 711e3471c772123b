#include "detect/several_limits.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "detect/best_of_looks.hpp"
#include "detect/odds.hpp"

namespace d2b {
namespace {

// Fitted on La Rochelle, on simulated sparse scans of high-resolution places, and on scenes, see
// docs/accuracy.md.
constexpr double least_filled_for_several = 0.06;
constexpr double least_side_for_several_m = 1.9;  // map cells of 2 m may be slightly smaller on the ground
constexpr std::array<double, 4> factors{0.5, 0.7, 1, 1.4};
constexpr std::size_t usual_place = 2;
constexpr double caution_at_wider = 1.1;  // penalty on the log-odds

JudgedObjects found_at(double factor, const Scene& scene, SceneCells& cells, double smallest_m2,
                       SurfaceQuality quality, Executor& threads) {
    quality.strictness *= factor;
    quality.allowance *= factor;
    JudgedObjects judged = judged_objects(scene, cells, smallest_m2, quality, threads);
    if (factor > 1)
        for (DetectedObject& object : judged.objects)
            object.confidence = less_sure(object.confidence, caution_at_wider);
    return judged;
}

}  // namespace

bool deserves_several_limits(double side, double filled) {
    return filled > least_filled_for_several || side > least_side_for_several_m;
}

JudgedObjects chosen_at_several_limits(const Scene& scene, SceneCells& cells, double smallest_m2,
                                       const SurfaceQuality& quality, JudgedObjects usual,
                                       Executor& threads) {
    std::array<JudgedObjects, factors.size()> looks;
    looks[usual_place] = std::move(usual);
    for (std::size_t i = 0; i < factors.size(); ++i)
        if (i != usual_place)
            looks[i] = found_at(factors[i], scene, cells, smallest_m2, quality, threads);
    return best_of_looks(looks, usual_place, threads);
}

}  // namespace d2b
