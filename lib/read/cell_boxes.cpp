#include "read/cell_boxes.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace d2b {

bool are_apart(std::vector<CellBox> boxes) {
    std::vector<CellBox> ended = boxes;
    std::ranges::sort(boxes, {}, [](const CellBox& box) { return box[1][0]; });
    std::ranges::sort(ended, {}, [](const CellBox& box) { return box[1][1]; });
    auto next_end = ended.begin();
    // Sweep line: boxes that contain the row at which the next box begins, from left to right, [begin, end)
    // of columns.
    std::map<double, double> in_row;
    for (const auto& [cols, rows] : boxes) {
        for (; (*next_end)[1][1] <= rows[0]; ++next_end)
            in_row.erase((*next_end)[0][0]);
        const auto right = in_row.lower_bound(cols[0]);
        if (right != in_row.end() && right->first < cols[1])
            return false;
        if (right != in_row.begin() && std::prev(right)->second > cols[0])
            return false;
        in_row.emplace(cols[0], cols[1]);
    }
    return true;
}

}  // namespace d2b
