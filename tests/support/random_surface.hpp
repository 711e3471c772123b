#pragma once

#include <random>

#include "core/grid.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::test {

/// Whole numbers from 0 to 49; one cell of `gaps` has no value.
inline MetreGrid random_surface(unsigned seed, std::int32_t rows, std::int32_t cols, unsigned gaps = 6) {
    std::mt19937 random(seed);
    MetreGrid grid(rows, cols);
    for (float& z : grid.values)
        z = random() % gaps == 0 ? no_value : static_cast<float>(random() % 50);
    return grid;
}

}  // namespace d2b::test
