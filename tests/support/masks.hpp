#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/grid.hpp"

namespace d2b::test {

/// A mask drawn in rows: # is 1.
inline Mask drawn(const std::vector<std::string>& rows) {
    Mask mask(static_cast<std::int32_t>(rows.size()), static_cast<std::int32_t>(rows.at(0).size()));
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = rows[i / rows[0].size()].at(i % rows[0].size()) == '#' ? 1 : 0;
    return mask;
}

/// The inverse of drawn(), which shows where masks differ.
inline std::vector<std::string> drawing(const Mask& mask) {
    std::vector<std::string> rows;
    for (std::int32_t r = 0; r < mask.rows; ++r) {
        rows.emplace_back();
        for (const std::uint8_t value : mask.row(r))
            rows.back() += value == 0 ? '.' : value == 1 ? '#' : '?';
    }
    return rows;
}

inline Mask random_mask(std::int32_t rows, std::int32_t cols, unsigned percent, std::mt19937& random) {
    Mask mask(rows, cols);
    for (std::uint8_t& value : mask.values)
        value = random() % 100 < percent ? 1 : 0;
    return mask;
}

/// Masks with large regions and holes in them, as roofs make them.
inline Mask random_blocks(std::int32_t rows, std::int32_t cols, int blocks, std::mt19937& random) {
    Mask mask(rows, cols);
    const auto below = [&](std::int32_t n) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
    };
    for (int i = 0; i < blocks; ++i) {
        const std::int32_t top = below(rows);
        const std::int32_t left = below(cols);
        const std::int32_t bottom = std::min(rows, top + 1 + below(8));
        const std::int32_t right = std::min(cols, left + 1 + below(8));
        const std::uint8_t value = i % 4 == 3 ? 0 : 1;
        for (std::int32_t r = top; r < bottom; ++r)
            for (std::int32_t c = left; c < right; ++c)
                mask.at(r, c) = value;
    }
    return mask;
}

}  // namespace d2b::test
