#include "detect/parcel_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "core/grid.hpp"
#include "core/statistics.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {
namespace {

constexpr double step_m = 0.5;
constexpr double reach_m = 6;
constexpr std::int32_t least_reach = 3;  // minimum number of steps if cells are large

/// Step of a move along an axis.
struct ShiftSteps {
    std::int32_t cells = 1;  ///< cells per step
    std::int32_t reach = 0;  ///< steps to both sides, at most ShiftCounts::most
};
/// Returns steps of half a metre (or of a cell, if larger) up to some six metres on both sides.
ShiftSteps shift_steps(double cell_m) {
    const auto cells = std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(step_m / cell_m)));
    const auto reach = static_cast<std::int32_t>(reach_m / (cells * cell_m));
    return {cells, std::clamp(reach, least_reach, ShiftCounts::most)};
}

/// Wall score of edges between cells and their right or lower neighbours: 2 on a wall, 1 at most a step (half
/// steps included) next to one, else 0.
class WallGrid {
  public:
    WallGrid(const Scene& scene, const Detection& detection, bool below, std::int32_t step, Executor& threads)
        : scene_(scene),
          detection_(detection),
          least_step_(walls_to_steps * roof_step(scene)),
          down_(below ? 1 : 0),
          right_(below ? 0 : 1),
          weights_(scene.surface.rows, scene.surface.cols) {
        for_rows(threads, weights_.rows, weights_.cols, [&](std::int32_t r) {
            for (std::int32_t c = 0; c < weights_.cols; ++c)
                weigh(r, c, step);
        });
    }
    /// @pre the cell is in the grid
    [[nodiscard]] std::int64_t at(std::int32_t r, std::int32_t c) const { return weights_.at(r, c); }

  private:
    [[nodiscard]] bool is_building(std::int32_t r, std::int32_t c) const {
        return detection_.is_building(detection_.labels.at(r, c));
    }
    [[nodiscard]] bool is_wall(std::int32_t r, std::int32_t c) const {
        const std::int32_t to_r = r + down_;
        const std::int32_t to_c = c + right_;
        if (!weights_.holds(r, c) || !weights_.holds(to_r, to_c))
            return false;
        if (is_building(r, c) != is_building(to_r, to_c))
            return true;
        return is_building(r, c) &&
               std::abs(scene_.surface.at(r, c) - scene_.surface.at(to_r, to_c)) > least_step_;
    }
    void weigh(std::int32_t r, std::int32_t c, std::int32_t step) {
        for (std::int32_t beside = 0; beside <= step; ++beside)
            for (const std::int32_t away : {-beside, beside})
                if (is_wall(r + away * down_, c + away * right_)) {
                    weights_.at(r, c) = 2 * beside <= step ? 2 : 1;
                    return;
                }
    }

    const Scene& scene_;
    const Detection& detection_;
    float least_step_;
    std::int32_t down_;
    std::int32_t right_;
    Mask weights_;
};

/// Edges between cells and their right, or lower, neighbours.
class EdgeCounter {
  public:
    EdgeCounter(const Scene& scene, const Detection& detection, bool below, Executor& threads)
        : parcels_(*scene.parcels),
          below_(below),
          down_(shift_steps(scene.cell.down)),
          right_(shift_steps(scene.cell.across)),
          walls_(scene, detection, below, below ? down_.cells : right_.cells, threads) {}

    /// Adds the scores after each move if parcels separate the cell from its neighbour.
    void count(std::int32_t r, std::int32_t c, ShiftCounts& sum) const {
        const std::int32_t to_r = r + (below_ ? 1 : 0);
        const std::int32_t to_c = c + (below_ ? 0 : 1);
        if (!parcels_.holds(to_r, to_c) ||
            !separated_by_parcel(parcels_.at(r, c), parcels_.at(to_r, to_c), below_))
            return;
        for (std::int32_t d = -down_.reach; d <= down_.reach; ++d)
            if (const std::int32_t row = r + d * down_.cells; row >= 0 && row < parcels_.rows)
                count_row(row, c, &sum.on_walls[ShiftCounts::index(d, -right_.reach)]);
    }

