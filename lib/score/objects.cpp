#include "score/objects.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "score/measure.hpp"

namespace d2b::score {
namespace {

ScoredObjects objects_of(Polygons pieces) {
    ScoredObjects objects{std::move(pieces), {}, {}};
    for (const WorldPolygon& piece : objects.pieces)
        objects.areas.push_back(area_of(piece));
    objects.shared.assign(objects.pieces.size(), 0.0);
    return objects;
}

}  // namespace

Comparison compare(Polygons found, Polygons reference, Overlay& overlay) {
    Comparison result;
    const Polygons both = overlay.intersection(found, reference);
    result.found = objects_of(std::move(found));
    result.reference = objects_of(std::move(reference));
    result.found_area = area_of(result.found.pieces);
    result.reference_area = area_of(result.reference.pieces);
    // A connected part of the intersection lies in one object of each side.
    const auto of_found = overlay.containing_polygons(both, result.found.pieces);
    const auto of_reference = overlay.containing_polygons(both, result.reference.pieces);
    std::map<std::pair<std::size_t, std::size_t>, double> shared;
    for (std::size_t i = 0; i < both.size(); ++i) {
        const double area = area_of(both[i]);
        result.shared_area += area;
        if (of_found[i])
            result.found.shared[*of_found[i]] += area;
        if (of_reference[i])
            result.reference.shared[*of_reference[i]] += area;
        if (of_found[i] && of_reference[i])
            shared[{*of_found[i], *of_reference[i]}] += area;
    }
    // Rounding may make the sum of the parts exceed the whole.
    result.shared_area = std::min({result.shared_area, result.found_area, result.reference_area});
    for (const auto& [pair, area] : shared) {
        const double all = result.found.areas[pair.first] + result.reference.areas[pair.second] - area;
        result.pairs.push_back({pair.first, pair.second, area / all});
    }
    return result;
}

bool at_least(double value, double least) {
    constexpr double rounding = 1e-9;
    return value >= least * (1 - rounding);
}

ObjectCount count_objects(const ScoredObjects& objects, double min_area) {
    ObjectCount count;
    for (std::size_t i = 0; i < objects.pieces.size(); ++i) {
        if (!at_least(objects.areas[i], min_area))
            continue;
        ++count.large;
        if (at_least(objects.shared[i], 0.5 * objects.areas[i]))
            ++count.covered;
    }
    return count;
}

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
    result.median_absolute = median(std::move(absolute));
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
    const auto containing_polygons = overlay.containing_polygons(parts, objects);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!containing_polygons[i])
            continue;
        const double area = area_of(parts[i]);
        weights[*containing_polygons[i]] += area;
        sums[*containing_polygons[i]] += area * of_parts[i];
    }
    std::vector<std::optional<double>> result(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (weights[i] > 0)
            result[i] = sums[i] / weights[i];
    return result;
}

}  // namespace d2b::score
