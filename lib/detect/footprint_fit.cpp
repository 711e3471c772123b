#include "detect/footprint_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <set>

#include "detect/ground_level.hpp"
#include "detect/smoothness.hpp"

namespace d2b::detect {
namespace {

/// Renumbers the labels of a grid from 1, in ascending order, so that tables by label are short.
/// @return the labels, in ascending order
std::vector<Label> renumber_present(Grid<Label>& labels, Executor& threads) {
    std::set<Label> found;
    std::mutex mutex;
    for_rows(threads, labels.rows, labels.cols, [&](std::int32_t r) {
        std::vector<Label> here;
        for_equal_runs(labels.row(r),
                       [&](std::int32_t, std::int32_t, Label label) { here.push_back(label); });
        const std::lock_guard lock(mutex);
        found.insert(here.begin(), here.end());
    });
    std::vector<Label> present(found.begin(), found.end());
    for_rows(threads, labels.rows, labels.cols, [&](std::int32_t r) {
        const std::span<Label> row = labels.row(r);
        for_equal_runs(row, [&](std::int32_t begin, std::int32_t end, Label label) {
            const auto number = std::ranges::lower_bound(present, label) - present.begin() + 1;
            std::fill(row.begin() + begin, row.begin() + end, static_cast<Label>(number));
        });
    });
    return present;
}

/// Returns the runs of each label, in scan order.
std::vector<std::vector<RowSpan>> runs_by_label(const Grid<Label>& labels, std::size_t count) {
    std::vector<std::vector<RowSpan>> runs(count + 1);
    for (std::int32_t r = 0; r < labels.rows; ++r)
        for_equal_runs(labels.row(r), [&](std::int32_t begin, std::int32_t end, Label label) {
            runs[label].push_back({r, begin, end});
        });
    return runs;
}

/// Tells which cells rise, and which of these look like trees.
class CellKinds {
  public:
    CellKinds(const Scene& scene, const Detection& detection, double min_height, Executor& threads)
        : scene_(scene),
          detection_(detection),
          min_height_(static_cast<float>(min_height)),
          flags_(smoothness(scene.surface, detection.smooth, threads)) {}

    [[nodiscard]] bool is_elevated(std::size_t i) const { return scene_.height(i) > min_height_; }
    /// @pre is_elevated(i)
    [[nodiscard]] bool is_tree(std::int32_t r, std::int32_t c) const {
        const std::size_t i = flags_.index(r, c);
        const bool green = scene_.greenness != nullptr && scene_.greenness->values[i] > vegetation_ndvi;
        return (green || (flags_.values[i] & smooth_enough) == 0) && !is_at_building(r, c);
    }

  private:
    /// True also for the cells along a found building, because corners are cut off from it.
    [[nodiscard]] bool is_at_building(std::int32_t r, std::int32_t c) const {
        const Grid<Label>& labels = detection_.labels;
        for (std::int32_t row = std::max(r - 1, 0); row <= std::min(r + 1, labels.rows - 1); ++row)
            for (std::int32_t col = std::max(c - 1, 0); col <= std::min(c + 1, labels.cols - 1); ++col)
                if (detection_.is_building(labels.at(row, col)))
                    return true;
        return false;
    }

    const Scene& scene_;
    const Detection& detection_;
    float min_height_;
    Grid<std::uint8_t> flags_;
};

void count_own(const Scene& scene, const CellKinds& kinds, std::span<const RowSpan> runs, const Window& own,
               SeenFootprint& seen) {
    for (const RowSpan& run : runs) {
        if (run.row < own.row || run.row >= own.end_row())
            continue;
        const std::int32_t end = std::min(run.end, own.end_col());
        for (std::int32_t c = std::max(run.begin, own.col); c < end; ++c) {
            const std::size_t i = scene.surface.index(run.row, c);
            ++seen.own_cells;
            if (!kinds.is_elevated(i))
                continue;
            ++seen.elevated;
            seen.trees += kinds.is_tree(run.row, c) ? 1 : 0;
        }
    }
}

constexpr double farthest_m = 5;
constexpr int most_moves = 12;
constexpr float full_fall_m = 3;
constexpr std::size_t most_edges = 96;

/// Edge between a cell of a footprint and one outside.
struct FootprintEdge {
    std::int32_t row = 0;  ///< of the cell inside
    std::int32_t col = 0;
    std::int32_t down = 0;  ///< from there to the cell outside
    std::int32_t right = 0;
};

std::vector<FootprintEdge> outer_edges(const Grid<Label>& labels, Label label,
                                       std::span<const RowSpan> cells) {
    std::vector<FootprintEdge> edges;
    const auto add = [&](std::int32_t r, std::int32_t c, std::int32_t down, std::int32_t right) {
        if (labels.holds(r + down, c + right) && labels.at(r + down, c + right) != label)
            edges.push_back({r, c, down, right});
    };
    for (const RowSpan& run : cells) {
        add(run.row, run.begin, 0, -1);
        add(run.row, run.end - 1, 0, 1);
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            add(run.row, c, -1, 0);
            add(run.row, c, 1, 0);
        }
    }
    if (edges.size() <= most_edges)
        return edges;
    std::vector<FootprintEdge> some;  // evenly spread, because all walls must count
    for (std::size_t i = 0; i < most_edges; ++i)
        some.push_back(edges[i * edges.size() / most_edges]);
    return some;
}

/// Walls of the surface: falls between neighbours, of which the lower one is open ground. Steps between roofs
/// do not count, because a house in a row would slide along it to the next step.
class OuterWalls {
  public:
    OuterWalls(const Scene& scene, double min_height)
        : scene_(scene), open_ground_(static_cast<float>(min_height)) {}

