#include "detect/object_features.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace d2b::detect {
namespace {

constexpr std::int32_t ring_cells = 2;

/// Returns 0^2 + 1^2 + ... + n^2; for negative n, minus the sum of squares from n + 1 to 0.
double squares_to(double n) {
    return n * (n + 1) * (2 * n + 1) / 6;
}

constexpr double steepest = 0.55;

// A wall bends the surface by its height, or by a part of it if it is blurred over several cells: by more
// than this, plus this per metre of cell size.
constexpr double wall_bend_m = 0.5;
constexpr double wall_bend = 0.3;

struct Sums {
    double smooth = 0;
    double step = 0;
    double border = 0;
    double log_tilt = 0;
    double log_cells = 0;
    double pieces = 0;
    double green = 0;
    double inner_border = 0;  // number of border cells that are not on the raster's own border
    double walls = 0;         // number of these that bend like a wall
    double fall = 0;          // sum of their slopes
    double inner_step = 0;
    BorderSums beside;
    LowSlopePairs pairs;
    ShapeMoments form;
};

/// Returns the lowest elevation in the 3 x 3 neighbourhood; terrain substitutes cells without data.
float lowest_around(const Scene& scene, std::int32_t r, std::int32_t c) {
    float lowest = scene.surface.at(r, c);
    for (std::int32_t y = std::max(r - 1, 0); y <= std::min(r + 1, scene.surface.rows - 1); ++y)
        for (std::int32_t x = std::max(c - 1, 0); x <= std::min(c + 1, scene.surface.cols - 1); ++x) {
            const float z = scene.surface.at(y, x);
            lowest = std::min(lowest, std::isnan(z) ? scene.terrain.at(y, x) : z);
        }
    return lowest;
}

/// True if a cell has a neighbour that belongs to no object, or lies on the raster's border. Objects share no
/// edges, so labels need not be compared.
bool on_border(const Mask& cells, std::int32_t r, std::int32_t c) {
    return r == 0 || c == 0 || r + 1 == cells.rows || c + 1 == cells.cols || cells.at(r - 1, c) == 0 ||
           cells.at(r + 1, c) == 0 || cells.at(r, c - 1) == 0 || cells.at(r, c + 1) == 0;
}

void add_cells(const Scene& scene, const Grid<std::uint8_t>& flags, std::int32_t r, const RegionRun& run,
               Sums& sums) {
    const auto begin = static_cast<std::size_t>(run.begin);
    const auto end = static_cast<std::size_t>(run.end);
    int smooth = 0;
    for (std::size_t c = begin; c < end; ++c)
        smooth += (flags.row(r)[c] & smooth_enough) != 0 ? 1 : 0;
    sums.smooth += smooth;
    if (scene.greenness != nullptr)
        for (std::size_t c = begin; c < end; ++c)
            sums.green += scene.greenness->row(r)[c] > vegetation_ndvi ? 1 : 0;
}

/// Shape of the surface at a cell, which distinguishes walls from hillsides.
struct SurfaceBend {
    float bend = 0;  // largest second difference in m: planes do not bend, however steep
    float fall = 0;  // steepest slope down to a neighbour (m/m)
};

/// Distances in m to the neighbours in the row, in the column and on the diagonal.
struct Distances {
    explicit Distances(const CellSize& cell)
        : beside(static_cast<float>(std::hypot(0.0, cell.across))),
          below(static_cast<float>(std::hypot(cell.down, 0.0))),
          across_corner(static_cast<float>(std::hypot(cell.down, cell.across))) {}

