#include "survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "blur.hpp"
#include "random.hpp"
#include "scan.hpp"

namespace d2b::sample {

namespace {

constexpr std::int32_t rows_at_a_time = 64;

std::array<Survey, 9> table() {
    return {{
        {.name = "lidar20", .cell = 0.5, .pulses = 20},
        {.name = "lidar8", .cell = 0.5, .pulses = 8},
        {.name = "lidar2", .cell = 1, .pulses = 2, .beam = 0.25},
        {.name = "interpolated",
         .cell = 1,
         .pulses = 0.5,
         .beam = 0.25,
         .fill_reach = 4,
         .filling = GapFilling::weighted},
        {.name = "thin", .cell = 2, .pulses = 10, .kept = 0.06, .beam = 0.25},
        {.name = "thinned", .cell = 2.5, .pulses = 10, .kept = 0.03, .beam = 0.25},
        {.name = "metres", .cell = 2.5, .pulses = 2, .beam = 0.25, .step = 1, .heights_alone = true},
        {.name = "whole", .cell = 0.5, .pulses = 4, .step = 1},
        {.name = "satellite", .cell = 1, .pulses = 0, .range_noise = 0.1, .blur = 2},
    }};
}

/// The surface itself at the middles of cells.
void sample_surface(const Scene& scene, const Grid& grid, std::span<double> metres) {
    std::size_t i = 0;
    for (std::int32_t row = 0; row < grid.rows; ++row)
        for (std::int32_t col = 0; col < grid.cols; ++col)
            metres[i++] = scene.ground.at(grid.centre(row, col));
    raise(scene, grid, 0, grid.rows, metres);
}

void scan_all(const Scene& scene, const Grid& grid, const Survey& survey, std::span<double> metres) {
    for (std::int32_t row = 0; row < grid.rows; row += rows_at_a_time) {
        const std::int32_t rows = std::min(rows_at_a_time, grid.rows - row);
        scan(scene, grid, survey, row, rows,
             metres.subspan(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.cols),
                            static_cast<std::size_t>(rows) * static_cast<std::size_t>(grid.cols)));
    }
}

double rounded(double z, double step) {
    return std::floor(z / step + 0.5) * step;
}

}  // namespace

std::span<const Survey> surveys() {
    static const auto all = table();
    return all;
}

Seen see(const Scene& scene, const Grid& grid, const Survey& survey) {
    std::vector<double> metres(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols));
    if (survey.pulses > 0) {
        scan_all(scene, grid, survey, metres);
        fill_gaps(metres, grid.cols, survey.fill_reach, survey.filling);
    } else {
        sample_surface(scene, grid, metres);
    }
    if (survey.blur > 0)
        blur(metres, grid.cols, survey.blur / survey.cell);
    Seen seen{grid, {}};
    seen.elevations.reserve(metres.size());
    for (std::int32_t row = 0; row < grid.rows; ++row)
        for (std::int32_t col = 0; col < grid.cols; ++col) {
            double z = metres[seen.elevations.size()];
            // Pulses have their noise already.
            if (survey.pulses == 0)
                z += survey.range_noise * normal_at(scene.seed, row, col);
            const double from = survey.heights_alone ? scene.ground.at(grid.centre(row, col)) : 0;
            seen.elevations.push_back(static_cast<float>(from + rounded(z - from, survey.step)));
        }
    return seen;
}

}  // namespace d2b::sample
