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
    return cells_where(
        scene, [least = static_cast<float>(min_height)](float z, float ground) { return z - ground > least; },
        threads);
}

namespace {

constexpr std::int32_t rows_at_once = 256;

/// Reads a window as converted values.
template <typename T, typename Convert>
Grid<T> read_cells(DemSource& source, const Window& all, Context& context, const Convert& convert) {
    const StageClock clock(context.report, Stage::read);
    Grid<T> cells(all.rows, all.cols);
    std::vector<double> values;
    for (std::int32_t r = all.row; r < all.end_row(); r += rows_at_once) {
        const Window band{r, all.col, std::min(rows_at_once, all.end_row() - r), all.cols};
        values.resize(static_cast<std::size_t>(band.points()));
        source.read(band, values);
        std::ranges::transform(values, cells.row(r - all.row).data(), convert);
    }
    return cells;
}

}  // namespace

MetreGrid read_grid(DemSource& source, const Window& part, double factor, Context& context) {
    return read_cells<float>(source, part, context,
                             [&](double value) { return static_cast<float>(value * factor); });
}

Mask read_mask(DemSource& source, const Window& part, Context& context) {
    return read_cells<std::uint8_t>(
        source, part, context, [](double value) { return std::uint8_t{!std::isnan(value) && value != 0}; });
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

}  // namespace d2b::detect
