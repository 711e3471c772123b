#include "detect/scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/row_bands.hpp"

namespace d2b {

double Scene::side() const {
    return std::sqrt(cell_area());
}

std::int64_t cells_for(double area_m2, const CellSize& cell) {
    constexpr double most = 0x1p62;  // a raster has at most 2^60 cells
    return static_cast<std::int64_t>(std::min(std::ceil(area_m2 / cell.area()), most));
}

Mask elevated_cells(const Scene& scene, double min_height, Executor& threads) {
    Mask result = Mask::unset(scene.surface.rows, scene.surface.cols, threads);
    const auto least = static_cast<float>(min_height);
    for_row_bands(threads, result.rows, result.cols, [&](RowBand band) {
        const std::size_t begin = result.index(band.begin, 0);
        const std::size_t end = result.index(band.end, 0);
        for (std::size_t i = begin; i < end; ++i)
            result.values[i] = scene.height(i) > least ? 1 : 0;  // false where it is NaN
        if (scene.allowed != nullptr)
            for (std::size_t i = begin; i < end; ++i)
                if (scene.allowed->values[i] == 0)
                    result.values[i] = 0;
    });
    return result;
}

}  // namespace d2b
