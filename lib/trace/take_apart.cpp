#include "trace/take_apart.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "trace/squares.hpp"

namespace d2b {
namespace {

constexpr double nothing_outside = std::numeric_limits<double>::infinity();

/// The top run of a row of squares that holds a square; level -1 where none does.
struct Holder {
    std::int32_t level = -1;
    std::uint32_t top_run = 0;
};
using Holders = std::vector<Holder>;

Holders holders_of(const RunRow& row, std::size_t squares) {
    Holders holders(squares);
    for (std::uint32_t s = 0; s < row.top_runs.size(); ++s) {
        const TopRun& top_run = row.top_runs[s];
        std::fill(holders.begin() + top_run.begin, holders.begin() + top_run.end, Holder{top_run.level, s});
    }
    return holders;
}

template <typename Count>
struct Row {
    std::span<const double> elevations;
    std::span<const Label> labels;
    std::span<const Count> counts;
    std::vector<std::int32_t> spires;
};

template <typename Count>
class Cutter {
  public:
    Cutter(const TraceFrame& frame, const PointRows<Count>& before, const PointRows<Count>& band,
           const ColSpan& summed)
        : frame_(frame),
          before_(before),
          band_(band),
          summed_{summed.begin, std::min(summed.end, band.shape().cols)} {}

    [[nodiscard]] std::vector<TraceLine> lines_of_cells() const;
    [[nodiscard]] std::vector<TraceLine> lines_of_points() const;

  private:
    [[nodiscard]] bool has(std::int32_t row) const {
        return row >= band_.shape().first_row - before_.shape().rows;
    }
    [[nodiscard]] Row<Count> row(std::int32_t row) const {
        const std::int32_t in_band = row - band_.shape().first_row;
        const PointRows<Count>& rows = in_band < 0 ? before_ : band_;
        const std::int32_t i = in_band < 0 ? row - before_.shape().first_row : in_band;
        return {rows.elevations->row(i), rows.labels.row(i), rows.levels.row(i),
                rows.elevations->spires_in_row(i)};
    }
    [[nodiscard]] bool is_last() const { return band_.end_row() == frame_.window.row + frame_.window.rows; }
    [[nodiscard]] RunRow cut(std::span<const Count> counts, std::span<const Label> labels) const;
    [[nodiscard]] RunRow squares_above(std::int32_t row) const;
    [[nodiscard]] TraceLine line_of_points(std::int32_t number, const Holders& above, RunRow squares,
                                           std::size_t shares) const;
    void add_share(TraceLine& line, const PointShare& share) const;
    [[nodiscard]] static std::vector<double> outside_of(const Row<Count>& row);

