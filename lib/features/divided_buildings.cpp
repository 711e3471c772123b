#include "features/divided_buildings.hpp"

#include <algorithm>
#include <cstddef>

namespace d2b::features {

std::vector<PartOfWhole> parts_of_wholes(const contours::ContourList& contours,
                                         const std::vector<Footprint>& footprints) {
    std::vector<PartOfWhole> parts;
    if (std::ranges::all_of(footprints, [](const Footprint& footprint) { return footprint.whole == 0; }))
        return parts;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        const contours::ContourHead& head = contours.head(i);
        if (head.key.level == 1 && head.building >= 0 && footprints[head.label].whole != 0)
            parts.push_back({footprints[head.label].whole, head.label});
    }
    std::ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    return parts;
}

std::vector<std::int64_t> divided_wholes(std::vector<PartOfWhole> parts) {
    std::ranges::sort(parts);
    std::vector<std::int64_t> wholes;
    for (std::size_t i = 1; i < parts.size(); ++i)
        if (parts[i].whole == parts[i - 1].whole && (wholes.empty() || wholes.back() != parts[i].whole))
            wholes.push_back(parts[i].whole);
    return wholes;
}

}  // namespace d2b::features
