#include "detect/scene.hpp"

#include <cmath>
#include <utility>

namespace d2b::detect {

double Scene::side() const {
    return std::sqrt(cell_area());
}

std::int64_t cells_covering(double area_m2, const CellSize& cell) {
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

namespace {

constexpr std::int32_t rows_at_once = 256;

/// Calls use(index of the first value, values) for each band of rows.
template <typename Use>
void for_each_band(DemSource& source, const Window& all, Context& context, Use use) {
    const StageClock clock(context.report, Stage::read);
    std::vector<double> values;
    std::size_t first = 0;
    for (std::int32_t r = all.row; r < all.end_row(); r += rows_at_once) {
        const Window band{r, all.col, std::min(rows_at_once, all.end_row() - r), all.cols};
        values.resize(static_cast<std::size_t>(band.points()));
        source.read(band, values);
        use(first, values);
        first += values.size();
    }
}

}  // namespace

MetreGrid read_grid(DemSource& source, const Window& part, double factor, Context& context) {
    MetreGrid grid(part.rows, part.cols);
    for_each_band(source, part, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            grid.values[first + i] = static_cast<float>(values[i] * factor);
    });
    return grid;
}

std::vector<SceneCorrection> corrections_in(const std::vector<Correction>& all, const Window& part) {
    std::vector<SceneCorrection> here;
    for (std::size_t i = 0; i < all.size(); ++i) {
        SceneCorrection correction{i, all[i].kind, all[i].is_point, {}, {}};
        for (const CellRun& run : all[i].cells) {
            const std::int32_t begin = std::max(run.begin, part.col);
            const std::int32_t end = std::min(run.end, part.end_col());
            if (run.row >= part.row && run.row < part.end_row() && begin < end)
                correction.cells.push_back({run.row - part.row, begin - part.col, end - part.col});
        }
        for (const CellCut& cut : all[i].cuts)
            if (part.holds(cut.row, cut.col))
                correction.cuts.push_back({cut.row - part.row, cut.col - part.col, cut.below});
        if (!correction.cells.empty() || !correction.cuts.empty())
            here.push_back(std::move(correction));
    }
    return here;
}

Mask read_mask(DemSource& source, const Window& part, Context& context) {
    Mask mask(part.rows, part.cols);
    for_each_band(source, part, context, [&](std::size_t first, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            mask.values[first + i] = !std::isnan(values[i]) && values[i] != 0 ? 1 : 0;
    });
    return mask;
}

}  // namespace d2b::detect
