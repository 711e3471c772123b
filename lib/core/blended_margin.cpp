#include "core/blended_margin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/text.hpp"

namespace d2b {
namespace {

constexpr std::int32_t strip_rows = 32;
constexpr std::int32_t strips = 16;
constexpr std::size_t line_cells = 12;
constexpr std::size_t land_cell = 3;      ///< of a line, from which on it is land
constexpr double least_blending = 0.02;   ///< share of the missing value in a blended one
constexpr double blended_share = 0.3;     ///< of the lines
constexpr std::int64_t least_lines = 20;  ///< because a few may be walls
constexpr double covered_share = 0.75;    ///< of the blended lines that end within the margin

bool is_missing(double value, const std::vector<double>& values) {
    return std::isnan(value) || std::ranges::find(values, value) != values.end();
}

/// Lines of cells that lead away from missing cells.
struct Lines {
    std::int64_t all = 0;
    std::array<std::int64_t, line_cells> blended{};  ///< by the number of blended cells
    std::map<double, std::int64_t> outside;  ///< cells by their value, if that is outside of the limits

    [[nodiscard]] std::int64_t blended_lines() const {
        std::int64_t sum = 0;
        for (const std::int64_t lines : blended)
            sum += lines;
        return sum;
    }
    [[nodiscard]] bool are_blended() const {
        const std::int64_t lines = blended_lines();
        return lines >= least_lines && static_cast<double>(lines) >= blended_share * static_cast<double>(all);
    }
};

/// Counts a line. @param missing value beside its first cell
void count_line(std::span<const double> line, double missing, double step, Lines& lines) {
    if (line.size() <= land_cell)
        return;
    const double difference = line[land_cell] - missing;
    if (std::abs(difference) < 3 * step)
        return;
    ++lines.all;
    const double least = std::max(step, least_blending * std::abs(difference));
    const double sign = difference < 0 ? -1 : 1;
    for (std::size_t i = 1; i <= land_cell; ++i)
        if (sign * (line[i] - line[0]) < least)
            return;
    std::size_t cells = 1;
    while (cells + 1 < line.size() && std::abs(line[cells + 1] - line[cells]) >= step)
        ++cells;
    ++lines.blended[cells];
}

/// Rows of a raster that were read together.
struct Strip {
    std::span<const double> values;
    std::int32_t rows;
    std::int32_t cols;

    [[nodiscard]] double at(std::int32_t row, std::int32_t col) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                      static_cast<std::size_t>(col)];
    }
};

void count_lines(const Strip& strip, const MissingValues& missing, double step, Lines& lines) {
    std::array<double, line_cells> line{};
    const auto follow = [&](std::int32_t row, std::int32_t col, std::int32_t down, std::int32_t right) {
        const double beside = strip.at(row, col);
        if (std::isnan(beside) && !missing.declared)
            return;
        std::size_t cells = 0;
        for (row += down, col += right;
             cells < line.size() && row >= 0 && row < strip.rows && col >= 0 && col < strip.cols;
             row += down, col += right, ++cells) {
            line[cells] = strip.at(row, col);
            if (is_missing(line[cells], missing.undeclared))
                break;
        }
        count_line(std::span(line).first(cells), std::isnan(beside) ? *missing.declared : beside, step,
                   lines);
    };
    std::vector<bool> above;
    std::vector<bool> here(static_cast<std::size_t>(strip.cols));
    for (std::int32_t row = 0; row < strip.rows; ++row) {
        for (std::int32_t col = 0; col < strip.cols; ++col) {
            const auto at = static_cast<std::size_t>(col);
            here[at] = is_missing(strip.at(row, col), missing.undeclared);
            if (col > 0 && here[at - 1] != here[at])
                here[at] ? follow(row, col, 0, -1) : follow(row, col - 1, 0, 1);
            if (row > 0 && above[at] != here[at])
                here[at] ? follow(row, col, -1, 0) : follow(row - 1, col, 1, 0);
        }
        above = here;
    }
}

void count_outside(std::span<const double> values, const ElevationLimits& limits, Lines& lines) {
    constexpr std::size_t most_values = 1 << 16;
    for (const double value : values)
        if (!std::isnan(value) && !limits.hold(value) &&
            (lines.outside.size() < most_values || lines.outside.contains(value)))
            ++lines.outside[value];
}

/// Looks at strips of a window.
class Search {
  public:
    Search(const Window& window, const MissingValues& missing, double step, const ReadValues& read)
        : window_(window), missing_(missing), step_(step), read_(read) {}

    [[nodiscard]] Lines lines();

  private:
    void read(std::int32_t begin, std::int32_t end);
    void look_at(std::int32_t begin, std::int32_t end);
    /// Returns true if the rows read last have no elevation.
    [[nodiscard]] bool is_empty() const;
    void look_at_end_of_empty_rows(std::int32_t begin, std::int32_t end, bool first_is_empty);

    const Window& window_;
    const MissingValues& missing_;
    double step_;
    const ReadValues& read_;
    std::vector<double> values_;
    Lines lines_;
};

void Search::read(std::int32_t begin, std::int32_t end) {
    values_.resize(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(window_.cols));
    read_({begin, window_.col, end - begin, window_.cols}, values_);
}

void Search::look_at(std::int32_t begin, std::int32_t end) {
    read(begin, end);
    count_outside(values_, missing_.limits, lines_);
    count_lines({values_, end - begin, window_.cols}, missing_, step_, lines_);
}

bool Search::is_empty() const {
    return std::ranges::all_of(values_, [&](double value) { return is_missing(value, missing_.undeclared); });
}

