#include "surface.hpp"

#include <cmath>

#include "city.hpp"
#include "ground.hpp"
#include "random.hpp"

namespace d2b::bench {

namespace {

constexpr double noise = 0.04;        // standard deviation, metres
constexpr double lost = 2e-5;         // share of cells without a return
constexpr double pond_spacing = 400;  // metres

/// One pond at most in every square of a lattice; none reaches into the next.
bool in_pond(std::uint64_t seed, const Position& p) {
    const double i = std::floor(p.x / pond_spacing);
    const double j = std::floor(p.y / pond_spacing);
    sample::Random random(sample::hash(seed, static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)));
    if (!random.chance(0.3))
        return false;
    const double radius = random.between(3, 14);
    const Position centre{i * pond_spacing + random.between(30, pond_spacing - 30),
                          j * pond_spacing + random.between(30, pond_spacing - 30)};
    return sample::distance(p, centre) < radius;
}

}  // namespace

void roughen(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
             std::span<double> metres) {
    std::size_t at = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        for (std::int32_t col = 0; col < grid.cols; ++col, ++at) {
            const Position p = grid.centre(row, col);
            metres[at] += 0.3 * (sample::value_noise(seed + 20, 9, p) - 0.5) +
                          0.1 * (sample::value_noise(seed + 21, 2.5, p) - 0.5);
        }
    }
}

void measure(std::uint64_t seed, const sample::Grid& grid, std::int32_t first_row, std::int32_t rows,
             std::span<const double> metres, std::span<float> elevations) {
    std::size_t at = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        for (std::int32_t col = 0; col < grid.cols; ++col, ++at) {
            const double z = metres[at] + noise * sample::normal_at(seed, row, col);
            const bool missing =
                sample::uniform_at(seed + 22, row, col) < lost || in_pond(seed + 23, grid.centre(row, col));
            elevations[at] = static_cast<float>(missing ? City::nodata : std::floor(z * 100 + 0.5) / 100);
        }
    }
}

}  // namespace d2b::bench
