#include "features/contour_children.hpp"

#include <numeric>

namespace d2b {

ContourChildren::ContourChildren(const ContourList& contours) : first_(contours.size() + 1) {
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (const std::int64_t parent = contours.head(i).parent; parent >= 0)
            ++first_[static_cast<std::size_t>(parent) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    children_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (const std::int64_t parent = contours.head(i).parent; parent >= 0)
            children_[next[static_cast<std::size_t>(parent)]++] = static_cast<std::uint32_t>(i);
}

}  // namespace d2b
