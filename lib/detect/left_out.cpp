#include "detect/left_out.hpp"

#include <span>
#include <utility>

#include "core/row_bands.hpp"
#include "detect/region_builder.hpp"
#include "detect/smooth_segments.hpp"

namespace d2b {
namespace {

constexpr float lowest_roof_m = 1;  // lower objects are cars, hedges or errors of the ground

/// Returns the first cells of the chosen regions. Regions are numbered in the order of their first cells.
template <typename Chosen>
std::vector<FirstCell> first_cells(const Regions& regions, const Chosen& chosen) {
    std::vector<FirstCell> cells;
    Label seen = 0;
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            if (run.label > seen) {
                seen = run.label;
                if (chosen(regions.cells[seen]))
                    cells.push_back({r, run.begin});
            }
    return cells;
}

Mask low_cells(const Scene& scene, float min_height, Executor& threads) {
    Mask low = Mask::unset(scene.surface.rows, scene.surface.cols, threads);
    for_row_bands(threads, low.rows, low.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const std::span<const float> z = scene.surface.row(r);
            const std::span<const float> ground = scene.terrain.row(r);
            const std::span<std::uint8_t> out = low.row(r);
            for (std::size_t c = 0; c < out.size(); ++c) {
                const float height = z[c] - ground[c];
                const int above = height > lowest_roof_m ? 1 : 0;  // 0 if NaN
                out[c] = static_cast<std::uint8_t>(above & (height <= min_height ? 1 : 0));
            }
            if (scene.allowed == nullptr)
                continue;
            const std::span<const std::uint8_t> allowed = scene.allowed->row(r);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c] &= allowed[c];
        }
    });
    return low;
}

}  // namespace

std::vector<FirstCell> take_small_out(Regions& regions, std::int64_t least_cells) {
    const auto is_small = [&](std::int64_t cells) { return cells < least_cells; };
    std::vector<FirstCell> cells = first_cells(regions, is_small);
    std::vector<Label> number(regions.cells.size(), 0);
    std::vector<std::int64_t> left(1, 0);
    for (Label label = 1; label < number.size(); ++label)
        if (!is_small(regions.cells[label])) {
            number[label] = static_cast<Label>(left.size());
            left.push_back(regions.cells[label]);
        }
    relabel(regions, number);
    regions.cells = std::move(left);
    return cells;
}

std::vector<FirstCell> low_roofs(const Scene& scene, const Grid<std::uint8_t>& flags, double min_height,
                                 std::int64_t least_cells, Executor& threads) {
    if (!(min_height > static_cast<double>(lowest_roof_m)))
        return {};
    const Mask low = low_cells(scene, static_cast<float>(min_height), threads);
    return first_cells(smooth_regions(scene, low, flags, threads),
                       [&](std::int64_t cells) { return cells >= least_cells; });
}

}  // namespace d2b
