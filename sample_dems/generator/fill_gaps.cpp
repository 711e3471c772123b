#include "fill_gaps.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace d2b::sample {

std::int64_t fill_gaps(std::span<double> values, std::int32_t cols, double reach) {
    const std::vector<double> known(values.begin(), values.end());
    const auto rows = static_cast<std::int32_t>(values.size() / static_cast<std::size_t>(cols));
    const auto index = [cols](std::int32_t row, std::int32_t col) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
    };
    const auto ring = static_cast<std::int32_t>(std::floor(reach));
    std::int64_t filled = 0;
    for (std::int32_t row = 0; row < rows; ++row)
        for (std::int32_t col = 0; col < cols; ++col) {
            if (!std::isnan(known[index(row, col)]))
                continue;
            double nearest = reach * reach;
            bool found = false;
            for (std::int32_t r = std::max(0, row - ring); r <= std::min(rows - 1, row + ring); ++r)
                for (std::int32_t c = std::max(0, col - ring); c <= std::min(cols - 1, col + ring); ++c) {
                    const double square = (r - row) * (r - row) + (c - col) * (c - col);
                    if (std::isnan(known[index(r, c)]) || square > nearest || (found && square == nearest))
                        continue;
                    nearest = square;
                    found = true;
                    values[index(row, col)] = known[index(r, c)];
                }
            filled += found ? 1 : 0;
        }
    return filled;
}

}  // namespace d2b::sample
