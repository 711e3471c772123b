#include "pipeline/contour_store.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace d2b {

ContourStore::ContourStore(const FilterOptions& options, SquareArea square_area, const ElevationRange& range,
                           Context& context)
    : options_(options), square_area_(std::move(square_area)), range_(range), context_(context) {}

Taken ContourStore::take(Stack&& stack) {
    FilteredStack filtered = drop_noise(std::move(stack), options_, square_area_, context_);
    std::vector<Contour>& kept = filtered.stack.contours;
    if (kept.empty())
        return {-1, filtered.fallen};
    const auto base = static_cast<std::int64_t>(contours_.size());
    for (const std::int64_t standing : filtered.stack.standing_on_it)
        contours_[static_cast<std::size_t>(standing)].parent = base;
    if (kept.front().key.level == 1) {
        bases_.push_back(base);
        percentiles_.push_back(filtered.stack.sample.size() > 0
                                   ? take_percentiles(filtered.stack.sample, range_)
                                   : Percentiles{});
    }
    for (Contour& contour : kept) {
        if (contour.parent >= 0)
            contour.parent += base;
        contours_.push_back(std::move(contour));
    }
    return {base, filtered.fallen};
}

ContourSet ContourStore::finish() {
    std::vector<std::size_t> order(contours_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return contours_[a].key < contours_[b].key; });
    std::vector<std::int64_t> number(contours_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        number[order[i]] = static_cast<std::int64_t>(i);

    ContourSet set;
    std::vector<std::size_t> stack_of(contours_.size());
    for (std::size_t i = 0; i < bases_.size(); ++i)
        stack_of[static_cast<std::size_t>(bases_[i])] = i;
    set.contours.reserve(contours_.size());
    set.building.reserve(contours_.size());
    for (const std::size_t old : order) {
        Contour& contour = set.contours.emplace_back(std::move(contours_[old]));
        if (contour.parent >= 0)
            contour.parent = number[static_cast<std::size_t>(contour.parent)];
        if (contour.key.level == 1) {
            set.building.push_back(static_cast<std::int64_t>(set.buildings.size()));
            set.buildings.push_back(number[old]);
            set.percentiles.push_back(percentiles_[stack_of[old]]);
        } else {
            set.building.push_back(
                contour.key.level == 0 ? -1 : set.building[static_cast<std::size_t>(contour.parent)]);
        }
    }
    contours_ = {};
    fill_holes(set.contours, options_, square_area_, context_);
    return set;
}

void drop_roots(ContourSet& set) {
    const auto first = std::find_if(set.contours.begin(), set.contours.end(),
                                    [](const Contour& contour) { return contour.key.level > 0; });
    const std::int64_t roots = first - set.contours.begin();
    set.contours.erase(set.contours.begin(), first);
    set.building.erase(set.building.begin(), set.building.begin() + roots);
    for (Contour& contour : set.contours)
        contour.parent = contour.parent < roots ? -1 : contour.parent - roots;
    for (std::int64_t& contour : set.buildings)
        contour -= roots;
}

}  // namespace d2b