  private:
    void count_row(std::int32_t row, std::int32_t c, std::int64_t* to) const {
        for (std::int32_t i = -right_.reach; i <= right_.reach; ++i, ++to)
            if (const std::int32_t col = c + i * right_.cells; col >= 0 && col < parcels_.cols)
                *to += walls_.at(row, col);
    }

    const ParcelGrid& parcels_;
    bool below_;
    ShiftSteps down_;
    ShiftSteps right_;
    WallGrid walls_;
};

// A move stands out if this many times more borders lie on walls than after an ordinary move, and no other
// move comes close. Cadastres of the right place have a ratio of 2.5 and more, and other moves are half as
// good; plots of another place have 1.3, and 0.8.
constexpr double least_ratio = 1.5;
constexpr double least_on_walls_m = 200;
constexpr double summit = 0.5;  // share of the best score: moves around it that belong to it
constexpr double rival = 0.75;
constexpr double as_good = 0.95;

/// Scores of moves in excess of that of an ordinary one.
class Moves {
  public:
    Moves(const ShiftCounts& counts, const CellSize& cell)
        : down_(shift_steps(cell.down)), right_(shift_steps(cell.across)), counts_(counts) {
        std::vector<std::int64_t> all;
        for_all([&](std::int32_t d, std::int32_t r) { all.push_back(on_walls(d, r)); });
        ordinary_ = upper_median(all);
    }

    [[nodiscard]] std::int64_t on_walls(std::int32_t down, std::int32_t right) const {
        return counts_.on_walls[ShiftCounts::index(down, right)];
    }
    [[nodiscard]] std::int64_t ordinary() const { return ordinary_; }
    [[nodiscard]] double more(std::pair<std::int32_t, std::int32_t> move) const {
        return static_cast<double>(on_walls(move.first, move.second) - ordinary_);
    }
    [[nodiscard]] const ShiftSteps& down() const { return down_; }
    [[nodiscard]] const ShiftSteps& right() const { return right_; }
    [[nodiscard]] bool reaches(std::int32_t down, std::int32_t right) const {
        return std::abs(down) <= down_.reach && std::abs(right) <= right_.reach;
    }
    template <typename Use>
    void for_all(const Use& use) const {
        for (std::int32_t d = -down_.reach; d <= down_.reach; ++d)
            for (std::int32_t r = -right_.reach; r <= right_.reach; ++r)
                use(d, r);
    }

  private:
    ShiftSteps down_;
    ShiftSteps right_;
    const ShiftCounts& counts_;
    std::int64_t ordinary_ = 0;
};

using Move = std::pair<std::int32_t, std::int32_t>;  // steps down and right

Move best_of(const Moves& moves) {
    Move best{0, 0};
    moves.for_all([&](std::int32_t d, std::int32_t r) {
        if (moves.on_walls(d, r) > moves.on_walls(best.first, best.second))
            best = {d, r};
    });
    return best;
}

/// Returns the connected moves around the best one with at least half of its score.
std::vector<Move> belonging_to(const Moves& moves, Move best) {
    std::vector<Move> found{best};
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::int32_t d = found[i].first - 1; d <= found[i].first + 1; ++d)
            for (std::int32_t r = found[i].second - 1; r <= found[i].second + 1; ++r)
                if (moves.reaches(d, r) && moves.more({d, r}) >= summit * moves.more(best) &&
                    std::ranges::find(found, Move{d, r}) == found.end())
                    found.emplace_back(d, r);
    return found;
}

constexpr double bin_m = ParcelFit::reach_m / ParcelFit::bins;
/// Half side, in cells, of the neighbourhood that determines the direction of a cut.
constexpr std::int32_t cut_radius = 3;
/// Ratio of the length of a line to the number of cell edges it separates, averaged over all angles (Cauchy,
/// Crofton).
constexpr double straight_share = std::numbers::pi / 4;

/// Point or vector in cells.
struct CellVector {
    double row = 0;
    double col = 0;
};

class FitOfRows {
  public:
    FitOfRows(const Scene& scene, const Detection& detection, ParcelFit& fit)
        : scene_(scene),
          parcels_(*scene.parcels),
          detection_(detection),
          fit_(fit),
          step_(walls_to_steps * roof_step(scene)) {}

