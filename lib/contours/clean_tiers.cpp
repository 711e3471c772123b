#include "contours/clean_tiers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "contours/for_each_building.hpp"

namespace d2b::contours {
namespace {

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void clean(BuildingCells& cells, const RegionOptions& options, const StopToken& stop) {
    const TierRegions regions = merge_regions(cells, options, stop);
    for (std::size_t i = 0; i < cells.elevations.size(); ++i) {
        const TierRegion& region = regions.regions[regions.of_cell[i]];
        if (region.points > 0)
            cells.elevations[i] = region.mean;
    }
}

}  // namespace

CleanRows::CleanRows(std::unique_ptr<Spool> spool, const Window& window)
    : spool_(std::move(spool)), first_col_(window.col), slabs_(window.row, window.rows) {}

void CleanRows::add(const BuildingCells& cells) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < cells.runs.size();) {
        const std::size_t slab = slabs_.index(cells.runs[i].row);
        ByteWriter writer;
        for (; i < cells.runs.size() && slabs_.index(cells.runs[i].row) == slab; ++i) {
            const RowSpan& run = cells.runs[i];
            for (std::int32_t begin = run.begin; begin < run.end;) {
                const double elevation = cells.elevations[cell];
                std::int32_t end = begin;
                for (; end < run.end && same(cells.elevations[cell], elevation); ++end)
                    ++cell;
                writer.put(CleanRun{run.row, begin - first_col_, end - first_col_, 0, elevation});
                begin = end;
            }
        }
        const SpoolEntry entry = append(*spool_, writer);
        const std::lock_guard lock(*mutex_);
        slabs_[slab].push_back(entry);
    }
}

CleanRows clean_tiers(ElevationReader& reader, const detect::LabelRows& labels, Label count,
                      const RegionOptions& regions, const Window& window,
                      const std::function<void(Label, const BuildingCells&)>& use, Context& context) {
    CleanRows rows(context.make_spool(), window);
    for_each_building(reader, labels, count, window, Stage::levels, context,
                      [&](Label label, BuildingCells&& cells) {
                          clean(cells, regions, context.threads->stop());
                          use(label, cells);
                          rows.add(cells);
                      });
    return rows;
}

RegionOptions region_options(double detail, const CellSize& cell, double metres) {
    // Features one cell wide are always blurred.
    constexpr int least_width = 2;
    // Cells: a tier of a few cells is worth its vertices only if it stands out more than a large one.
    constexpr double own_border = 12;
    const double height = detail / metres;
    // The price of a border of one cell is the squared error of the strip per cell of its length, in points.
    // Features narrower than a cell are not visible.
    const double strip_cells = std::max(1.0, 1 / std::sqrt(cell.across * cell.down));
    return {height * height * strip_cells, least_width, own_border};
}

}  // namespace d2b::contours
