#include "detect/surface_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

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

/// Samples the core cells of a unit, row by row.
class SamplingOfRows {
  public:
    SamplingOfRows(const Scene& scene, const Detection& detection, double min_height, const Window& own,
                   SurfaceSampling& sampling)
        : scene_(scene),
          detection_(detection),
          min_height_(static_cast<float>(min_height)),
          own_(own),
          limit_(smoothness_thresholds(scene.side(), {}).enough),
          sampling_(sampling) {}

    void add(RowBand band);

  private:
    /// Flags elevated cells that bend both ways: core columns of a row, and one more if there is one.
    void find_rough(std::int32_t r, std::vector<std::uint8_t>& rough) const;
    void add_pairs(std::int32_t r, const std::vector<std::uint8_t>& here,
                   const std::vector<std::uint8_t>& below);
    /// Adds the steps at core cells of buildings in a row.
    void add_steps(std::int32_t r);
    void add_step(std::int32_t r, std::int32_t c, std::int32_t down, std::int32_t right);

    const Scene& scene_;
    const Detection& detection_;
    float min_height_;
    const Window& own_;
    float limit_;
    SurfaceSampling& sampling_;
};

void SamplingOfRows::find_rough(std::int32_t r, std::vector<std::uint8_t>& rough) const {
    const MetreGrid& z = scene_.surface;
    rough.assign(static_cast<std::size_t>(own_.cols) + 1, 0);
    if (r >= z.rows)
        return;
    const float* here = z.row(r).data();
    const float* above = z.row(std::max(r - 1, 0)).data();
    const float* below = z.row(std::min(r + 1, z.rows - 1)).data();
    const float* ground = scene_.terrain.row(r).data();
    const float least = min_height_;
    const float limit = limit_;
    // Local pointer, because stores through it must not alias the inputs.
    std::uint8_t* const out = rough.data();
    const std::int32_t first = own_.col;
    const auto visit = [&](std::int32_t c, std::int32_t left, std::int32_t right) {
        const float twice = 2 * here[c];
        const float along_row = std::abs(here[left] + here[right] - twice);
        const float along_column = std::abs(above[c] + below[c] - twice);
        const int elevated = here[c] - ground[c] > least ? 1 : 0;
        const int smooth = (along_row < limit ? 1 : 0) | (along_column < limit ? 1 : 0);
        out[c - first] = static_cast<std::uint8_t>(elevated & (smooth ^ 1));
    };
    const std::int32_t end = std::min(own_.end_col() + 1, z.cols);
    const std::int32_t inner = std::min(end, z.cols - 1);
    for (std::int32_t c = std::max(first, 1); c < inner; ++c)
        visit(c, c - 1, c + 1);
    if (first == 0)
        visit(0, 0, std::min(1, z.cols - 1));
    if (end == z.cols)
        visit(z.cols - 1, std::max(z.cols - 2, 0), z.cols - 1);
}

/// Adds the differences to the next cell and to the cell below.
void SamplingOfRows::add_pairs(std::int32_t r, const std::vector<std::uint8_t>& here,
                               const std::vector<std::uint8_t>& below) {
    const MetreGrid& z = scene_.surface;
    const auto own =
        z.row(r).subspan(static_cast<std::size_t>(own_.col), static_cast<std::size_t>(own_.cols));
    add_differences(own, z.row(std::min(r + 1, z.rows - 1)).data() + own_.col, here, below, sampling_.rough);
}

/// @param r, c cell of a building
/// @param down, right offset to the neighbour outside
void SamplingOfRows::add_step(std::int32_t r, std::int32_t c, std::int32_t down, std::int32_t right) {
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
    ++sampling_.steps;
    sampling_.falls += std::llround(1000 * static_cast<double>(fall));
    sampling_.steepest += std::llround(1000 * static_cast<double>(largest));
}

void SamplingOfRows::add(RowBand band) {
    std::vector<std::uint8_t> here;
    std::vector<std::uint8_t> below;
    find_rough(band.begin, here);
    const std::int32_t stride = sampled_row_stride(own_.rows, own_.cols);
    for (std::int32_t r = band.begin; r < band.end; ++r) {
        if (r % stride == 0)
            sampling_.values.add(scene_.surface.row(r).subspan(static_cast<std::size_t>(own_.col),
                                                               static_cast<std::size_t>(own_.cols)));
        find_rough(r + 1, below);
        add_pairs(r, here, below);
        std::swap(here, below);
        add_steps(r);
    }
}

void SamplingOfRows::add_steps(std::int32_t r) {
    const Grid<Label>& labels = detection_.labels;
    const auto own = [&](std::int32_t row) {
        return labels.row(row).subspan(static_cast<std::size_t>(own_.col),
                                       static_cast<std::size_t>(own_.cols));
    };
    for_equal_runs(own(r), [&](std::int32_t begin, std::int32_t end, Label label) {
        if (!detection_.is_building(label))
            return;
        sampling_.built += end - begin;
        add_step(r, own_.col + begin, 0, -1);
        add_step(r, own_.col + end - 1, 0, 1);
        for (const std::int32_t down : {1, -1}) {
            if (r + down < 0 || r + down >= labels.rows)
                continue;
            const auto beside = own(r + down);
            for (std::int32_t c = begin; c < end; ++c)
                if (beside[static_cast<std::size_t>(c)] == 0)  // otherwise the same as inside of buildings
                    add_step(r, own_.col + c, down, 0);
        }
    });
}

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
    sampling.merge(reduce_row_bands(threads, own.rows, own.cols, SurfaceSampling(),
                                    [&](RowBand band, SurfaceSampling& sum) {
                                        SamplingOfRows(scene, detection, min_height, own, sum)
                                            .add({own.row + band.begin, own.row + band.end});
                                    }));
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
