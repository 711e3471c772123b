#include <algorithm>
#include <optional>
#include <utility>

#include "filter/noise.hpp"

namespace d2b {
namespace {

std::optional<Reason> noise(const PackedRing& hole, std::int32_t level, const FilterOptions& options,
                            const SquareArea& square_area) {
    if (level == 1 && options.keep_footprints)
        return {};
    if (hole.points() < options.noise_factor)
        return Reason::hole_short;
    const double least = options.min_area_m2.value_or(0);
    if (least > 0 && static_cast<double>(-hole.area()) * square_area(hole.start()) < least)
        return Reason::hole_small;
    return {};
}

/// Whether any of the keys, sorted, is of the level and lies in the ring: the rows of the ring are searched.
bool any_inside(const std::vector<ContourKey>& keys, std::int32_t level, const PackedRing& hole) {
    const LatticeBox box = hole.box();
    std::optional<LatticeRing> ring;
    for (std::int32_t row = box.low.row; row < box.high.row; ++row) {
        auto key = std::lower_bound(keys.begin(), keys.end(), ContourKey{level, {row, box.low.col}});
        for (; key != keys.end() && *key < ContourKey{level, {row, box.high.col}}; ++key) {
            if (!ring)
                ring = hole.corners();
            if (contains(*ring, key->first))
                return true;
        }
    }
    return false;
}

}  // namespace

void fill_holes(std::vector<Contour>& contours, const FilterOptions& options, const SquareArea& square_area,
                Context& context) {
    std::vector<ContourKey> keys;
    keys.reserve(contours.size());
    for (const Contour& contour : contours)
        keys.push_back(contour.key);
    // An interior ring starts at the first square inside it: of the level below, those that remain.
    std::vector<ContourKey> remaining_below;
    std::vector<ContourKey> remaining;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        const std::int32_t level = contours[i].key.level;
        if (i == 0 || level != contours[i - 1].key.level) {
            std::sort(remaining.begin(), remaining.end());
            remaining_below = std::exchange(remaining, {});
        }
        std::erase_if(contours[i].interiors, [&](const PackedRing& hole) {
            const auto reason = noise(hole, level, options, square_area);
            const bool fill =
                reason && !any_inside(keys, level, hole) && !any_inside(remaining_below, level - 1, hole);
            if (fill)
                context.report.count(*reason);
            else
                remaining.push_back({level, hole.start()});
            return fill;
        });
    }
}

}  // namespace d2b
