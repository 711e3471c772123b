#include "contours/noise.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/text.hpp"

namespace d2b::contours {
namespace {

bool is_small(std::int64_t squares, LatticePoint place, const NoiseRules& rules,
              const SquareArea& square_area) {
    return rules.min_area_m2 > 0 && static_cast<double>(squares) * square_area(place) < rules.min_area_m2;
}

using Keys = std::span<const ContourKey>;

/// Returns true if any of the sorted keys of a level lies in a row between two columns.
bool any_in_run(Keys keys, std::int32_t level, LatticePoint from, std::int32_t end) {
    const auto key = std::ranges::lower_bound(keys, ContourKey{level, from});
    return key != keys.end() && *key < ContourKey{level, {from.row, end}};
}

bool any_in_box(Keys keys, std::int32_t level, const Hole& hole) {
    for (std::int32_t row = hole.low.row; row < hole.high.row; ++row)
        if (any_in_run(keys, level, {row, hole.low.col}, hole.high.col))
            return true;
    return false;
}

/// Sorted crossings of a rectilinear ring with the center lines of rows. By the even-odd rule, the interior
/// lies between the first and second crossing of a row, the third and fourth, and so on.
std::vector<LatticePoint> crossings(const LatticeRing& ring) {
    std::vector<LatticePoint> result;
    LatticePoint from = ring.back();
    for (const LatticePoint to : ring) {
        for (std::int32_t row = std::min(from.row, to.row); row < std::max(from.row, to.row); ++row)
            result.push_back({row, from.col});
        from = to;
    }
    std::ranges::sort(result);
    return result;
}

bool any_inside(Keys keys, std::int32_t level, std::span<const LatticePoint> crossings) {
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        if (any_in_run(keys, level, crossings[i], crossings[i + 1].col))
            return true;
    return false;
}

}  // namespace

bool is_too_low(Label label, const RoofElevations& roof, const HeightRules& rules) {
    if (rules.min_p90_m == 0)
        return false;
    const double height = heights_above(rules.ground[label], roof, rules.metres)[p90_share];
    return !(round_to_hundredths(height) >= rules.min_p90_m);
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

std::vector<bool> fill_holes(std::span<const ContourKey> keys, std::span<const Hole> holes,
                             const std::function<LatticeRing(std::size_t)>& ring, Context& context) {
    std::vector<std::uint32_t> order(holes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return holes[i].level; });
    std::vector<bool> filled(holes.size());
    // An interior ring starts at its first square; keep those of the level below that remain holes.
    std::vector<ContourKey> remaining_below;
    std::vector<ContourKey> remaining;
    std::int32_t level = 0;
    const auto is_empty = [&](std::uint32_t i) {
        const bool own = any_in_box(keys, level, holes[i]);
        const bool below = any_in_box(remaining_below, level - 1, holes[i]);
        if (!own && !below)
            return true;
        const std::vector<LatticePoint> runs = crossings(ring(i));
        return !(own && any_inside(keys, level, runs)) &&
               !(below && any_inside(remaining_below, level - 1, runs));
    };
    for (const std::uint32_t i : order) {
        context.check_stop();
        const Hole& hole = holes[i];
        for (; level < hole.level; ++level) {
            std::ranges::sort(remaining);
            remaining_below = std::exchange(remaining, {});
        }
        filled[i] = hole.reason && is_empty(i);
        if (filled[i])
            context.report.count(*hole.reason);
        else
            remaining.push_back({level, hole.start});
    }
    return filled;
}

}  // namespace d2b::contours
