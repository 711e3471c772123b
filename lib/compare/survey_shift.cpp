#include "compare/survey_shift.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/box_tree.hpp"
#include "score/measure.hpp"

namespace d2b::compare {
namespace {

/// Two cells and one more, because centroids scatter.
constexpr double reach_cells = 3;
constexpr std::size_t fewest_pairs = 3;
constexpr double alike_area = 1.4;
constexpr double alike_height_m = 2;

/// Centroid of the exterior rings; relative to the first position, because large coordinates would cancel.
Position centroid(const Polygons& outline) {
    const Position origin = outline.front().exterior.front();
    double area = 0;
    double x = 0;
    double y = 0;
    for (const WorldPolygon& polygon : outline)
        for (std::size_t i = 0; i < polygon.exterior.size(); ++i) {
            const Position& p = polygon.exterior[i];
            const Position& q = polygon.exterior[(i + 1) % polygon.exterior.size()];
            const Position a{p.x - origin.x, p.y - origin.y};
            const Position b{q.x - origin.x, q.y - origin.y};
            const double cross = a.x * b.y - b.x * a.y;
            area += cross;
            x += cross * (a.x + b.x);
            y += cross * (a.y + b.y);
        }
    return {origin.x + x / (3 * area), origin.y + y / (3 * area)};
}

bool alike(const SurveyedBuilding& one, const SurveyedBuilding& other) {
    const auto [less, more] = std::minmax(one.area_m2, other.area_m2);
    const double difference = std::abs(one.heights.p90() - other.heights.p90());
    return more <= alike_area * less && !(difference > alike_height_m);
}

std::vector<Position> centroids_of(std::span<const SurveyedBuilding> buildings) {
    std::vector<Position> centroids;
    centroids.reserve(buildings.size());
    for (const SurveyedBuilding& building : buildings)
        centroids.push_back(centroid(building.outline));
    return centroids;
}

/// Displacements between buildings that may be the same.
std::vector<Position> displacements(std::span<const SurveyedBuilding> old_buildings,
                                    std::span<const SurveyedBuilding> new_buildings, double reach) {
    const std::vector<Position> from = centroids_of(old_buildings);
    const std::vector<Position> to = centroids_of(new_buildings);
    std::vector<Box> boxes;
    boxes.reserve(to.size());
    for (const Position& p : to)
        boxes.push_back({p.x, p.y, p.x, p.y});
    const BoxTree tree(boxes);
    std::vector<Position> found;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Box around{from[i].x - reach, from[i].y - reach, from[i].x + reach, from[i].y + reach};
        tree.query(around, [&](std::size_t k) {
            if (alike(old_buildings[i], new_buildings[k]))
                found.push_back({to[k].x - from[i].x, to[k].y - from[i].y});
        });
    }
    return found;
}

using Bin = std::pair<std::int64_t, std::int64_t>;

Bin bin_of(const Position& p, double side) {
    return {std::llround(p.x / side), std::llround(p.y / side)};
}

/// Returns the bin that has most displacements in and next to it; of several the one of the smallest shift.
Bin fullest_bin(std::span<const Position> all, double side) {
    std::map<Bin, std::size_t> counts;
    for (const Position& p : all)
        ++counts[bin_of(p, side)];
    Bin best{};
    std::size_t most = 0;
    const auto length = [](const Bin& bin) { return bin.first * bin.first + bin.second * bin.second; };
    for (const auto& [bin, own] : counts) {
        std::size_t sum = 0;
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t k = -1; k <= 1; ++k)
                if (const auto near = counts.find({bin.first + i, bin.second + k}); near != counts.end())
                    sum += near->second;
        if (sum > most || (sum == most && length(bin) < length(best))) {
            most = sum;
            best = bin;
        }
    }
    return best;
}

/// Median of the displacements up to `limit` from a first estimate along both axes, and their number.
std::pair<Position, std::size_t> median_near(std::span<const Position> all, const Position& first,
                                             double limit) {
    std::vector<double> east;
    std::vector<double> north;
    for (const Position& p : all)
        if (std::abs(p.x - first.x) <= limit && std::abs(p.y - first.y) <= limit) {
            east.push_back(p.x);
            north.push_back(p.y);
        }
    const std::size_t count = east.size();
    if (count < fewest_pairs)
        return {first, count};
    return {{score::median(std::move(east)), score::median(std::move(north))}, count};
}

}  // namespace

SurveyShift estimate_shift(std::span<const SurveyedBuilding> old_buildings,
                           std::span<const SurveyedBuilding> new_buildings, double cell_m, double metres) {
    const double cell = cell_m / metres;
    const double side = cell / 2;
    const std::vector<Position> all = displacements(old_buildings, new_buildings, reach_cells * cell);
    const auto [col, row] = fullest_bin(all, side);
    const Position mode{static_cast<double>(col) * side, static_cast<double>(row) * side};
    const Position rough = median_near(all, mode, 1.5 * side).first;
    const auto [shift, pairs] = median_near(all, rough, cell);
    if (pairs < fewest_pairs)
        return {};
    return {shift.x * metres, shift.y * metres, pairs};
}

}  // namespace d2b::compare
