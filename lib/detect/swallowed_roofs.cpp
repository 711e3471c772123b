#include "detect/swallowed_roofs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/grid.hpp"
#include "detect/detection_passes.hpp"
#include "detect/object_features.hpp"
#include "raster/morphology.hpp"
#include "raster/plane_sums.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {
namespace {

// Chosen on the places in docs/research/places.md, see docs/research/ground.md.
constexpr double lowest_wall_m = 1.5;  // as in the ground filter
constexpr double wall_slope = 1;       // steep ground falls by more than that within a coarse cell
constexpr double level_step_m = 0.5;   // neighbours that differ by less belong together ...
constexpr double level_slope = 0.6;    // ... or that slope by less
constexpr double finer_than_m = 1.2;   // cells of which a wall may cover two
constexpr double least_walled = 0.4;   // share of the border that falls by a wall
constexpr double most_above = 0.5;     // share of the height of a piece that is above the terrain
constexpr double least_confidence = 0.5;
constexpr double confidence_share = 0.5;

struct BorderDirection {
    std::int32_t down;
    std::int32_t across;
};

/// Fall of the surface, in m, that is a wall if it happens within `wall_cells`.
float wall_height(const Scene& scene) {
    return static_cast<float>(std::max(lowest_wall_m, wall_slope * scene.side()));
}
std::int32_t wall_cells(const Scene& scene) {
    return scene.side() <= finer_than_m ? 2 : 1;
}

/// Returns the valid cells within the allowed area that neither belong to an object nor touch one.
Mask free_cells(const Scene& scene, const Regions& objects, Executor& threads) {
    Mask result = cells_where(
        scene, [](float z, float) { return !std::isnan(z); }, threads);
    clear_with_border(objects, result, threads);
    return result;
}

/// Finds the lowest elevation within some cells along the row and column of each cell of a row.
void lowest_along_lines(const MetreGrid& surface, std::int32_t r, std::int32_t cells, std::span<float> low) {
    // Comparisons with NaN are false, because unknown cells give no evidence of a wall.
    const auto lower = [](float one, float other) { return other < one ? other : one; };
    const std::span<const float> z = surface.row(r);
    std::ranges::copy(z, low.begin());
    for (std::int32_t k = 1; k <= cells; ++k) {
        const std::span<const float> up = surface.row(std::max(r - k, 0));
        const std::span<const float> down = surface.row(std::min(r + k, surface.rows - 1));
        for (std::size_t c = 0; c < low.size(); ++c)
            low[c] = lower(lower(low[c], up[c]), down[c]);
        const auto beside = static_cast<std::size_t>(k);
        for (std::size_t c = beside; c < low.size(); ++c)
            low[c] = lower(low[c], z[c - beside]);
        for (std::size_t c = beside; c < low.size(); ++c)
            low[c - beside] = lower(low[c - beside], z[c]);
    }
}

/// Returns the cells from which the surface falls by a wall along their row or column.
/// @param free only these cells
Mask tops_of_walls(const Scene& scene, const Mask& free, Executor& threads) {
    const MetreGrid& surface = scene.surface;
    Mask tops = Mask::unset(surface.rows, surface.cols, threads);
    for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
        std::vector<float> low(static_cast<std::size_t>(surface.cols));
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            lowest_along_lines(surface, r, wall_cells(scene), low);
            // A local value, because stores of bytes may alias anything.
            const float wall = wall_height(scene);
            const std::span<const float> z = surface.row(r);
            const std::span<const std::uint8_t> in = free.row(r);
            const std::span<std::uint8_t> out = tops.row(r);
            for (std::size_t c = 0; c < out.size(); ++c)
                out[c] = static_cast<std::uint8_t>(in[c] & (z[c] - low[c] > wall ? 1 : 0));
        }
    });
    return tops;
}

/// Flags the regions that have a cell of a mask, by label.
std::vector<std::uint8_t> regions_with(const Regions& regions, const Mask& mask) {
    std::vector<std::uint8_t> has(regions.cells.size(), 0);
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        const auto cells = mask.row(r);
        const auto end = cells.begin() + run.end;
        if (std::find(cells.begin() + run.begin, end, 1) != end)
            has[run.label] = 1;
    });
    return has;
}

/// Labels regions of cells in which neighbours differ by little.
Regions level_regions(const Scene& scene, const Mask& cells, std::int64_t min_cells, Executor& threads) {
    const auto links_of = [&](std::int32_t r, std::vector<std::uint8_t>& links) {
        const auto step = static_cast<float>(std::max(level_step_m, level_slope * scene.side()));
        links.resize(static_cast<std::size_t>(cells.cols));
        const std::span<std::uint8_t> out(links);
        const std::span<const std::uint8_t> in = cells.row(r);
        const std::span<const std::uint8_t> in_up = cells.row(std::max(r - 1, 0));
        const std::span<const float> z = scene.surface.row(r);
        const std::span<const float> z_up = scene.surface.row(std::max(r - 1, 0));
        const int has_up = r > 0 ? 1 : 0;
        static_assert(link_in == 1 && link_left == 2 && link_up == 4);
        // Bytes and shifts only, so that the loops vectorise.
        for (std::size_t c = 0; c < out.size(); ++c) {
            const int up = in[c] & in_up[c] & has_up & (std::abs(z[c] - z_up[c]) < step ? 1 : 0);
            out[c] = static_cast<std::uint8_t>(in[c] | up << 2);
        }
        for (std::size_t c = 1; c < out.size(); ++c)
            out[c] |= static_cast<std::uint8_t>(
                (in[c] & in[c - 1] & (std::abs(z[c] - z[c - 1]) < step ? 1 : 0)) << 1);
    };
    return linked_regions(cells.rows, cells.cols, links_of, min_cells, threads);
}

