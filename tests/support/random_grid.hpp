#pragma once

#include <algorithm>
#include <random>

#include "support/trace_grid.hpp"

namespace d2b::test {

struct RandomGridCase {
    TraceGrid grid;
    std::vector<double> thresholds;
    TraceMode mode = TraceMode::cells;
};

/// Noise of few values, so that saddles, holes and nested towers are everywhere.
inline RandomGridCase random_grid(unsigned seed, unsigned largest = 14, bool with_labels = true) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    RandomGridCase result;
    result.mode = seed % 2 == 0 ? TraceMode::cells : TraceMode::points;
    TraceGrid& grid = result.grid;
    grid.rows = 1 + below(largest);
    grid.cols = 1 + below(largest);
    const int values = 2 + below(5);
    const bool labelled = below(3) == 0 && with_labels;
    const bool with_nodata = below(2) == 0;
    for (int i = 0; i < grid.rows * grid.cols; ++i) {
        const int first = below(static_cast<unsigned>(values));
        // The higher of two makes large regions with small holes.
        grid.z.push_back(
            with_nodata && below(9) == 0 ? nodata : std::max(first, below(static_cast<unsigned>(values))));
        if (labelled)
            grid.labels.push_back(static_cast<Label>(below(3)));
    }
    for (int t = 0; t + 1 < values; ++t)
        result.thresholds.push_back(t + 0.5);
    return result;
}

}  // namespace d2b::test