/// Finds an edge that runs along rows, because strips elsewhere do not show it. @param begin, end rows, of
/// which either the first or the last is empty
void Search::look_at_end_of_empty_rows(std::int32_t begin, std::int32_t end, bool first_is_empty) {
    std::int32_t low = begin;
    std::int32_t high = end - 1;
    while (high - low > 1) {
        const std::int32_t middle = low + (high - low) / 2;
        read(middle, middle + 1);
        (is_empty() == first_is_empty ? low : high) = middle;
    }
    look_at(std::max(begin, high - strip_rows / 2), std::min(end, high + strip_rows / 2));
}

Lines Search::lines() {
    // All rows of a small raster.
    const std::int32_t rows = window_.rows <= 2 * strips * strip_rows ? window_.rows : strip_rows;
    const std::int32_t count = rows == window_.rows ? 1 : strips;
    std::optional<bool> above;
    std::int32_t end_above = window_.row;
    for (std::int32_t i = 0; i < count; ++i) {
        const auto begin = static_cast<std::int32_t>(
            window_.row + (count == 1 ? 0 : std::int64_t{window_.rows - rows} * i / (count - 1)));
        look_at(begin, begin + rows);
        const bool empty = is_empty();
        if (above && *above != empty)
            look_at_end_of_empty_rows(end_above - 1, begin + 1, *above);
        above = empty;
        end_above = begin + rows;
    }
    return std::move(lines_);
}

/// Returns the value outside of the limits that more than half of such cells have.
std::optional<double> shared_outside(const Lines& lines) {
    std::int64_t all = 0;
    std::pair<std::int64_t, double> most;
    for (const auto& [value, cells] : lines.outside) {
        all += cells;
        most = std::max(most, {cells, value});
    }
    return 2 * most.first > all ? std::optional(most.second) : std::nullopt;
}

/// Replaces the cells that are at most `cells` rows and columns away from a missing one.
void replace_margin(const BlendedMargin& margin, const Window& area, std::span<double> values) {
    const auto cols = static_cast<std::size_t>(area.cols);
    const auto rows = static_cast<std::size_t>(area.rows);
    const auto reach = static_cast<std::size_t>(margin.cells);
    constexpr std::size_t far = std::size_t{1} << 30U;
    // First along rows, then along columns.
    std::vector<bool> near(values.size());
    for (std::size_t row = 0; row < rows; ++row) {
        std::size_t since = far;
        for (std::size_t i = 0; i < cols; ++i) {
            const std::size_t at = row * cols + i;
            since = is_missing(values[at], margin.missing) ? 0 : since + 1;
            near[at] = since <= reach;
        }
        since = far;
        for (std::size_t i = cols; i-- > 0;) {
            const std::size_t at = row * cols + i;
            since = is_missing(values[at], margin.missing) ? 0 : since + 1;
            near[at] = near[at] || since <= reach;
        }
    }
    std::vector<bool> replaced(values.size());
    std::vector<std::size_t> since(cols, far);
    const auto pass = [&](std::size_t row) {
        for (std::size_t i = 0; i < cols; ++i) {
            const std::size_t at = row * cols + i;
            since[i] = near[at] ? 0 : since[i] + 1;
            replaced[at] = replaced[at] || since[i] <= reach;
        }
    };
    for (std::size_t row = 0; row < rows; ++row)
        pass(row);
    since.assign(cols, far);
    for (std::size_t row = rows; row-- > 0;)
        pass(row);
    for (std::size_t at = 0; at < values.size(); ++at)
        if (replaced[at] && !is_missing(values[at], margin.missing))
            values[at] = blended_value;
}

}  // namespace

BlendedMargin find_blended_margin(const Window& window, MissingValues missing, double step,
                                  const ReadValues& read) {
    Lines lines = Search(window, missing, step, read).lines();
    if (!lines.are_blended())
        if (const auto outside = shared_outside(lines)) {
            missing.undeclared.push_back(*outside);
            lines = Search(window, missing, step, read).lines();
        }
    if (!lines.are_blended())
        return {};
    const auto blended = static_cast<double>(lines.blended_lines());
    BlendedMargin margin{0, missing.undeclared,
                         missing.undeclared.empty() ? *missing.declared : missing.undeclared.front()};
    std::int64_t covered = 0;
    while (static_cast<double>(covered) < covered_share * blended)
        covered += lines.blended[static_cast<std::size_t>(margin.cells++)];
    // The last increment adds a cell, because cubic resampling overshoots, and edges may run aslant.
    return margin;
}

void read_without_margin(const BlendedMargin& margin, const Window& raster, const Window& part,
                         std::span<double> values, const ReadValues& read) {
    if (margin.cells == 0) {
        read(part, values);
        return;
    }
    const std::int32_t row = std::max(raster.row, part.row - margin.cells);
    const std::int32_t col = std::max(raster.col, part.col - margin.cells);
    const Window area{row, col, std::min(raster.end_row(), part.end_row() + margin.cells) - row,
                      std::min(raster.end_col(), part.end_col() + margin.cells) - col};
    std::vector<double> all(static_cast<std::size_t>(area.points()));
    read(area, all);
    replace_margin(margin, area, all);
    for (std::int32_t i = 0; i < part.rows; ++i)
        std::copy_n(all.begin() + std::ptrdiff_t{part.row - row + i} * area.cols + (part.col - col),
                    part.cols, values.begin() + std::ptrdiff_t{i} * part.cols);
}

std::string blended_text(std::int64_t cells, const BlendedMargin& margin, const std::string& raster,
                         const std::string& stored) {
    return cells_have(cells, raster) + (cells == 1 ? "a value" : "values") + " blended with " +
           value_text(margin.with) +
           " beside cells without data, because it was resampled before that was declared as NoData, so they "
           "are treated as no data; resample it again, for example with gdalwarp -srcnodata " +
           stored + ".";
}

}  // namespace d2b
