#include "score/heights.hpp"

#include <algorithm>
#include <cmath>

#include "score/measure.hpp"

namespace d2b {

std::optional<HeightErrors> height_errors(std::span<const double> errors) {
    if (errors.empty())
        return std::nullopt;
    HeightErrors result;
    result.pairs = errors.size();
    const auto n = static_cast<double>(errors.size());
    std::vector<double> absolute;
    for (const double error : errors) {
        result.mean += error / n;
        result.rms += error * error / n;
        absolute.push_back(std::abs(error));
    }
    result.rms = std::sqrt(result.rms);
    std::ranges::sort(absolute);
    const std::size_t half = absolute.size() / 2;
    result.median_absolute =
        absolute.size() % 2 == 1 ? absolute[half] : (absolute[half - 1] + absolute[half]) / 2;
    return result;
}

std::vector<std::optional<double>> object_heights(std::span<const std::optional<double>> heights,
                                                  std::span<const Polygons> areas, const Polygons& objects,
                                                  Overlay& overlay) {
    std::vector<WorldPolygon> parts;
    std::vector<double> of_parts;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (!heights[i])
            continue;
        parts.insert(parts.end(), areas[i].begin(), areas[i].end());
        of_parts.resize(parts.size(), *heights[i]);
    }
    std::vector<double> weights(objects.size(), 0.0);
    std::vector<double> sums(objects.size(), 0.0);
    const auto holders = overlay.holders(parts, objects);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!holders[i])
            continue;
        const double area = area_of(parts[i]);
        weights[*holders[i]] += area;
        sums[*holders[i]] += area * of_parts[i];
    }
    std::vector<std::optional<double>> result(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (weights[i] > 0)
            result[i] = sums[i] / weights[i];
    return result;
}

}  // namespace d2b
