#include "contours/for_each_building.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "core/grid.hpp"

namespace d2b::contours {
namespace {

/// Points gathered at a time: several bands per thread.
constexpr std::int64_t points_at_once = std::int64_t{1} << 23;

/// Cells of buildings in a batch of rows, in scan order.
struct GatheredRows {
    std::vector<std::pair<Label, RowSpan>> runs;
    std::vector<double> elevations;
    std::vector<std::size_t> spires;
};

/// @param first_col of the band in the raster
GatheredRows gather_rows(const ElevationBand& band, std::int32_t first_col, const LabelBand& labels) {
    GatheredRows gathered;
    for (std::int32_t row = 0; row < band.shape.rows; ++row) {
        const auto elevations = band.row(row);
        const std::vector<std::int32_t> spires = band.spires_in_row(row);
        for_equal_runs(labels.row(row), [&](std::int32_t begin, std::int32_t end, Label label) {
            gathered.runs.push_back(
                {label, {band.shape.first_row + row, first_col + begin, first_col + end}});
            for (const std::int32_t spire : spires)
                if (spire >= begin && spire < end)
                    gathered.spires.push_back(gathered.elevations.size() +
                                              static_cast<std::size_t>(spire - begin));
            gathered.elevations.insert(gathered.elevations.end(), elevations.begin() + begin,
                                       elevations.begin() + end);
        });
    }
    return gathered;
}

/// Returns the last row with cells of each label.
/// @param window window of the labels
std::vector<std::int32_t> last_rows(const detect::LabelRows& labels, Label count, const Window& window,
                                    Executor& threads) {
    std::vector<std::int32_t> last(count + std::size_t{1}, -1);
    const std::vector<RowBand> bands = row_bands(window.rows, window.cols);
    threads.in_order(
        bands.size(),
        [&](std::size_t i, std::size_t) {
            const BandShape shape{window.row + bands[i].begin, bands[i].end - bands[i].begin, window.cols};
            const LabelBand band = labels.band(shape);
            std::map<Label, std::int32_t> here;
            for (std::int32_t row = 0; row < shape.rows; ++row)
                for_equal_runs(band.row(row), [&](std::int32_t, std::int32_t, Label label) {
                    here[label] = shape.first_row + row;
                });
            return here;
        },
        [&](std::size_t, const std::map<Label, std::int32_t>& here) {
            for (const auto& [label, row] : here)
                last[label] = row;
        });
    return last;
}

/// Buildings with some of their rows read.
using OpenBuildings = std::map<Label, BuildingCells>;

void add_to(OpenBuildings& open, const GatheredRows& rows) {
    auto next = rows.elevations.begin();
    auto spire = rows.spires.begin();
    for (const auto& [label, run] : rows.runs) {
        BuildingCells& cells = open[label];
        cells.runs.push_back(run);
        const auto first = static_cast<std::size_t>(next - rows.elevations.begin());
        for (; spire != rows.spires.end() && *spire < first + run.size(); ++spire)
            cells.spires.push_back(cells.elevations.size() + (*spire - first));
        const auto end = next + static_cast<std::ptrdiff_t>(run.size());
        cells.elevations.insert(cells.elevations.end(), next, end);
        next = end;
    }
}

using EndedBuildings = std::vector<std::pair<Label, BuildingCells>>;

EndedBuildings take_ended(OpenBuildings& open, const std::vector<std::int32_t>& last, std::int32_t end_row) {
    EndedBuildings ended;
    for (auto it = open.begin(); it != open.end();) {
        if (last[it->first] >= end_row) {
            ++it;
            continue;
        }
        ended.emplace_back(it->first, std::move(it->second));
        it = open.erase(it);
    }
    return ended;
}

}  // namespace

void for_each_building(ElevationReader& reader, const detect::LabelRows& labels, Label count,
                       const Window& window, Stage stage, Context& context,
                       const std::function<void(Label, BuildingCells&&)>& use) {
    Executor& threads = *context.threads;
    const std::vector<std::int32_t> last = last_rows(labels, count, window, threads);
    OpenBuildings open;
    const auto at_once = static_cast<std::int32_t>(
        std::clamp<std::int64_t>(points_at_once / std::max(window.cols, 1), 64, 1 << 20));
    const std::int32_t end = window.row + window.rows;
    for (std::int32_t row = window.row; row < end; row += at_once) {
        const Window chunk{row, window.col, std::min(end - row, at_once), window.cols};
        std::map<std::int32_t, GatheredRows> gathered;
        std::mutex mutex;
        reader.for_part(chunk, [&](const ElevationBand& band) {
            GatheredRows here = gather_rows(band, window.col, labels.band(band.shape));
            const std::lock_guard lock(mutex);
            gathered.emplace(band.shape.first_row, std::move(here));
        });
        const StageClock clock(context.report, stage);
        for (const auto& [first, part] : gathered)
            add_to(open, part);
        EndedBuildings ended = take_ended(open, last, chunk.end_row());
        threads.for_each(ended.size(), [&](std::size_t i) {
            auto& [label, cells] = ended[i];
            use(label, std::move(cells));
            cells = {};
        });
    }
}

}  // namespace d2b::contours
