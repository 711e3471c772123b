#include "score/polis.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "score/measure.hpp"
#include "score/outline_segments.hpp"

namespace d2b {
namespace {

/// Mean distance between the vertices of one outline and the nearest points of another.
double mean_distance(std::span<const Polyline> from, std::span<const Polyline> to) {
    const OutlineSegments outline(to);
    double sum = 0;
    std::size_t count = 0;
    for (const Polyline& line : from) {
        for (std::size_t i = 1; i < line.size();
             ++i)  // skips the first position, because it is repeated at the end
            sum += outline.distance(line[i], std::numeric_limits<double>::infinity());
        count += line.size() - 1;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

double polis_distance(const WorldPolygon& a, const WorldPolygon& b) {
    const std::vector<Polyline> of_a = rings_of(std::span(&a, 1));
    const std::vector<Polyline> of_b = rings_of(std::span(&b, 1));
    return (mean_distance(of_a, of_b) + mean_distance(of_b, of_a)) / 2;
}

}  // namespace d2b