    void add_cell(std::int32_t r, std::int32_t c) {
        if (!is_building(r, c))
            return;
        const ParcelCell& cell = parcels_.at(r, c);
        ++fit_.cells;
        if (cell.parcel != ParcelCell::no_parcel) {
            ++fit_.inside;
            fit_.several += cell.several ? 1 : 0;
            fit_.invalid += cell.invalid ? 1 : 0;
        }
        for (const bool below : {false, true}) {
            const std::int32_t to_r = r + (below ? 1 : 0);
            const std::int32_t to_c = c + (below ? 0 : 1);
            if (is_building(to_r, to_c) && separated_by_parcel(cell, parcels_.at(to_r, to_c), below))
                add_pair(r, c, below);
        }
    }

  private:
    [[nodiscard]] bool is_building(std::int32_t r, std::int32_t c) const {
        return detection_.labels.holds(r, c) && detection_.is_building(detection_.labels.at(r, c));
    }
    [[nodiscard]] bool is_step(std::int32_t r, std::int32_t c, std::int32_t to_r, std::int32_t to_c) const {
        return std::abs(scene_.surface.at(r, c) - scene_.surface.at(to_r, to_c)) > step_;
    }
    void add_pair(std::int32_t r, std::int32_t c, bool below) {
        ++fit_.cuts;
        const CellVector way = across(r, c, below);
        const CellVector edge{r + (below ? 1.0 : 0.5), c + (below ? 0.5 : 1.0)};
        std::optional<double> nearest;
        if (is_step(r, c, r + (below ? 1 : 0), c + (below ? 0 : 1)))
            nearest = 0;
        for (const double sign : {-1.0, 1.0})
            if (const auto wall = wall_from(edge, {sign * way.row, sign * way.col});
                wall && (!nearest || *wall < *nearest))
                nearest = wall;
        if (nearest)
            ++fit_.distances[std::min(static_cast<std::size_t>(*nearest / bin_m), ParcelFit::bins - 1)];
    }
    /// Returns the vector of one metre from one side to the other, between the centroids of their
    /// surroundings.
    [[nodiscard]] CellVector across(std::int32_t r, std::int32_t c, bool below) const {
        const std::int64_t from = parcels_.at(r, c).parcel;
        const std::int64_t to = parcels_.at(r + (below ? 1 : 0), c + (below ? 0 : 1)).parcel;
        std::array<CellVector, 2> sums{};
        std::array<std::int64_t, 2> counts{};
        for (std::int32_t y = std::max(r - cut_radius, 0); y <= std::min(r + cut_radius, parcels_.rows - 1);
             ++y)
            for (std::int32_t x = std::max(c - cut_radius, 0);
                 x <= std::min(c + cut_radius, parcels_.cols - 1); ++x)
                for (const std::size_t side : {0U, 1U})
                    if (from != to && parcels_.at(y, x).parcel == (side == 0 ? from : to)) {
                        sums[side].row += (y - r) * scene_.cell.down;
                        sums[side].col += (x - c) * scene_.cell.across;
                        ++counts[side];
                    }
        CellVector way{below ? 1.0 : 0.0, below ? 0.0 : 1.0};
        if (from != to) {
            const auto middle = [&](std::size_t side, double CellVector::*axis) {
                return sums[side].*axis / static_cast<double>(counts[side]);
            };
            way = {middle(1, &CellVector::row) - middle(0, &CellVector::row),
                   middle(1, &CellVector::col) - middle(0, &CellVector::col)};
        }
        const double length = std::hypot(way.row, way.col);
        return {way.row / length / scene_.cell.down, way.col / length / scene_.cell.across};
    }
    /// @param way direction in cells per metre
    /// @return distance in m
    [[nodiscard]] std::optional<double> wall_from(CellVector edge, CellVector way) const {
        const double stride = scene_.side();
        const auto cell_at = [&](double metres) {
            return std::pair(static_cast<std::int32_t>(std::floor(edge.row + metres * way.row)),
                             static_cast<std::int32_t>(std::floor(edge.col + metres * way.col)));
        };
        std::pair<std::int32_t, std::int32_t> before = cell_at(stride / 2);
        for (int step = 0; step * stride < ParcelFit::reach_m; ++step) {
            const auto [r, c] = cell_at((step + 0.5) * stride);
            if (!scene_.surface.holds(r, c))
                return std::nullopt;
            if (!is_building(r, c) || is_step(before.first, before.second, r, c))
                return step * stride;
            before = {r, c};
        }
        return std::nullopt;
    }