    float beside;
    float below;
    float across_corner;
};

/// Terrain substitutes cells without data.
SurfaceBend surface_bend_at(const Scene& scene, const Distances& distances, std::int32_t r, std::int32_t c) {
    const auto at = [&](std::int32_t down, std::int32_t across) {
        const float z = scene.surface.at(r + down, c + across);
        return std::isnan(z) ? scene.terrain.at(r + down, c + across) : z;
    };
    const float here = at(0, 0);
    SurfaceBend turn;
    const auto visit = [&](std::int32_t down, std::int32_t across, float distance) {
        const float one = at(-down, -across);
        const float other = at(down, across);
        turn.bend = std::max(turn.bend, std::abs(one + other - 2 * here));
        turn.fall = std::max(turn.fall, (here - std::min(one, other)) / distance);
    };
    visit(0, 1, distances.beside);
    visit(1, 0, distances.below);
    visit(1, 1, distances.across_corner);
    visit(1, -1, distances.across_corner);
    return turn;
}

void add_border(const Scene& scene, const Distances& distances, const Mask& cells, std::int32_t r,
                const RegionRun& run, Sums& sums) {
    for (std::int32_t c = run.begin; c < run.end; ++c)
        if (on_border(cells, r, c) && !std::isnan(scene.surface.at(r, c))) {
            sums.border += 1;
            sums.beside.add(scene, cells, r, c);
            const auto step = static_cast<double>(scene.surface.at(r, c) - lowest_around(scene, r, c));
            sums.step += step;
            if (r == 0 || c == 0 || r + 1 == cells.rows || c + 1 == cells.cols)
                continue;
            const SurfaceBend turn = surface_bend_at(scene, distances, r, c);
            sums.inner_border += 1;
            sums.inner_step += step;
            sums.walls += static_cast<double>(turn.bend) > wall_bend_m + wall_bend * scene.side() ? 1 : 0;
            sums.fall += static_cast<double>(turn.fall);
        }
}

/// Contribution of a segment per cell.
struct SegmentLogs {
    double tilt;
    double cells;
};

std::vector<SegmentLogs> logs_of(const SmoothSegments& segments) {
    std::vector<SegmentLogs> result;
    result.reserve(segments.pieces.size());
    for (const SmoothSegment& piece : segments.pieces)
        result.push_back({std::log(piece.tilt + 0.02), std::log(static_cast<double>(piece.cells))});
    return result;
}

/// @param pieces runs of segments in the row
void add_segments(std::span<const RegionRun> pieces, const std::vector<SegmentLogs>& logs,
                  const RegionRun& run, Sums& sums) {
    auto piece = std::partition_point(pieces.begin(), pieces.end(),
                                      [&](const RegionRun& before) { return before.end <= run.begin; });
    for (; piece != pieces.end() && piece->begin < run.end; ++piece) {
        const SegmentLogs& add = logs[piece->label - 1];
        for (std::int32_t c = std::max(piece->begin, run.begin); c < std::min(piece->end, run.end); ++c) {
            sums.pieces += 1;
            sums.log_tilt += add.tilt;
            sums.log_cells += add.cells;
        }
    }
}

ObjectFeatures features_of(const Sums& sums, double cells, double cell_area) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const double pieces = std::max(sums.pieces, 1.0);
    return {sums.smooth / cells,
            sums.step / std::max(sums.border, 1.0),
            std::exp(sums.log_tilt / pieces),
            std::exp(sums.log_cells / pieces),
            sums.green / cells,
            sums.inner_border > 0 ? sums.walls / sums.inner_border : 1.0,
            sums.fall / std::max(sums.inner_border, 1.0),
            sums.beside.height_beside(),
            sums.beside.right_angles(),
            cells * cell_area,
            sums.pairs.share(),
            sums.form.compactness(),
            sums.inner_border > 0 ? sums.inner_step / sums.inner_border : unknown};
}

}  // namespace

void BorderSums::add(const Scene& scene, const Mask& objects, std::int32_t r, std::int32_t c) {
    double heights = heights_;
    double cells = cells_;
    const std::int32_t left = std::max(c - ring_cells, 0);
    const std::int32_t right = std::min(c + ring_cells, objects.cols - 1);
    for (std::int32_t y = std::max(r - ring_cells, 0); y <= std::min(r + ring_cells, objects.rows - 1); ++y) {
        const std::uint8_t* const object = objects.row(y).data();
        const float* const z = scene.surface.row(y).data();
        const float* const ground = scene.terrain.row(y).data();
        for (std::int32_t x = left; x <= right; ++x)
            if (object[x] == 0 && !std::isnan(z[x])) {
                heights += static_cast<double>(std::max(0.0F, z[x] - ground[x]));
                cells += 1;
            }
    }
    heights_ = heights;
    cells_ = cells;
    if (r > 0 && c > 0 && r + 1 < objects.rows && c + 1 < objects.cols)
        add_gradient(scene.surface, r, c);
}

void BorderSums::add_gradient(const MetreGrid& surface, std::int32_t r, std::int32_t c) {
    double across = 0;
    double down = 0;
    for (const std::int32_t k : {-1, 0, 1}) {
        const double weight = k == 0 ? 2 : 1;
        across += weight * static_cast<double>(surface.at(r + k, c + 1) - surface.at(r + k, c - 1));
        down += weight * static_cast<double>(surface.at(r + 1, c + k) - surface.at(r - 1, c + k));
    }
    const double size = std::hypot(across, down);
    if (std::isnan(size) || size == 0)
        return;
    // Squaring a complex number doubles its angle.
    const double twice_cosine = (across * across - down * down) / (size * size);
    const double twice_sine = 2 * across * down / (size * size);
    cosine_ += size * (twice_cosine * twice_cosine - twice_sine * twice_sine);
    sine_ += size * 2 * twice_cosine * twice_sine;
    gradients_ += size;
}