    /// Computes the scores of all places that moves will ask for, unless these ask for fewer.
    /// @param edges of all calls of fall() @param moves number of them
    void prepare(std::span<const FootprintEdge> edges, std::int32_t most_down, std::int32_t most_right,
                 std::size_t moves) {
        const auto [low_row, high_row] = std::ranges::minmax(edges, {}, &FootprintEdge::row);
        const auto [low_col, high_col] = std::ranges::minmax(edges, {}, &FootprintEdge::col);
        first_ = {low_row.row - most_down - 1, low_col.col - most_right - 1};
        const std::int32_t rows = high_row.row + most_down + 2 - first_.row;
        const std::int32_t cols = high_col.col + most_right + 2 - first_.col;
        const auto cells = static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols);
        constexpr std::size_t falls_per_edge = 3;
        if (cells * directions.size() > edges.size() * moves * falls_per_edge)
            return;
        for (std::size_t side = 0; side < directions.size(); ++side)
            scores_[side] = scores(rows, cols, directions[side]);
        for (const FootprintEdge& edge : edges)
            at_edges_.push_back(&scores_[side_of(edge)].at(edge.row - first_.row, edge.col - first_.col));
    }

    /// Sum over the edges of a footprint that is moved; a part of it if the rest cannot raise it to `least`.
    [[nodiscard]] double fall(std::span<const FootprintEdge> edges, std::int32_t down, std::int32_t right,
                              double least) const {
        constexpr double most_per_edge = 4 * static_cast<double>(full_fall_m);
        double sum = 0;
        double rest = most_per_edge * static_cast<double>(edges.size());
        const std::ptrdiff_t move = std::ptrdiff_t{down} * scores_[0].cols + right;
        for (std::size_t i = 0; i < edges.size() && sum + rest >= least; ++i) {
            rest -= most_per_edge;
            sum += static_cast<double>(at_edges_.empty() ? score(edges[i], down, right) : at_edges_[i][move]);
        }
        return sum;
    }

    /// True if nearly all edges are walls where they are.
    [[nodiscard]] bool fit(std::span<const FootprintEdge> edges) const {
        constexpr double nearly_all = 0.95;
        const auto count = std::ranges::count_if(edges, [&](const FootprintEdge& edge) {
            return fall(edge.row, edge.col, edge) >= full_fall_m / 2;
        });
        return static_cast<double>(count) >= nearly_all * static_cast<double>(edges.size());
    }

  private:
    static constexpr std::array<FootprintEdge, 4> directions{
        {{0, 0, -1, 0}, {0, 0, 0, -1}, {0, 0, 0, 1}, {0, 0, 1, 0}}};

    /// Returns the index of an edge's direction.
    static std::size_t side_of(const FootprintEdge& edge) {
        return static_cast<std::size_t>((2 * edge.down + edge.right + 3) * 2 / 3);
    }

    /// A wall at the edge counts in full, one a cell away by half.
    static float score(float here, float inside, float outside) { return 2 * here + inside + outside; }

    [[nodiscard]] float score(const FootprintEdge& edge, std::int32_t down, std::int32_t right) const {
        const std::int32_t r = edge.row + down;
        const std::int32_t c = edge.col + right;
        return score(fall(r, c, edge), fall(r - edge.down, c - edge.right, edge),
                     fall(r + edge.down, c + edge.right, edge));
    }

    /// Returns the scores of edges in a direction at all cells from the first one on, without those at the
    /// border of the grid.
    [[nodiscard]] Grid<float> scores(std::int32_t rows, std::int32_t cols,
                                     const FootprintEdge& direction) const {
        Grid<float> falls(rows, cols);
        for (std::int32_t r = 0; r < rows; ++r)
            for (std::int32_t c = 0; c < cols; ++c)
                falls.at(r, c) = fall(first_.row + r, first_.col + c, direction);
        Grid<float> scores(rows, cols);
        const std::ptrdiff_t across = std::ptrdiff_t{direction.down} * cols + direction.right;
        for (std::int32_t r = 1; r + 1 < rows; ++r) {
            const float* const here = &falls.at(r, 0);
            float* const found = &scores.at(r, 0);
            for (std::int32_t c = 1; c + 1 < cols; ++c)
                found[c] = score(here[c], here[c - across], here[c + across]);
        }
        return scores;
    }

