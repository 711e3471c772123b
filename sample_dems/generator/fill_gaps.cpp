#include "fill_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace d2b::sample {

namespace {

/// Cells of a raster before any was filled.
struct Known {
    std::vector<double> values;
    std::int32_t rows;
    std::int32_t cols;

    [[nodiscard]] double at(std::int32_t row, std::int32_t col) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                      static_cast<std::size_t>(col)];
    }
    /// Calls see(value, square of the distance in cells) for each known cell within reach, row by row.
    template <typename See>
    void around(std::int32_t row, std::int32_t col, double reach, const See& see) const {
        const auto ring = static_cast<std::int32_t>(std::floor(reach));
        for (std::int32_t r = std::max(0, row - ring); r <= std::min(rows - 1, row + ring); ++r)
            for (std::int32_t c = std::max(0, col - ring); c <= std::min(cols - 1, col + ring); ++c) {
                const double square = (r - row) * (r - row) + (c - col) * (c - col);
                if (!std::isnan(at(r, c)) && square <= reach * reach)
                    see(at(r, c), square);
            }
    }
};

double nearest_of(const Known& known, std::int32_t row, std::int32_t col, double reach) {
    double nearest = std::numeric_limits<double>::infinity();
    double value = std::numeric_limits<double>::quiet_NaN();
    known.around(row, col, reach, [&](double z, double square) {
        if (square < nearest) {
            nearest = square;
            value = z;
        }
    });
    return value;
}

/// NaN, 0 / 0, where none is in reach.
double weighted_mean(const Known& known, std::int32_t row, std::int32_t col, double reach) {
    double sum = 0;
    double weight = 0;
    known.around(row, col, reach, [&](double z, double square) {
        sum += z / square;
        weight += 1 / square;
    });
    return sum / weight;
}

}  // namespace

std::int64_t fill_gaps(std::span<double> values, std::int32_t cols, double reach, GapFilling filling) {
    const Known known{{values.begin(), values.end()},
                      static_cast<std::int32_t>(values.size() / static_cast<std::size_t>(cols)),
                      cols};
    std::int64_t filled = 0;
    std::size_t i = 0;
    for (std::int32_t row = 0; row < known.rows; ++row)
        for (std::int32_t col = 0; col < cols; ++col, ++i) {
            if (!std::isnan(values[i]))
                continue;
            values[i] = filling == GapFilling::nearest ? nearest_of(known, row, col, reach)
                                                       : weighted_mean(known, row, col, reach);
            filled += std::isnan(values[i]) ? 0 : 1;
        }
    return filled;
}

}  // namespace d2b::sample
