#include "read/seen_cells.hpp"

#include <algorithm>

namespace d2b {

void SeenCells::add(std::int32_t row, std::int32_t begin, std::int32_t end,
                    const std::function<void(std::int32_t, std::int32_t)>& use) {
    std::vector<Stretch>& seen = rows_[static_cast<std::size_t>(row)];
    // Merges the new range with all that it overlaps or touches.
    const auto first = std::ranges::lower_bound(seen, begin, {}, &Stretch::second);
    const auto last = std::ranges::upper_bound(seen, end, {}, &Stretch::first);
    Stretch whole{begin, end};
    std::int32_t next = begin;
    for (auto stretch = first; stretch < last; ++stretch) {
        if (next < stretch->first)
            use(next, stretch->first);
        next = std::max(next, stretch->second);
        whole = {std::min(whole.first, stretch->first), std::max(whole.second, stretch->second)};
    }
    if (next < end)
        use(next, end);
    if (begin < end)
        seen.insert(seen.erase(first, last), whole);
}

}  // namespace d2b