    /// Fall from a cell across an edge, limited; 0 if it is no wall.
    [[nodiscard]] float fall(std::int32_t r, std::int32_t c, const FootprintEdge& edge) const {
        const MetreGrid& surface = scene_.surface;
        if (!surface.holds(r, c) || !surface.holds(r + edge.down, c + edge.right))
            return 0;
        const float low = scene_.height(surface.index(r + edge.down, c + edge.right));
        const float drop = scene_.height(surface.index(r, c)) - low;
        return drop > 0 && low <= open_ground_ ? std::min(drop, full_fall_m) : 0;  // 0 also if it is NaN
    }

    const Scene& scene_;
    float open_ground_;
    LatticePoint first_;
    std::array<Grid<float>, 4> scores_;     ///< by direction; empty if they are computed when asked for
    std::vector<const float*> at_edges_{};  ///< scores at the cells of the edges, likewise
};

/// Move of a footprint by whole cells.
struct FootprintMove {
    double distance = 0;  ///< m
    std::int32_t down = 0;
    std::int32_t right = 0;
};

/// Returns moves by ascending distance.
std::vector<FootprintMove> moves_within(double farthest, std::int32_t most_down, std::int32_t most_right,
                                        const CellSize& cell) {
    std::vector<FootprintMove> moves;
    for (std::int32_t down = -most_down; down <= most_down; ++down)
        for (std::int32_t right = -most_right; right <= most_right; ++right)
            if (const double distance = std::hypot(down * cell.down, right * cell.across);
                distance <= farthest && (down != 0 || right != 0))
                moves.push_back({distance, down, right});
    std::ranges::stable_sort(moves, {}, &FootprintMove::distance);
    return moves;
}

std::int32_t steps_within(double distance_m, double step_m) {
    return static_cast<std::int32_t>(std::clamp(distance_m / step_m, 0.0, static_cast<double>(most_moves)));
}

}  // namespace

double wall_shift(const Scene& scene, const Grid<Label>& labels, Label label, std::span<const RowSpan> cells,
                  double min_height) {
    constexpr double worth_a_move = 1.02;
    const std::vector<FootprintEdge> edges = outer_edges(labels, label, cells);
    OuterWalls walls(scene, min_height);
    if (walls.fit(edges))
        return 0;
    std::int64_t size = 0;
    for (const RowSpan& run : cells)
        size += run.end - run.begin;
    // A move by more than half the footprint may bring it onto the next building.
    const double farthest =
        std::min(farthest_m, std::sqrt(static_cast<double>(size) * scene.cell_area()) / 2);
    const std::int32_t most_down = steps_within(farthest, scene.cell.down);
    const std::int32_t most_right = steps_within(farthest, scene.cell.across);
    const std::vector<FootprintMove> moves = moves_within(farthest, most_down, most_right, scene.cell);
    walls.prepare(edges, most_down, most_right, moves.size());
    double most = walls.fall(edges, 0, 0, 0) * worth_a_move;
    double nearest = 0;
    // Near moves first, because one of them is usually the best, and others are given up early.
    for (const FootprintMove& move : moves) {
        const double sum = walls.fall(edges, move.down, move.right, most);
        if (sum > most) {
            most = sum;
            nearest = move.distance;
        }
    }
    return nearest;
}

std::vector<SeenFootprint> see_footprints(const Scene& scene, const Detection& detection, Grid<Label>& labels,
                                          const Window& own, double min_height, Executor& threads) {
    const std::vector<Label> present = renumber_present(labels, threads);
    if (present.empty())
        return {};
    const std::vector<double> ground =
        ground_levels(scene.terrain, labels, static_cast<Label>(present.size()), threads);
    const std::vector<std::vector<RowSpan>> runs = runs_by_label(labels, present.size());
    const CellKinds kinds(scene, detection, min_height, threads);
    std::vector<SeenFootprint> seen(present.size());
    threads.for_each(present.size(), [&](std::size_t i) {
        const auto number = static_cast<Label>(i + 1);
        seen[i].label = present[i];
        seen[i].ground = ground[number];
        count_own(scene, kinds, runs[number], own, seen[i]);
        if (static_cast<double>(seen[i].elevated) >=
            least_seen_share * static_cast<double>(seen[i].own_cells))
            seen[i].shift_m = wall_shift(scene, labels, number, runs[number], min_height);
    });
    std::erase_if(seen, [](const SeenFootprint& one) { return one.own_cells == 0; });
    return seen;
}

}  // namespace d2b::detect