    const TraceFrame& frame_;
    const PointRows<Count>& before_;
    const PointRows<Count>& band_;
    ColSpan summed_;
};

template <typename Count>
std::vector<double> Cutter<Count>::outside_of(const Row<Count>& row) {
    std::vector<double> outside(row.elevations.size());
    for (std::size_t c = 0; c < outside.size(); ++c) {
        const double z = row.elevations[c];  // read in any case, so that nothing branches
        outside[c] = row.counts[c] == 1 ? z : nothing_outside;
    }
    return outside;
}

template <typename Count>
RunRow Cutter<Count>::cut(std::span<const Count> counts, std::span<const Label> labels) const {
    RunRow row;
    row.levels.resize(static_cast<std::size_t>(frame_.levels));
    cut_into_runs<Count>(counts, labels, row);
    return row;
}

/// With statistics of the points, which the line holds.
template <typename Count>
void Cutter<Count>::add_share(TraceLine& line, const PointShare& share) const {
    PointShare& added = line.shares.emplace_back(share);
    for (std::int32_t c = share.begin; c < share.end; ++c)
        if (const double z = line.elevations[static_cast<std::size_t>(c)]; !std::isnan(z))
            added.stats.add(z, frame_.fixed);
    if (added.stats.n == 0)
        line.shares.pop_back();
}

/// Every cell is a point of the contour that it lies in, and no cell is known for the sake of others.
template <typename Count>
std::vector<TraceLine> Cutter<Count>::lines_of_cells() const {
    std::vector<TraceLine> lines;
    for (std::int32_t r = band_.shape().first_row; r < band_.end_row(); ++r) {
        const Row<Count> cells = row(r);
        TraceLine& line = lines.emplace_back();
        line.line = r;
        line.squares = cut(cells.counts, cells.labels);
        line.elevations = cells.elevations;
        line.spires = cells.spires;
        line.outside = outside_of(cells);
        for (std::uint32_t s = 0; s < line.squares.top_runs.size(); ++s)
            add_share(line, {false, s, line.squares.top_runs[s].begin, line.squares.top_runs[s].end, {}});
    }
    if (is_last()) {
        lines.emplace_back().line = band_.end_row();
        lines.back().squares = cut({}, {});
    }
    return lines;
}

/// Between a row of points and the one before it.
template <typename Count>
RunRow Cutter<Count>::squares_above(std::int32_t r) const {
    const Row<Count> upper = row(r - 1);
    const Row<Count> lower = row(r);
    std::vector<Count> squares;
    squares_between<Count>(upper.counts, lower.counts, upper.labels, lower.labels, squares);
    return cut(squares, upper.labels.first(upper.labels.empty() ? 0 : squares.size()));
}

/// A point on the line is counted once, with the highest contour among the four squares around it (the first
/// in scan order where several are as high): a point where two contours touch belongs to one of them.
/// @param shares that there may be
template <typename Count>
TraceLine Cutter<Count>::line_of_points(std::int32_t number, const Holders& above, RunRow squares,
                                        std::size_t shares) const {
    TraceLine line;
    line.shares.reserve(shares);
    line.line = number;
    const Row<Count> points = row(number);
    line.elevations = points.elevations;
    line.spires = points.spires;
    if (number < band_.shape().first_row)
        line.owner = before_.elevations;
    const Holders below = holders_of(squares, points.elevations.size() - 1);
    PointShare share;
    std::int32_t level = -1;
    for (std::int32_t c = summed_.begin; c <= summed_.end; ++c) {
        Holder best;
        bool best_above = false;
        for (const bool is_above : {true, false})
            for (const std::int32_t square : {c - 1, c}) {
                const Holders& holders = is_above ? above : below;
                const auto at = static_cast<std::size_t>(square);
                if (square >= 0 && at < holders.size() && holders[at].level > best.level && c < summed_.end) {
                    best = holders[at];
                    best_above = is_above;
                }
            }
        if (level >= 0 && (best.level < 0 || best.top_run != share.top_run || best_above != share.above)) {
            share.end = c;
            add_share(line, share);
            level = -1;
        }
        if (level < 0 && best.level >= 0)
            share = {best_above, best.top_run, c, c, {}};
        level = best.level;
    }
    line.squares = std::move(squares);
    return line;
}

template <typename Count>
std::vector<TraceLine> Cutter<Count>::lines_of_points() const {
    std::vector<TraceLine> lines;
    const auto squares_a_row = static_cast<std::size_t>(band_.shape().cols - 1);
    Holders above;
    const std::int32_t first = band_.shape().first_row;
    if (has(first - 2))
        above = holders_of(squares_above(first - 1), squares_a_row);
    for (std::int32_t r = first; r < band_.end_row(); ++r) {
        if (has(r - 1)) {
            const std::size_t shares = lines.empty() ? 0 : lines.back().shares.size();
            lines.push_back(line_of_points(r - 1, above, squares_above(r), shares + shares / 8));
            above = holders_of(lines.back().squares, squares_a_row);
        } else {
            lines.emplace_back();  // the first row of points is the line above the first row of squares
        }
        lines.back().outside = outside_of(row(r));
    }
    if (is_last())
        lines.push_back(line_of_points(band_.end_row() - 1, above, cut({}, {}), 0));
    return lines;
}

}  // namespace

template <typename Count>
std::vector<TraceLine> take_apart(const TraceFrame& frame, TraceMode mode, const PointRows<Count>& before,
                                  const PointRows<Count>& band, const ColSpan& summed) {
    const Cutter<Count> cutter(frame, before, band, summed);
    return mode == TraceMode::points ? cutter.lines_of_points() : cutter.lines_of_cells();
}

template std::vector<TraceLine> take_apart(const TraceFrame&, TraceMode, const PointRows<std::uint8_t>&,
                                           const PointRows<std::uint8_t>&, const ColSpan&);
template std::vector<TraceLine> take_apart(const TraceFrame&, TraceMode, const PointRows<std::uint16_t>&,
                                           const PointRows<std::uint16_t>&, const ColSpan&);

}  // namespace d2b
