#include "diagnose/sampling_doubt.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "diagnose/words.hpp"

namespace d2b {
namespace {

// Seville's cathedral at 1 m has 0.06, the pines of docs/accuracy.md in a sparse scan 0.085.
constexpr double most_filled = 0.08;
// Ann Arbor, which was resampled, has 1.9; the town of docs/accuracy.md as seen by a satellite has 4.4.
constexpr double widest_step = 2.5;

}  // namespace

std::string thin_doubt(const SamplingReport& report, double side) {
    if (report.filled_share <= most_filled || !report.points_per_cell)
        return {};
    return "points are thin: about " + rounded(*report.points_per_cell) + " fell into a cell of " +
           rounded(side) + " m, and none into " + percent(report.filled_share) +
           " of the cells, so roofs look rough, small houses may be missed, and crowns taken for houses; use "
           "a "
           "denser scan, or look through what was left out with -write_doubtful";
}

std::string blur_doubt(const SamplingReport& report, double side) {
    if (!report.step_width_cells || *report.step_width_cells <= widest_step)
        return {};
    const std::string metres = rounded(*report.step_width_cells * side) + " m";
    return "walls are smeared: they fall over " + rounded(*report.step_width_cells) + " cells (" + metres +
           "), as in surfaces from satellites or of finer cells than their data, so gaps and courtyards "
           "narrower than that are closed, and corners and small houses lost; use a surface whose walls fall "
           "within two cells";
}

std::string rounding_doubt(const SamplingReport& report, double metres) {
    constexpr double least_m = 0.5;
    constexpr double rounding = 1e-6;
    const double step = report.value_step.value_or(0) * metres;
    if (step < least_m - rounding)
        return {};
    return "elevations are rounded to steps of " + number_text(std::round(step * 100) / 100) +
           " m, so a roof may be as rough as a crown, and low buildings, small parts and heights are "
           "uncertain by "
           "as much; use elevations that are rounded to centimetres, or not at all";
}

}  // namespace d2b
