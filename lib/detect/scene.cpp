#include "detect/scene.hpp"

#include <algorithm>
#include <cmath>
#include <span>

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
    for_row_bands(threads, result.rows, result.cols, [&](RowBand band) {
        const auto least = static_cast<float>(min_height);
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            // Local spans, because stores of bytes may alias anything and would otherwise prevent
            // vectorisation. Same wherever bytes of cells are written.
            const std::span<const float> z = scene.surface.row(r);
            const std::span<const float> ground = scene.terrain.row(r);
            const std::span<std::uint8_t> out = result.row(r);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c] = z[c] - ground[c] > least ? 1 : 0;  // 0 if NaN
            if (scene.allowed == nullptr)
                continue;
            const std::span<const std::uint8_t> allowed = scene.allowed->row(r);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c] = allowed[c] != 0 ? out[c] : std::uint8_t{0};
        }
    });
    return result;
}

}  // namespace d2b
