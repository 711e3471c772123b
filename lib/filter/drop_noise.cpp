#include <optional>
#include <utility>

#include "filter/noise.hpp"

namespace d2b {
namespace {

std::optional<Reason> noise(const Contour& contour, const FilterOptions& options,
                            const SquareArea& square_area) {
    if (contour.key.level == 0 || (contour.key.level == 1 && options.keep_footprints))
        return {};
    if (contour.exterior.points() < options.noise_factor)
        return Reason::contour_short;
    const double least = options.min_area_m2.value_or(0);
    if (least > 0 && static_cast<double>(contour.squares()) * square_area(contour.key.first) < least)
        return Reason::contour_small;
    return {};
}

}  // namespace

FilteredStack drop_noise(Stack&& stack, const FilterOptions& options, const SquareArea& square_area,
                         Context& context) {
    FilteredStack result;
    result.stack.sample = std::move(stack.sample);
    result.stack.standing_on_it = std::move(stack.standing_on_it);
    std::vector<Contour>& kept = result.stack.contours;
    // Where each contour's points are now: an index into `kept`, -1 below the stack; and whether it is kept
    // itself.
    std::vector<std::pair<std::int64_t, bool>> place;
    place.reserve(stack.contours.size());
    for (Contour& contour : stack.contours) {
        const bool has_parent = contour.parent >= 0;
        const auto [holder, parent_kept] = has_parent ? place[static_cast<std::size_t>(contour.parent)]
                                                      : std::pair<std::int64_t, bool>{-1, true};
        const auto reason = parent_kept ? noise(contour, options, square_area) : Reason::contour_on_dropped;
        if (reason) {
            context.report.count(*reason);
            (holder >= 0 ? kept[static_cast<std::size_t>(holder)].own : result.fallen).merge(contour.own);
            place.emplace_back(holder, false);
            continue;
        }
        place.emplace_back(static_cast<std::int64_t>(kept.size()), true);
        contour.parent = holder;
        kept.push_back(std::move(contour));
    }
    return result;
}

}  // namespace d2b
