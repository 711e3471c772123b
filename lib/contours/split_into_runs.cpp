#include "contours/split_into_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "contours/open_chains.hpp"
#include "core/band.hpp"
#include "core/grid.hpp"

namespace d2b::contours {

/// Adapts collapsed contouring (-trace points) to the tracer of cells: a unit square between four grid points
/// belongs to the levels that all four have, so its count is the smallest count of its corners. Above level 0
/// all four must have the same label. Halo: one row below and one column to the right.
/// @param upper, lower counts of two adjacent rows of points @param squares output, one element fewer
template <typename Count>
void squares_between(std::span<const Count> upper, std::span<const Count> lower,
                     std::span<const Label> upper_labels, std::span<const Label> lower_labels,
                     std::vector<Count>& squares) {
    squares.resize(upper.size() - 1);
    for (std::size_t c = 0; c < squares.size(); ++c)
        squares[c] = std::min(std::min(upper[c], upper[c + 1]), std::min(lower[c], lower[c + 1]));
    if (upper_labels.empty())
        return;
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const Label label = upper_labels[c];
        if (label != upper_labels[c + 1] || label != lower_labels[c] || label != lower_labels[c + 1])
            squares[c] = std::min(squares[c], Count{1});
    }
}

namespace {

/// Index of the top run that contains a square in the low bits, its level in the high bits, so that comparing
/// holders compares levels first; 0 if there is none. Two bits in between encode the position of a square
/// relative to a point.
using Holder = std::int64_t;
constexpr int place_bits = 32;
constexpr int level_bits = 34;
constexpr Holder above_line = Holder{2} << place_bits;
constexpr Holder on_the_left = Holder{1} << place_bits;
constexpr Holder lowest_level = Holder{1} << level_bits;

/// Holder of each square of a row, plus one on either side.
using Holders = std::vector<Holder>;

Holders holders_of(const RunRow& row, std::size_t squares) {
    Holders holders(squares + 2);
    for (std::size_t s = 0; s < row.top_runs.size(); ++s) {
        const TopRun& top_run = row.top_runs[s];
        const Holder holder = (static_cast<Holder>(top_run.level + 1) << level_bits) | static_cast<Holder>(s);
        std::fill(holders.begin() + 1 + top_run.begin, holders.begin() + 1 + top_run.end, holder);
    }
    return holders;
}

/// Finds the highest holder among the four squares around each point of a line, the first one in scan order
/// if equal. The result has the bit for above the line but not the bit for left.
/// @param above from the square on the left of the first point; empty if there is no such row
D2B_MULTIVERSION void pick_highest(std::span<const Holder> above, std::span<const Holder> below,
                                   std::span<Holder> highest) {
    for (std::size_t c = 0; c < highest.size(); ++c)
        highest[c] = std::max(below[c] | on_the_left, below[c + 1]);
    if (!above.empty())
        for (std::size_t c = 0; c < highest.size(); ++c)
            highest[c] = std::max(highest[c], std::max(above[c] | on_the_left, above[c + 1]) | above_line);
    for (Holder& holder : highest)
        holder = holder < lowest_level ? 0 : holder & ~on_the_left;
}

template <typename Count>
struct Row {
    std::span<const double> elevations;
    std::span<const Label> labels;
    std::span<const Count> counts;
    std::vector<std::int32_t> spires;
};

template <typename Count>
class RunSplitter {
  public:
    RunSplitter(const TraceFrame& frame, const PointRows<Count>& before, const PointRows<Count>& band)
        : frame_(frame), before_(before), band_(band) {}

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
                                           std::size_t point_runs, Holders& highest) const;
    void add_point_run(TraceLine& line, const PointRun& share) const;
    [[nodiscard]] static std::vector<double> outside_of(const Row<Count>& row);

    const TraceFrame& frame_;
    const PointRows<Count>& before_;
    const PointRows<Count>& band_;
};

template <typename Count>
std::vector<double> RunSplitter<Count>::outside_of(const Row<Count>& row) {
    std::vector<double> outside(row.elevations.size());
    for (std::size_t c = 0; c < outside.size(); ++c) {
        const double z = row.elevations[c];  // unconditional read, so that the loop has no branches
        outside[c] = row.counts[c] == 1 ? z : nothing_outside;
    }
    return outside;
}

template <typename Count>
RunRow RunSplitter<Count>::cut(std::span<const Count> counts, std::span<const Label> labels) const {
    RunRow row;
    row.levels.resize(static_cast<std::size_t>(frame_.levels));
    run_length_encode<Count>(counts, labels, row);
    return row;
}

