#include "filter/noise.hpp"

#include "core/hundredths.hpp"

namespace d2b {
namespace {

bool is_small(std::int64_t squares, LatticePoint place, const NoiseRules& rules,
              const SquareArea& square_area) {
    return rules.min_area_m2 > 0 && static_cast<double>(squares) * square_area(place) < rules.min_area_m2;
}

}  // namespace

bool is_too_low(Label label, const RoofElevations& roof, const HeightRules& rules) {
    if (rules.min_p90_m == 0)
        return false;
    const double height = heights_above(rules.ground[label], roof, rules.metres)[p90_share];
    return !(to_hundredths(height) >= rules.min_p90_m);
}

std::optional<Reason> contour_noise(const Contour& contour, const NoiseRules& rules,
                                    const SquareArea& square_area) {
    if (contour.key.level == 0 || (contour.key.level == 1 && rules.keep_footprints))
        return {};
    if (contour.exterior.points() < rules.noise_factor)
        return Reason::contour_short;
    if (is_small(contour.squares(), contour.key.first, rules, square_area))
        return Reason::contour_small;
    return {};
}

std::optional<Reason> hole_noise(const PackedRing& hole, std::int32_t level, const NoiseRules& rules,
                                 const SquareArea& square_area) {
    if (level == 1 && rules.keep_footprints)
        return {};
    if (hole.points() < rules.noise_factor)
        return Reason::hole_short;
    if (is_small(-hole.area(), hole.start(), rules, square_area))
        return Reason::hole_small;
    return {};
}

}  // namespace d2b
