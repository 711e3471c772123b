#include "detect/border_sums.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

constexpr std::int32_t ring_cells = 2;

}  // namespace

void BorderSums::add(const Scene& scene, const Mask& objects, std::int32_t r, std::int32_t c) {
    double heights = heights_;
    double cells = cells_;
    const std::int32_t left = std::max(c - ring_cells, 0);
    const std::int32_t right = std::min(c + ring_cells, objects.cols - 1);
    for (std::int32_t y = std::max(r - ring_cells, 0); y <= std::min(r + ring_cells, objects.rows - 1); ++y) {
        const std::uint8_t* const object = objects.row(y).data();
        const float* const z = scene.surface.row(y).data();
        const float* const ground = scene.terrain.row(y).data();
        for (std::int32_t x = left; x <= right; ++x)
            if (object[x] == 0 && !std::isnan(z[x])) {
                heights += static_cast<double>(std::max(0.0F, z[x] - ground[x]));
                cells += 1;
            }
    }
    heights_ = heights;
    cells_ = cells;
    if (r > 0 && c > 0 && r + 1 < objects.rows && c + 1 < objects.cols)
        add_gradient(scene.surface, r, c);
}

void BorderSums::add_gradient(const MetreGrid& surface, std::int32_t r, std::int32_t c) {
    double across = 0;
    double down = 0;
    for (const std::int32_t k : {-1, 0, 1}) {
        const double weight = k == 0 ? 2 : 1;
        across += weight * static_cast<double>(surface.at(r + k, c + 1) - surface.at(r + k, c - 1));
        down += weight * static_cast<double>(surface.at(r + 1, c + k) - surface.at(r - 1, c + k));
    }
    const double size = std::hypot(across, down);
    if (std::isnan(size) || size == 0)
        return;
    // Squaring a complex number doubles its angle.
    const double twice_cosine = (across * across - down * down) / (size * size);
    const double twice_sine = 2 * across * down / (size * size);
    cosine_ += size * (twice_cosine * twice_cosine - twice_sine * twice_sine);
    sine_ += size * 2 * twice_cosine * twice_sine;
    gradients_ += size;
}

double BorderSums::height_beside() const {
    return cells_ > 0 ? heights_ / cells_ : 0;
}

double BorderSums::right_angles() const {
    return gradients_ > 0 ? std::hypot(cosine_, sine_) / gradients_ : 0;
}

}  // namespace d2b
