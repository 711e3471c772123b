#include "detect/scene.hpp"

#include <cmath>

namespace d2b {

double Scene::side() const {
    return std::sqrt(cell_area());
}

Mask elevated_cells(const Scene& scene, double min_height) {
    Mask result(scene.surface.rows, scene.surface.cols);
    const auto least = static_cast<float>(min_height);
    for (std::size_t i = 0; i < result.size(); ++i)
        result.values[i] = scene.height(i) > least ? 1 : 0;  // false where it is NaN
    if (scene.allowed != nullptr)
        for (std::size_t i = 0; i < result.size(); ++i)
            if (scene.allowed->values[i] == 0)
                result.values[i] = 0;
    return result;
}

}  // namespace d2b