/// Finds level pieces of the surface that no street leads up to. The tops of walls are taken off first,
/// because a blurred wall falls in steps that are as low as those within a roof.
/// @param free cells that may be part of a piece
Regions level_pieces(const Scene& scene, Mask free, std::int64_t min_cells, Executor& threads) {
    const auto is_short = [&](const CellBox& box) {
        return std::max(box.rows() * scene.cell.down, box.cols() * scene.cell.across) <=
               scene.longest_swallowed;
    };
    const Mask tops = tops_of_walls(scene, free, threads);
    for_cells(threads, free, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            free.values[i] ^= tops.values[i];
    });
    // A quarter of the cells, because the others may be tops of walls.
    const Regions inner = level_regions(scene, free, min_cells / 4, threads);
    const std::vector<CellBox> inner_boxes = bounding_boxes(inner);
    free = mask_of(
        inner, [&](Label label) { return is_short(inner_boxes[label]); }, threads);
    // Twice the width of the tops, because a corner is that far away.
    Regions pieces =
        level_regions(scene, dilate_within(free, tops, 2 * wall_cells(scene), threads), min_cells, threads);
    // Growth also reaches the tops of higher walls beside a piece.
    const std::vector<std::uint8_t> has_inner = regions_with(pieces, free);
    const std::vector<CellBox> boxes = bounding_boxes(pieces);
    keep_regions(pieces, [&](Label label) { return has_inner[label] != 0 && is_short(boxes[label]); });
    return pieces;
}

/// Sides of the cells of a piece at its border.
struct BorderSides {
    std::int64_t all = 0;
    std::int64_t walled = 0;
    double feet = 0;  ///< elevation below its walls, sum over sides with a wall

    [[nodiscard]] bool are_walled() const {
        return walled > 0 && static_cast<double>(walled) >= least_walled * static_cast<double>(all);
    }
};

/// Surface of a piece.
struct PieceSums {
    PlaneSums plane;
    double elevation = 0;  ///< sum over cells
    double above = 0;      ///< height above the terrain, sum over cells

    /// @param min_height smallest height above the feet of the walls, in m
    [[nodiscard]] bool is_above(const BorderSides& sides, double min_height) const {
        const auto cells = static_cast<double>(plane.count());
        const double height = elevation / cells - sides.feet / static_cast<double>(sides.walled);
        return height >= min_height && above / cells < most_above * height;
    }
};

std::vector<PieceSums> piece_sums(const Scene& scene, const Regions& pieces, Executor& threads) {
    std::vector<PieceSums> sums(pieces.count());
    for_runs_by_label(threads, pieces, [&](std::int32_t r, const RegionRun& run) {
        PieceSums& sum = sums[run.label - 1];
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            const float z = scene.surface.at(r, c);
            sum.plane.add(r, c, z, scene.cell);
            sum.elevation += static_cast<double>(z);
            sum.above += static_cast<double>(z - scene.terrain.at(r, c));
        }
    });
    return sums;
}

/// Measures the borders of pieces.
class Border {
  public:
    /// @param planes of the pieces
    Border(const Scene& scene, const Regions& pieces, const std::vector<Plane>& planes)
        : scene_(scene), pieces_(pieces), planes_(planes) {}

    [[nodiscard]] std::vector<BorderSides> sides(Executor& threads) const {
        std::vector<BorderSides> sides(pieces_.count());
        for_runs_by_label(threads, pieces_, [&](std::int32_t r, const RegionRun& run) {
            BorderSides& sum = sides[run.label - 1];
            for (const std::int32_t down : {-1, 1})
                for_uncovered(r + down, run, [&](std::int32_t c) { add(r, c, {down, 0}, run.label, sum); });
            if (!is_in(r, run.begin - 1, run.label))
                add(r, run.begin, {0, -1}, run.label, sum);
            if (!is_in(r, run.end, run.label))
                add(r, run.end - 1, {0, 1}, run.label, sum);
        });
        return sides;
    }