double BorderSums::height_beside() const {
    return cells_ > 0 ? heights_ / cells_ : 0;
}

double BorderSums::right_angles() const {
    return gradients_ > 0 ? std::hypot(cosine_, sine_) / gradients_ : 0;
}

void ShapeMoments::add(std::int32_t r, const RegionRun& run) {
    if (cells_ == 0) {
        first_row_ = r;
        first_col_ = run.begin;
    }
    const double y = r - first_row_;
    const double first = run.begin - first_col_;
    const double last = run.end - 1 - first_col_;
    const double n = last - first + 1;
    const double across = n * (first + last) / 2;
    cells_ += n;
    down_ += n * y;
    across_ += across;
    down_down_ += n * y * y;
    across_across_ += squares_to(last) - squares_to(first - 1);
    down_across_ += y * across;
}

ShapeMoments::Variances ShapeMoments::variances() const {
    constexpr double within_a_cell = 1.0 / 12;
    const double down = down_ / cells_;
    const double across = across_ / cells_;
    return {down_down_ / cells_ - down * down + within_a_cell,
            across_across_ / cells_ - across * across + within_a_cell, down_across_ / cells_ - down * across};
}

double ShapeMoments::compactness() const {
    if (cells_ == 0)
        return 1;
    const Variances v = variances();
    const double spread = v.down * v.across - v.down_across * v.down_across;
    return cells_ / (4 * std::numbers::pi * std::sqrt(spread));
}

double ShapeMoments::largest_variance(const CellSize& cell) const {
    if (cells_ == 0)
        return 0;
    const Variances v = variances();
    const double down = v.down * cell.down * cell.down;
    const double across = v.across * cell.across * cell.across;
    const double mixed = v.down_across * cell.down * cell.across;
    return (down + across) / 2 + std::hypot((down - across) / 2, mixed);
}

void LowSlopePairs::add(const Scene& scene, const Mask& objects, std::int32_t r, const RegionRun& run) {
    const std::span<const float> here = scene.surface.row(r);
    const auto begin = static_cast<std::size_t>(run.begin);
    const auto end = static_cast<std::size_t>(run.end);
    // Comparisons with NaN are false, so unknown heights do not count as gentle.
    const auto across = static_cast<float>(steepest * scene.cell.across);
    int low_slope = 0;
    for (std::size_t c = begin; c + 1 < end; ++c)
        low_slope += std::abs(here[c] - here[c + 1]) < across ? 1 : 0;
    auto pairs = run.end - run.begin - 1;
    if (r + 1 < objects.rows) {
        const std::span<const float> below = scene.surface.row(r + 1);
        const std::span<const std::uint8_t> object_below = objects.row(r + 1);
        const auto down = static_cast<float>(steepest * scene.cell.down);
        for (std::size_t c = begin; c < end; ++c) {
            pairs += object_below[c];
            low_slope += object_below[c] != 0 && std::abs(here[c] - below[c]) < down ? 1 : 0;
        }
    }
    pairs_ += pairs;
    low_slope_ += low_slope;
}

double LowSlopePairs::share() const {
    return pairs_ > 0 ? static_cast<double>(low_slope_) / static_cast<double>(pairs_) : 1;
}

std::vector<ObjectFeatures> compute_features(const Scene& scene, const ObjectRegions& objects,
                                             const SmoothSegments& segments, const Grid<std::uint8_t>& flags,
                                             Executor& threads) {
    const std::vector<SegmentLogs> logs = logs_of(segments);
    const Distances distances(scene.cell);
    std::vector<Sums> sums(objects.regions.count());
    for_runs_by_label(threads, objects.regions, [&](std::int32_t r, const RegionRun& run) {
        Sums& sum = sums[run.label - 1];
        add_cells(scene, flags, r, run, sum);
        add_border(scene, distances, objects.cells, r, run, sum);
        sum.pairs.add(scene, objects.cells, r, run);
        sum.form.add(r, run);
        add_segments(segments.regions.row(r), logs, run, sum);
    });
    std::vector<ObjectFeatures> result;
    result.reserve(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
        result.push_back(
            features_of(sums[i], static_cast<double>(objects.regions.cells[i + 1]), scene.cell_area()));
    return result;
}

}  // namespace d2b::detect