    const Scene& scene_;
    const ParcelGrid& parcels_;
    const Detection& detection_;
    ParcelFit& fit_;
    float step_;
};
}  // namespace

void ShiftCounts::merge(const ShiftCounts& other) {
    for (std::size_t i = 0; i < on_walls.size(); ++i)
        on_walls[i] += other.on_walls[i];
}

void count_shifts(const Scene& scene, const Detection& detection, const Window& own, ShiftCounts& counts,
                  Executor& threads) {
    for (const bool below : {false, true}) {
        const EdgeCounter counter(scene, detection, below, threads);
        counts.merge(
            reduce_rows(threads, own.rows, own.cols, ShiftCounts(), [&](std::int32_t r, ShiftCounts& sum) {
                for (std::int32_t c = own.col; c < own.end_col(); ++c)
                    counter.count(own.row + r, c, sum);
            }));
    }
}

std::optional<ParcelMove> best_offset(const ShiftCounts& counts, const CellSize& cell) {
    const Moves moves(counts, cell);
    const Move best = best_of(moves);
    const auto on_walls = static_cast<double>(moves.on_walls(best.first, best.second));
    if (on_walls / 2 * std::sqrt(cell.area()) < least_on_walls_m ||
        on_walls < least_ratio * static_cast<double>(moves.ordinary()))
        return std::nullopt;
    const std::vector<Move> belonging = belonging_to(moves, best);
    bool stands_out = true;
    moves.for_all([&](std::int32_t d, std::int32_t r) {
        if (moves.more({d, r}) > rival * moves.more(best) &&
            std::ranges::find(belonging, Move{d, r}) == belonging.end())
            stands_out = false;
    });
    if (!stands_out)
        return std::nullopt;
    const auto in_metres = [&](Move move) {
        return ParcelMove{move.second * moves.right().cells * cell.across,
                          move.first * moves.down().cells * cell.down};
    };
    ParcelMove least = in_metres(best);
    for (const Move& move : belonging)
        if (const ParcelMove other = in_metres(move);
            moves.more(move) >= as_good * moves.more(best) &&
            std::hypot(other.right_m, other.down_m) < std::hypot(least.right_m, least.down_m))
            least = other;
    return least;
}

void ParcelFit::merge(const ParcelFit& other) {
    cells += other.cells;
    inside += other.inside;
    several += other.several;
    invalid += other.invalid;
    cuts += other.cuts;
    for (std::size_t i = 0; i < bins; ++i)
        distances[i] += other.distances[i];
    shifts.merge(other.shifts);
}

void add_fit(const Scene& scene, const Detection& detection, const Window& own, ParcelFit& fit,
             Executor& threads) {
    fit.merge(reduce_rows(threads, own.rows, own.cols, ParcelFit(), [&](std::int32_t r, ParcelFit& sum) {
        FitOfRows rows(scene, detection, sum);
        for (std::int32_t c = own.col; c < own.end_col(); ++c)
            rows.add_cell(own.row + r, c);
    }));
    count_shifts(scene, detection, own, fit.shifts, threads);
}

ParcelReport parcel_report(const ParcelFit& fit, const CellSize& cell) {
    const double area = cell.area();
    const double length = straight_share * std::sqrt(area);
    const std::int64_t beside = std::accumulate(fit.distances.begin(), fit.distances.end(), std::int64_t{0});
    ParcelReport report;
    report.cut_length_m = length * static_cast<double>(fit.cuts);
    report.near_wall_length_m = length * static_cast<double>(beside);
    report.median_distance_m = std::numeric_limits<double>::quiet_NaN();
    std::int64_t nearer = 0;
    for (std::size_t i = 0; i < ParcelFit::bins && 2 * nearer < beside; ++i) {
        nearer += fit.distances[i];
        report.median_distance_m = static_cast<double>(i) * bin_m;
    }
    report.best_offset = best_offset(fit.shifts, cell);
    report.building_m2 = area * static_cast<double>(fit.cells);
    report.inside_m2 = area * static_cast<double>(fit.inside);
    report.overlap_m2 = area * static_cast<double>(fit.several);
    report.invalid_m2 = area * static_cast<double>(fit.invalid);
    return report;
}

}  // namespace d2b::detect