  private:
    /// Calls use(column) for the columns of a run in which another row has no cell of the same piece.
    template <typename Use>
    void for_uncovered(std::int32_t row, const RegionRun& run, const Use& use) const {
        std::int32_t c = run.begin;
        if (row >= 0 && row < pieces_.rows) {
            const std::span<const RegionRun> runs = pieces_.row(row);
            auto other =
                std::ranges::partition_point(runs, [&](const RegionRun& before) { return before.end <= c; });
            for (; other != runs.end() && other->begin < run.end; ++other) {
                if (other->label != run.label)
                    continue;
                for (; c < other->begin; ++c)
                    use(c);
                c = other->end;
            }
        }
        for (; c < run.end; ++c)
            use(c);
    }
    /// Adds a side of a cell beyond which another cell begins that is not part of the piece.
    void add(std::int32_t r, std::int32_t c, const BorderDirection& side, Label label,
             BorderSides& sum) const {
        sum.all += 1;
        const auto wall = static_cast<double>(wall_height(scene_));
        const double below = static_cast<double>(scene_.surface.at(r, c)) - wall;
        double foot = std::numeric_limits<double>::infinity();
        double there = 0;  // elevation of the plane
        for (std::int32_t k = 1; k <= wall_cells(scene_); ++k) {
            const std::int32_t row = r + k * side.down;
            const std::int32_t col = c + k * side.across;
            if (!is_inside(row, col))
                break;
            const auto z = static_cast<double>(scene_.surface.at(row, col));
            if (!(z < std::min(foot, below)) || is_in(row, col, label))
                continue;
            foot = z;
            there = planes_[label - 1].at(row, col, scene_.cell);
        }
        // A gap in a wood on a steep slope falls as well, but no lower than its own plane does.
        if (!(foot < std::min(below, there - wall)))
            return;
        sum.walled += 1;
        sum.feet += foot;
    }
    /// False for cells on the border of the raster, because a frame of wrong values resembles a wall.
    [[nodiscard]] bool is_inside(std::int32_t r, std::int32_t c) const {
        return r > 0 && c > 0 && r + 1 < pieces_.rows && c + 1 < pieces_.cols;
    }
    [[nodiscard]] bool is_in(std::int32_t r, std::int32_t c, Label label) const {
        const RegionRun* const run = run_at(pieces_.row(r), c);
        return run != nullptr && run->label == label;
    }

    const Scene& scene_;
    const Regions& pieces_;
    const std::vector<Plane>& planes_;
};

/// Drops the pieces that are not above the feet of walls around them.
/// @param min_height smallest height above these feet, in m
void keep_walled(const Scene& scene, double min_height, Regions& pieces, Executor& threads) {
    // Planes above everything first, because most pieces have too few walls for any plane.
    std::vector<Plane> planes(pieces.count(), Plane{.z = std::numeric_limits<double>::infinity()});
    std::vector<BorderSides> sides = Border(scene, pieces, planes).sides(threads);
    keep_regions(pieces, [&](Label label) { return sides[label - 1].are_walled(); });
    const std::vector<PieceSums> sums = piece_sums(scene, pieces, threads);
    planes.clear();
    for (const PieceSums& sum : sums)
        planes.push_back(sum.plane.plane(scene.cell));
    sides = Border(scene, pieces, planes).sides(threads);
    keep_regions(pieces, [&](Label label) {
        const BorderSides& border = sides[label - 1];
        return border.are_walled() && sums[label - 1].is_above(border, min_height);
    });
}

/// Classifies pieces as if they were objects, and keeps those that look like a roof.
/// @param cells cells of the pieces
Candidates classify_pieces(const Scene& scene, Mask cells, const Grid<std::uint8_t>& flags,
                           const SurfaceQuality& quality, Executor& threads) {
    const SmoothSegments segments = smooth_segments(scene, cells, flags, threads);
    ObjectRegions pieces{std::move(cells), {}};
    pieces.regions = connected_regions(pieces.cells, 1, 0, threads);
    Candidates result;
    std::vector<std::uint8_t> is_roof(1, 0);
    for (const ObjectFeatures& features : compute_features(scene, pieces, segments, flags, threads)) {
        DetectedObject object = classify(features, quality.uninformative_share());
        is_roof.push_back(object.confidence >= least_confidence ? 1 : 0);
        if (is_roof.back() == 0)
            continue;
        object.confidence *= confidence_share;
        object.doubt = CounterEvidence::ground;
        object.cells = pieces.regions.cells[is_roof.size() - 1];
        result.objects.push_back(object);
        result.features.push_back(features);
    }
    result.regions = std::move(pieces.regions);
    keep_regions(result.regions, [&](Label label) { return is_roof[label] != 0; });
    return result;
}

}  // namespace

Candidates add_swallowed_roofs(const Scene& scene, SceneCells& cells, double min_height, double min_area_m2,
                               const SurfaceQuality& quality, Candidates found, Executor& threads) {
    if (!(scene.longest_swallowed > 0))
        return found;
    Regions pieces = level_pieces(scene, free_cells(scene, found.regions, threads),
                                  cells_covering(min_area_m2, scene.cell), threads);
    keep_walled(scene, min_height, pieces, threads);
    if (pieces.count() == 0)
        return found;
    Mask walled = mask_of(pieces, threads);
    fill_small_holes(walled, cells_covering(smallest_hole_m2, scene.cell), threads);
    clear_with_border(found.regions, walled, threads);
    flag_cells(scene, quality, cells, threads);
    const std::array both{std::move(found),
                          classify_pieces(scene, std::move(walled), cells.flags, quality, threads)};
    return merge_candidates(both, threads);
}

}  // namespace d2b::detect
