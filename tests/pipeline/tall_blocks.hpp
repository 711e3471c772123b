#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/pipeline_case.hpp"

namespace d2b::test {

/// Bands of 64 rows, and nothing kept between passes: every pass reads every band.
inline constexpr BandSize small_bands{0, 0};

/// 448 x 40 cells in seven small bands, with a block across each of their borders and one beside it, and a
/// step on each.
inline MemorySource tall_blocks() {
    constexpr int rows = 448;
    constexpr int cols = 40;
    std::vector<double> z;
    for (int row = 0; row < rows; ++row)
        for (int col = 0; col < cols; ++col) {
            const int from_border = (row + 32) % 64 - 32;
            const bool across = from_border >= -9 && from_border < 7 && col >= 4 && col < 20;
            const bool beside = from_border >= 0 && from_border < 12 && col >= 26 && col < 38;
            const double step = (col + row / 64) % 4 < 2 ? 0 : 3;
            z.push_back(100 + 0.01 * col + 0.002 * (row % 7) + (across || beside ? 8 + step : 0));
        }
    return {rows, cols, z};
}

inline Options of_preset(Preset preset, int threads) {
    Options options;
    options.preset = preset;
    options.run.threads = threads;
    return options;
}

}  // namespace d2b::test
