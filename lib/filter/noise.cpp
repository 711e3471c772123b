#include "filter/noise.hpp"

namespace d2b {
namespace {

bool is_small(std::int64_t squares, LatticePoint place, const FilterOptions& options,
              const SquareArea& square_area) {
    const double least = options.min_area_m2.value_or(0);
    return least > 0 && static_cast<double>(squares) * square_area(place) < least;
}

}  // namespace

std::optional<Reason> contour_noise(const Contour& contour, const FilterOptions& options,
                                    const SquareArea& square_area) {
    if (contour.key.level == 0 || (contour.key.level == 1 && options.keep_footprints))
        return {};
    if (contour.exterior.points() < options.noise_factor)
        return Reason::contour_short;
    if (is_small(contour.squares(), contour.key.first, options, square_area))
        return Reason::contour_small;
    return {};
}

std::optional<Reason> hole_noise(const PackedRing& hole, std::int32_t level, const FilterOptions& options,
                                 const SquareArea& square_area) {
    if (level == 1 && options.keep_footprints)
        return {};
    if (hole.points() < options.noise_factor)
        return Reason::hole_short;
    if (is_small(-hole.area(), hole.start(), options, square_area))
        return Reason::hole_small;
    return {};
}

}  // namespace d2b
