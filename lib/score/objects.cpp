#include "score/objects.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "score/measure.hpp"

namespace d2b {
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
    const auto of_found = overlay.holders(both, result.found.pieces);
    const auto of_reference = overlay.holders(both, result.reference.pieces);
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

bool reaches(double value, double least) {
    constexpr double rounding = 1e-9;
    return value >= least * (1 - rounding);
}

ObjectCount count_objects(const ScoredObjects& objects, double min_area) {
    ObjectCount count;
    for (std::size_t i = 0; i < objects.pieces.size(); ++i) {
        if (!reaches(objects.areas[i], min_area))
            continue;
        ++count.large;
        if (reaches(objects.shared[i], 0.5 * objects.areas[i]))
            ++count.covered;
    }
    return count;
}

}  // namespace d2b