/// Adds statistics of points of the line.
template <typename Count>
void RunSplitter<Count>::add_point_run(TraceLine& line, const PointRun& share) const {
    PointStats stats;  // local because the compiler would have to store every sum to memory in the list
    for (std::int32_t c = share.begin; c < share.end; ++c)
        if (const double z = line.elevations[static_cast<std::size_t>(c)]; !std::isnan(z))
            stats.add(z, frame_.fixed);
    if (stats.n != 0)
        line.point_runs.emplace_back(share).stats = stats;
}

/// Each cell is a point of the contour in which it lies, so no halo is needed.
template <typename Count>
std::vector<TraceLine> RunSplitter<Count>::lines_of_cells() const {
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
            add_point_run(line, {false, s, line.squares.top_runs[s].begin, line.squares.top_runs[s].end, {}});
    }
    if (is_last()) {
        lines.emplace_back().line = band_.end_row();
        lines.back().squares = cut({}, {});
    }
    return lines;
}

/// Squares between a row of points and the previous one.
template <typename Count>
RunRow RunSplitter<Count>::squares_above(std::int32_t r) const {
    const Row<Count> upper = row(r - 1);
    const Row<Count> lower = row(r);
    std::vector<Count> squares;
    squares_between<Count>(upper.counts, lower.counts, upper.labels, lower.labels, squares);
    return cut(squares, upper.labels.first(upper.labels.empty() ? 0 : squares.size()));
}

/// Counts each point on the line once, for the highest contour among the four squares around it (the first
/// one in scan order if equal), so that a point at which two contours touch belongs to only one of them.
/// @param point_runs expected number @param highest buffer reused for all lines
template <typename Count>
TraceLine RunSplitter<Count>::line_of_points(std::int32_t number, const Holders& above, RunRow squares,
                                             std::size_t point_runs, Holders& highest) const {
    TraceLine line;
    line.point_runs.reserve(point_runs);
    line.line = number;
    const Row<Count> points = row(number);
    line.elevations = points.elevations;
    line.spires = points.spires;
    if (number < band_.shape().first_row)
        line.owner = before_.elevations;
    const Holders below = holders_of(squares, points.elevations.size() - 1);
    highest.resize(points.elevations.size());
    pick_highest(above, below, highest);
    for_equal_runs(highest, [&](std::int32_t begin, std::int32_t end, Holder holder) {
        add_point_run(line, {(holder & above_line) != 0, static_cast<std::uint32_t>(holder), begin, end, {}});
    });
    line.squares = std::move(squares);
    return line;
}

template <typename Count>
std::vector<TraceLine> RunSplitter<Count>::lines_of_points() const {
    std::vector<TraceLine> lines;
    const auto squares_a_row = static_cast<std::size_t>(band_.shape().cols - 1);
    Holders above;
    Holders highest;
    const std::int32_t first = band_.shape().first_row;
    if (has(first - 2))
        above = holders_of(squares_above(first - 1), squares_a_row);
    for (std::int32_t r = first; r < band_.end_row(); ++r) {
        if (has(r - 1)) {
            const std::size_t point_runs = lines.empty() ? 0 : lines.back().point_runs.size();
            lines.push_back(
                line_of_points(r - 1, above, squares_above(r), point_runs + point_runs / 8, highest));
            above = holders_of(lines.back().squares, squares_a_row);
        } else {
            lines.emplace_back();  // the first row of points is the line above the first row of squares
        }
        lines.back().outside = outside_of(row(r));
    }
    if (is_last())
        lines.push_back(line_of_points(band_.end_row() - 1, above, cut({}, {}), 0, highest));
    return lines;
}

}  // namespace

template <typename Count>
std::vector<TraceLine> split_into_runs(const TraceFrame& frame, TraceMode mode,
                                       const PointRows<Count>& before, const PointRows<Count>& band) {
    const RunSplitter<Count> splitter(frame, before, band);
    return mode == TraceMode::points ? splitter.lines_of_points() : splitter.lines_of_cells();
}

template std::vector<TraceLine> split_into_runs(const TraceFrame&, TraceMode, const PointRows<std::uint8_t>&,
                                                const PointRows<std::uint8_t>&);
template std::vector<TraceLine> split_into_runs(const TraceFrame&, TraceMode, const PointRows<std::uint16_t>&,
                                                const PointRows<std::uint16_t>&);

}  // namespace d2b::contours
