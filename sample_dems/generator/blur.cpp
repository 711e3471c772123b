#include "blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace d2b::sample {

namespace {

/// Along lines of `length` values that lie `stride` apart.
void blur_lines(std::span<double> values, std::size_t lines, std::size_t line_stride, std::size_t length,
                std::size_t stride, const std::vector<double>& weights) {
    const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
    const auto last = static_cast<std::ptrdiff_t>(length) - 1;
    std::vector<double> line(length);
    for (std::size_t k = 0; k < lines; ++k) {
        for (std::size_t i = 0; i < length; ++i)
            line[i] = values[k * line_stride + i * stride];
        for (std::ptrdiff_t i = 0; i <= last; ++i) {
            double sum = 0;
            double weight = 0;
            for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach); j <= std::min(last, i + reach);
                 ++j) {
                const double w = weights[static_cast<std::size_t>(std::abs(i - j))];
                sum += w * line[static_cast<std::size_t>(j)];
                weight += w;
            }
            values[k * line_stride + static_cast<std::size_t>(i) * stride] = sum / weight;
        }
    }
}

}  // namespace

void blur(std::span<double> values, std::int32_t cols, double deviation) {
    const auto width = static_cast<std::size_t>(cols);
    const std::size_t rows = values.size() / width;
    std::vector<double> weights;
    for (int k = 0; k <= 4 * deviation; ++k)
        weights.push_back(std::exp(-0.5 * k * k / (deviation * deviation)));
    blur_lines(values, rows, width, width, 1, weights);
    blur_lines(values, width, 1, rows, width, weights);
}

}  // namespace d2b::sample
