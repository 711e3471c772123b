#include "outline/walls/drawn_chain.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

/// Step in [low, high] nearest to a point.
std::size_t nearest_step(const WallSamples& samples, Vec place, std::size_t low, std::size_t high) {
    std::size_t best = low;
    const auto square = [&](std::size_t i) { return dot(samples.at(i) - place, samples.at(i) - place); };
    double least = square(low);
    for (std::size_t i = low + 1; i <= high; ++i) {
        const double away = square(i);
        if (away < least) {
            least = away;
            best = i;
        }
    }
    return best;
}

}  // namespace

void match_trace(const WallSamples& samples, const CellShape& shape, LatticePoint origin, DrawnChain& chain) {
    constexpr std::size_t reach = 8;
    const std::size_t n = chain.vertices.size();
    const std::size_t end = samples.closed() ? 2 * samples.steps() - 1 : samples.steps();
    for (std::size_t k = samples.closed() ? 0 : 1; k + (samples.closed() ? 0 : 1) < n; ++k) {
        const std::size_t hint = chain.steps[k];
        const std::size_t low = std::max(hint > reach ? hint - reach : 0, k > 0 ? chain.steps[k - 1] : 0);
        std::size_t high = std::min(hint + reach, end);
        if (k > 0 && samples.closed())
            high = std::min(high, chain.steps.front() + samples.steps());
        chain.steps[k] =
            nearest_step(samples, shape.from_fine(chain.vertices[k], origin), std::min(low, high), high);
    }
    chain.deviation = deviation(samples, shape, origin, chain, samples.closed());
}

double deviation(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                 const DrawnChain& chain, bool closed) {
    double largest = 0;  // squared
    for_distances(samples, shape, origin, chain, closed,
                  [&](std::size_t, double square) { largest = std::max(largest, square); });
    return std::sqrt(largest);
}

double twice_area(const WallSamples& samples) {
    double sum = 0;
    for (std::size_t i = 0; i < samples.steps(); ++i)
        sum += cross(samples.at(i), samples.at(i + 1));
    return sum;
}

double twice_area(const std::vector<FinePoint>& ring, const CellShape& shape, LatticePoint origin) {
    double sum = 0;
    Vec from = shape.from_fine(ring.back(), origin);
    for (const FinePoint vertex : ring) {
        const Vec to = shape.from_fine(vertex, origin);
        sum += cross(from, to);
        from = to;
    }
    return sum;
}

}  // namespace d2b
