#include "detect/surface_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/grid.hpp"
#include "detect/smoothness.hpp"

namespace d2b::detect {
namespace {

constexpr std::int32_t sampling_reach = SurfaceSampling::reach;
constexpr std::int64_t fewest_steps = 100;
/// At least one rough pair per this many cells of buildings: scans have two thirds to two pairs per cell,
/// block models on a terrain a fiftieth, at their corners.
constexpr std::int64_t least_rough = 10;
/// Smallest share of cells without a point that can be distinguished from none.
constexpr double least_filled = 0.01;
/// Distance between the 10 % and 90 % quantiles of a normal distribution, in standard deviations.
constexpr double tenths = 2.5631;

/// Steps at the borders of buildings.
class StepsOfRows {
  public:
    StepsOfRows(const Scene& scene, const Detection& detection, double min_height, const Window& own)
        : scene_(scene), detection_(detection), min_height_(static_cast<float>(min_height)), own_(own) {}

    /// Adds the steps at core cells of buildings in a row.
    void add(std::int32_t r, SurfaceSampling& sampling) const {
        const Grid<Label>& labels = detection_.labels;
        const auto own = [&](std::int32_t row) {
            return labels.row(row).subspan(static_cast<std::size_t>(own_.col),
                                           static_cast<std::size_t>(own_.cols));
        };
        for_equal_runs(own(r), [&](std::int32_t begin, std::int32_t end, Label label) {
            if (!detection_.is_building(label))
                return;
            sampling.built += end - begin;
            add_step(r, own_.col + begin, 0, -1, sampling);
            add_step(r, own_.col + end - 1, 0, 1, sampling);
            for (const std::int32_t down : {1, -1}) {
                if (r + down < 0 || r + down >= labels.rows)
                    continue;
                const auto beside = own(r + down);
                for (std::int32_t c = begin; c < end; ++c)
                    if (beside[static_cast<std::size_t>(c)] == 0)  // otherwise inside of buildings
                        add_step(r, own_.col + c, down, 0, sampling);
            }
        });
    }

  private:
    /// @param r, c cell of a building
    /// @param down, right offset to the neighbour outside
    void add_step(std::int32_t r, std::int32_t c, std::int32_t down, std::int32_t right,
                  SurfaceSampling& sampling) const {
        const Grid<Label>& labels = detection_.labels;
        if (!labels.holds(r - (sampling_reach - 1) * down, c - (sampling_reach - 1) * right) ||
            !labels.holds(r + sampling_reach * down, c + sampling_reach * right))
            return;
        if (labels.at(r + down, c + right) != 0)  // same as inside of buildings
            return;
        float largest = 0;
        float fall = 0;
        for (std::int32_t i = 1 - sampling_reach; i <= sampling_reach; ++i) {
            const Label label = labels.at(r + i * down, c + i * right);
            if (i <= 0 ? !detection_.is_building(label) : label != 0)
                return;
            if (i == sampling_reach)
                break;
            const float next = scene_.surface.at(r + i * down, c + i * right) -
                               scene_.surface.at(r + (i + 1) * down, c + (i + 1) * right);
            largest = std::max(largest, next);
            fall += next;
        }
        constexpr float no_elevation = 10000;                 // sums of odd values would overflow
        if (!(fall > min_height_ && largest < no_elevation))  // also true for NaN
            return;
        ++sampling.steps;
        sampling.falls += std::llround(1000 * static_cast<double>(fall));
        sampling.steepest += std::llround(1000 * static_cast<double>(largest));
    }

    const Scene& scene_;
    const Detection& detection_;
    float min_height_;
    const Window& own_;
};

double normal(double x) {
    return std::erfc(-x / std::numbers::sqrt2) / 2;
}

/// Returns the standard deviation, in cells, of the blur that turns a wall into a slope whose total fall is
/// `ratio` times its largest difference.
double blur_of(double ratio) {
    constexpr double half = SurfaceSampling::reach - 0.5;  // cells, from the wall to both ends
    const auto ratio_at = [](double blur) {
        return (2 * normal(half / blur) - 1) / (2 * normal(0.5 / blur) - 1);
    };
    double less = 0.01;
    double more = 100;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = std::sqrt(less * more);
        (ratio_at(middle) < ratio ? less : more) = middle;
    }
    return less;
}

}  // namespace

void SurfaceSampling::merge(const SurfaceSampling& other) {
    rough.merge(other.rough);
    built += other.built;
    steps += other.steps;
    falls += other.falls;
    steepest += other.steepest;
    values.merge(other.values);
}

void add_sampling(const Scene& scene, const Detection& detection, double min_height, const Window& own,
                  SurfaceSampling& sampling, Executor& threads) {
    Scene everywhere = scene;
    everywhere.allowed = nullptr;
    sampling.rough.merge(rough_differences(
        scene.surface, elevated_cells(everywhere, min_height, threads),
        smoothness(scene.surface, smoothness_thresholds(scene.side(), {}), threads), own, threads));
    const StepsOfRows steps(scene, detection, min_height, own);
    const std::int32_t stride = sampled_row_stride(own.rows, own.cols);
    const auto add_row = [&](std::int32_t row, SurfaceSampling& sum) {
        const std::int32_t r = own.row + row;
        if (r % stride == 0)
            sum.values.add(scene.surface.row(r).subspan(static_cast<std::size_t>(own.col),
                                                        static_cast<std::size_t>(own.cols)));
        steps.add(r, sum);
    };
    sampling.merge(reduce_rows(threads, own.rows, own.cols, SurfaceSampling(), add_row));
}

SamplingReport sampling_report(const SurfaceSampling& sampling, double metres) {
    SamplingReport report;
    if (sampling.rough.all * least_rough >= sampling.built)
        report.interpolated_fraction = interpolated_fraction(sampling.rough);
    if (report.interpolated_fraction >= least_filled)
        report.points_per_cell = -std::log(report.interpolated_fraction);
    if (sampling.steps >= fewest_steps)
        report.edge_width_cells =
            tenths * blur_of(static_cast<double>(sampling.falls) / static_cast<double>(sampling.steepest));
    if (const std::optional<double> step = value_step(sampling.values))
        report.value_step = nearest_round_step(*step / metres);
    return report;
}

}  // namespace d2b::detect
