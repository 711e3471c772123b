#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "contours/level_plan.hpp"
#include "contours/tracer.hpp"
#include "detect/detection.hpp"
#include "support/contour_set.hpp"

namespace d2b::test {

inline constexpr double nodata = std::numeric_limits<double>::quiet_NaN();

/// Elevations row by row, with all that a run over them needs.
struct TraceGrid {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    std::vector<double> z;
    std::vector<Label> labels;  ///< empty: one label

    [[nodiscard]] double at(std::int32_t row, std::int32_t col) const {
        return z[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                 static_cast<std::size_t>(col)];
    }
    [[nodiscard]] Label label(std::int32_t row, std::int32_t col) const {
        return labels.empty() ? 1 : labels[static_cast<std::size_t>(row * cols + col)];
    }
};

struct TraceSettings {
    TraceSettings() = default;
    TraceSettings(TraceMode the_mode, int the_noise_factor = 0, double the_min_area = 0)
        : mode(the_mode), noise_factor(the_noise_factor), min_area(the_min_area) {}

    TraceMode mode = TraceMode::cells;
    int noise_factor = 0;
    double min_area = 0;
    std::int32_t rows_a_band = 1000000;
    bool linked_alone = true;  ///< each band by itself, before it comes to those above
    LatticePoint origin;       ///< of the window in the whole raster
    bool keep_roots = true;
    double min_building_height = 0;
    std::vector<double> ground{};  ///< by label
};

/// Some rows of a grid, as a band of a raster in which the grid begins at `origin`.
template <typename Count>
contours::PointRows<Count> point_rows(const TraceGrid& grid, const contours::LevelPlan& plan,
                                      LatticePoint origin, std::int32_t first_row, std::int32_t rows) {
    const auto begin = static_cast<std::ptrdiff_t>(first_row) * grid.cols;
    const auto end = begin + static_cast<std::ptrdiff_t>(rows) * grid.cols;
    const BandShape shape{origin.row + first_row, rows, grid.cols};
    const auto elevations = std::make_shared<const ElevationBand>(
        ElevationBand{shape, {grid.z.begin() + begin, grid.z.begin() + end}});
    Context none;
    LabelBand labels = detect::detect_one_label(*elevations, none);
    if (!grid.labels.empty())
        labels.labels.assign(grid.labels.begin() + begin, grid.labels.begin() + end);
    LevelBand<Count> levels = contours::quantise<Count>(*elevations, labels, plan);
    return {elevations, std::move(labels), std::move(levels)};
}

template <typename Count>
ContourSet trace_levels(const TraceGrid& grid, const contours::LevelPlan& plan, const TraceSettings& settings,
                        Context& context) {
    ElevationStatistics statistics;
    statistics.add(grid.z);
    const contours::NoiseRules noise{settings.noise_factor, settings.min_area, plan.footprints};
    contours::ContourArchive store({noise,
                                    [](LatticePoint) { return 1.0; },
                                    statistics.range(),
                                    statistics.fixed_point(),
                                    settings.keep_roots,
                                    false,
                                    {settings.min_building_height, settings.ground, 1}},
                                   context.make_spool(), context);
    const Window window{settings.origin.row, settings.origin.col, grid.rows, grid.cols};
    const contours::TraceFrame frame{window, plan.level_count(), statistics.fixed_point(),
                                     statistics.range()};
    contours::Tracer tracer(frame, settings.mode, store);
    for (std::int32_t row = 0; row < grid.rows; row += settings.rows_a_band) {
        const std::int32_t rows = std::min(settings.rows_a_band, grid.rows - row);
        const std::int32_t above = std::min(row, contours::rows_above(settings.mode));
        const auto before = point_rows<Count>(grid, plan, settings.origin, row - above, above);
        const auto band = point_rows<Count>(grid, plan, settings.origin, row, rows);
        std::vector<contours::TraceLine> lines =
            contours::split_into_runs(frame, settings.mode, before, band);
        if (!settings.linked_alone) {
            tracer.trace(std::move(lines));
            continue;
        }
        contours::ContourBatch batch;
        Tally tally;
        contours::ContourWriter batch_writer = store.batch_writer(batch, tally);
        contours::LinkedBand linked =
            contours::Tracer::link(frame, settings.mode, std::move(lines), batch_writer);
        context.report.merge(tally);
        tracer.join(std::move(linked), store.add(std::move(batch)));
    }
    return fetch_set(store.finish());
}

/// Traces a grid with thresholds a label.
inline ContourSet trace_plan(const TraceGrid& grid, const contours::LevelPlan& plan,
                             const TraceSettings& settings, Context& context) {
    if (plan.level_count() <= 255)
        return trace_levels<std::uint8_t>(grid, plan, settings, context);
    return trace_levels<std::uint16_t>(grid, plan, settings, context);
}

/// Traces a grid with the same thresholds for every label.
inline ContourSet trace_grid(const TraceGrid& grid, const std::vector<double>& thresholds,
                             const TraceSettings& settings, Context& context) {
    ElevationStatistics statistics;
    statistics.add(grid.z);
    Label labels = 1;
    for (const Label label : grid.labels)
        labels = std::max(labels, label);
    contours::LevelPlan plan{statistics.minimum, std::vector<std::vector<double>>(labels + 1, thresholds)};
    plan.thresholds[0].clear();
    return trace_plan(grid, plan, settings, context);
}

}  // namespace d2b::test
