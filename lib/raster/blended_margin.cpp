#include "raster/blended_margin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "core/grid.hpp"
#include "core/text.hpp"
#include "raster/morphology.hpp"

namespace d2b {
namespace {

constexpr std::int32_t strip_rows = 32;
constexpr std::int32_t strips = 24;
constexpr std::int32_t inner_cells = 12;  ///< distance from missing cells from which on nothing is blended
constexpr std::size_t line_cells = 24;
constexpr double least_inner = 0.3;     ///< share of inner cells; heights of buildings alone have hardly any
constexpr double outermost = 0.005;     ///< share of the inner cells beyond each end of the range of land
constexpr double blended_share = 0.05;  ///< of the lines that lead away from missing cells
constexpr std::int64_t least_lines = 20;  ///< because a few cells may be anything
constexpr double covered_share = 0.75;    ///< of the blended lines, whose blended cells lie within the margin
constexpr std::int32_t nearby = 16;       ///< cells along an edge among which one shows that it is blended

bool is_missing(double value, const std::vector<double>& values) {
    return std::isnan(value) || std::ranges::find(values, value) != values.end();
}

Mask missing_cells(std::span<const double> values, std::int32_t rows, std::int32_t cols,
                   const std::vector<double>& missing) {
    Mask mask(rows, cols);
    std::ranges::transform(values, mask.values.begin(), [&](double value) {
        return static_cast<std::uint8_t>(is_missing(value, missing) ? 1 : 0);
    });
    return mask;
}

/// Rows of a raster that were read together.
struct Strip {
    std::vector<double> values;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    bool first = false;  ///< begins with the first row of the window
    bool last = false;
};

/// Reads strips of a window.
class StripReader {
  public:
    StripReader(const Window& window, const ReadValues& read) : window_(window), read_(read) {}

    /// Calls use(strip) for all rows of a small window, or else for strips at equal distances. Where one of
    /// two successive strips is all missing, a strip between both shows the edge, which runs along rows.
    template <typename Use>
    void for_each(const std::vector<double>& missing, const Use& use);

  private:
    void read(std::int32_t begin, std::int32_t end) {
        strip_.rows = end - begin;
        strip_.cols = window_.cols;
        strip_.first = begin == window_.row;
        strip_.last = end == window_.end_row();
        strip_.values.resize(static_cast<std::size_t>(strip_.rows) * static_cast<std::size_t>(strip_.cols));
        read_({begin, window_.col, strip_.rows, strip_.cols}, strip_.values);
    }
    [[nodiscard]] bool is_empty(const std::vector<double>& missing) const {
        return std::ranges::all_of(strip_.values, [&](double value) { return is_missing(value, missing); });
    }
    void read_edge(std::int32_t begin, std::int32_t end, bool first_is_empty,
                   const std::vector<double>& missing);

    const Window& window_;
    const ReadValues& read_;
    Strip strip_;
};

/// @param begin, end rows, of which either the first or the last is empty
void StripReader::read_edge(std::int32_t begin, std::int32_t end, bool first_is_empty,
                            const std::vector<double>& missing) {
    std::int32_t low = begin;
    std::int32_t high = end - 1;
    while (high - low > 1) {
        const std::int32_t middle = low + (high - low) / 2;
        read(middle, middle + 1);
        (is_empty(missing) == first_is_empty ? low : high) = middle;
    }
    const std::int32_t first = std::max(begin, high - strip_rows / 2);
    read(first, std::min(end, first + strip_rows));
}

template <typename Use>
void StripReader::for_each(const std::vector<double>& missing, const Use& use) {
    if (window_.rows <= 4 * strips * strip_rows / 3) {
        for (std::int32_t row = window_.row; row < window_.end_row(); row += 2 * strip_rows) {
            read(row, std::min(row + 2 * strip_rows, window_.end_row()));
            use(strip_);
        }
        return;
    }
    std::optional<bool> above;
    std::int32_t end_above = window_.row;
    for (std::int32_t i = 0; i < strips; ++i) {
        const auto begin = static_cast<std::int32_t>(window_.row + std::int64_t{window_.rows - strip_rows} *
                                                                       i / (strips - 1));
        read(begin, begin + strip_rows);
        use(strip_);
        const bool empty = is_empty(missing);
        if (above && *above != empty) {
            read_edge(end_above - 1, begin + 1, *above, missing);
            use(strip_);
        }
        above = empty;
        end_above = begin + strip_rows;
    }
}

/// Range of elevations away from missing cells.
struct Land {
    double lowest = 0;
    double highest = 0;
    bool known = false;
};

/// Samples of elevations and of values outside of the limits.
struct Survey {
    std::vector<double> inner;  ///< a sample
    std::int64_t inner_count = 0;
    std::int64_t candidates = 0;             ///< valid cells that might be inner ones
    std::map<double, std::int64_t> outside;  ///< cells by their value

    void add(const Strip& strip, const MissingValues& missing);
    [[nodiscard]] Land land();
    /// Returns the value outside of the limits that more than half of such cells have.
    [[nodiscard]] std::optional<double> shared_outside() const;
};

void Survey::add(const Strip& strip, const MissingValues& missing) {
    constexpr std::size_t most_values = 1 << 16;
    constexpr std::int64_t sampled = 7;  // one of so many cells
    Mask gaps = missing_cells(strip.values, strip.rows, strip.cols, missing.undeclared);
    for (std::size_t i = 0; i < strip.values.size(); ++i)
        if (const double value = strip.values[i]; gaps.values[i] == 0 && !missing.limits.hold(value)) {
            gaps.values[i] = 1;
            if (outside.size() < most_values || outside.contains(value))
                ++outside[value];
        }
    // Rows beyond the strip may be missing.
    const std::int32_t begin = strip.first ? 0 : std::min(inner_cells, strip.rows);
    const std::int32_t end = strip.last ? strip.rows : std::max(begin, strip.rows - inner_cells);
    candidates += std::count(gaps.values.begin() + std::ptrdiff_t{begin} * strip.cols,
                             gaps.values.begin() + std::ptrdiff_t{end} * strip.cols, std::uint8_t{0});
    const Mask near = dilate(gaps, inner_cells);
    for (std::size_t i = gaps.index(begin, 0); i < gaps.index(end, 0); ++i)
        if (near.values[i] == 0 && inner_count++ % sampled == 0)
            inner.push_back(strip.values[i]);
}

Land Survey::land() {
    if (inner.empty() || static_cast<double>(inner_count) < least_inner * static_cast<double>(candidates))
        return {};
    const auto beyond = static_cast<std::ptrdiff_t>(outermost * static_cast<double>(inner.size()));
    const auto low = inner.begin() + beyond;
    std::ranges::nth_element(inner, low);
    const double lowest = *low;
    const auto high = inner.end() - 1 - beyond;
    std::ranges::nth_element(inner, high);
    return {lowest, *high, true};
}

std::optional<double> Survey::shared_outside() const {
    std::int64_t all = 0;
    std::pair<std::int64_t, double> most;
    for (const auto& [value, cells] : outside) {
        all += cells;
        most = std::max(most, {cells, value});
    }
    return 2 * most.first > all ? std::optional(most.second) : std::nullopt;
}

/// Sides of land on which missing values are.
struct Sides {
    bool low;
    bool high;
};

/// Returns both sides if no missing value is known.
Sides sides_of(const MissingValues& missing, const Land& land) {
    std::vector<double> values = missing.undeclared;
    if (missing.declared)
        values.push_back(*missing.declared);
    if (values.empty())
        return {true, true};
    return {std::ranges::min(values) < land.lowest, std::ranges::max(values) > land.highest};
}

/// Lines of cells that lead away from missing cells.
struct Lines {
    double step = 0;  ///< smallest one between blended cells
    std::int64_t all = 0;
    std::array<std::int64_t, line_cells + 1> blended{};  ///< by the number of the last blended cell
    std::map<std::optional<double>, std::int64_t>
        beside{};  ///< blended lines by the value of the missing cell

    void add(const Strip& strip, const MissingValues& missing, const BlendedMargin& range);
    [[nodiscard]] std::int64_t all_blended() const {
        std::int64_t sum = 0;
        for (const std::int64_t lines : blended)
            sum += lines;
        return sum;
    }
    [[nodiscard]] bool are_blended() const {
        return all_blended() >= least_lines &&
               static_cast<double>(all_blended()) >= blended_share * static_cast<double>(all);
    }

  private:
    void add(std::span<const double> line, std::optional<double> value, const BlendedMargin& range);
};

void Lines::add(std::span<const double> line, std::optional<double> value, const BlendedMargin& range) {
    if (line.empty())
        return;
    ++all;
    if (!range.is_beyond(line.front()))
        return;
    std::size_t last = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (range.is_beyond(line[i]))
            last = i + 1;
    // A tower that is higher than all land has a level roof, and so has water that is lower.
    std::size_t steep = 0;
    for (std::size_t i = 0; i < last && i + 1 < line.size(); ++i)
        steep += std::abs(line[i + 1] - line[i]) >= step ? 1U : 0U;
    if (2 * steep < last)
        return;
    ++blended[last];
    ++beside[value];
}

void Lines::add(const Strip& strip, const MissingValues& missing, const BlendedMargin& range) {
    const Mask gaps = missing_cells(strip.values, strip.rows, strip.cols, missing.undeclared);
    std::array<double, line_cells> line{};
    const auto follow = [&](std::int32_t row, std::int32_t col, std::int32_t down, std::int32_t right) {
        const double beside_line = strip.values[gaps.index(row, col)];
        std::size_t cells = 0;
        for (row += down, col += right; cells < line.size() && row >= 0 && row < strip.rows && col >= 0 &&
                                        col < strip.cols && gaps.values[gaps.index(row, col)] == 0;
             row += down, col += right, ++cells)
            line[cells] = strip.values[gaps.index(row, col)];
        add(std::span(line).first(cells),
            std::isnan(beside_line) ? missing.declared : std::optional(beside_line), range);
    };
    const auto is_gap = [&](std::int32_t row, std::int32_t col) {
        return gaps.values[gaps.index(row, col)] != 0;
    };
    for (std::int32_t row = 0; row < strip.rows; ++row)
        for (std::int32_t col = 0; col < strip.cols; ++col) {
            const bool here = is_gap(row, col);
            if (col > 0 && is_gap(row, col - 1) != here)
                here ? follow(row, col, 0, -1) : follow(row, col - 1, 0, 1);
            if (row > 0 && is_gap(row - 1, col) != here)
                here ? follow(row, col, -1, 0) : follow(row - 1, col, 1, 0);
        }
}

/// Replaces blended cells by `blended_value`.
void replace_blended(const BlendedMargin& margin, const Window& area, std::span<double> values) {
    const Mask gaps = missing_cells(values, area.rows, area.cols, margin.missing);
    const Mask near = dilate(gaps, margin.cells);
    Mask blended(area.rows, area.cols);
    for (std::size_t i = 0; i < values.size(); ++i)
        blended.values[i] = near.values[i] != 0 && gaps.values[i] == 0 && margin.is_beyond(values[i]) ? 1 : 0;
    const Mask edges = dilate(blended, nearby);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (near.values[i] != 0 && edges.values[i] != 0 && gaps.values[i] == 0)
            values[i] = blended_value;
}

}  // namespace

BlendedMargin find_blended_margin(const Window& window, MissingValues missing, double step,
                                  const ReadValues& read) {
    StripReader reader(window, read);
    Survey survey;
    reader.for_each(missing.undeclared, [&](const Strip& strip) { survey.add(strip, missing); });
    const Land land = survey.land();
    if (!land.known)
        return {};
    BlendedMargin margin;
    const auto count_lines = [&] {
        const auto [low, high] = sides_of(missing, land);
        margin.lowest = low ? land.lowest - step : -std::numeric_limits<double>::infinity();
        margin.highest = high ? land.highest + step : std::numeric_limits<double>::infinity();
        Lines lines{.step = step};
        reader.for_each(missing.undeclared, [&](const Strip& strip) { lines.add(strip, missing, margin); });
        return lines;
    };
    Lines lines = count_lines();
    if (const auto outside = survey.shared_outside(); outside && !lines.are_blended()) {
        missing.undeclared.push_back(*outside);
        lines = count_lines();
    }
    if (!lines.are_blended())
        return {};
    margin.missing = missing.undeclared;
    const auto blended = static_cast<double>(lines.all_blended());
    std::int32_t last = 0;
    for (std::int64_t covered = 0; static_cast<double>(covered) < covered_share * blended;)
        covered += lines.blended[static_cast<std::size_t>(++last)];
    // Cubic resampling overshoots on the side of the land as well, where it cannot be told from buildings.
    margin.cells = last + (last + 1) / 2;
    margin.with =
        std::ranges::max_element(lines.beside, {}, [](const auto& pair) { return pair.second; })->first;
    return margin;
}

void read_without_margin(const BlendedMargin& margin, const Window& raster, const Window& part,
                         std::span<double> values, const ReadValues& read) {
    if (margin.cells == 0) {
        read(part, values);
        return;
    }
    const std::int32_t around = margin.cells + nearby;
    const std::int32_t row = std::max(raster.row, part.row - around);
    const std::int32_t col = std::max(raster.col, part.col - around);
    const Window area{row, col, std::min(raster.end_row(), part.end_row() + around) - row,
                      std::min(raster.end_col(), part.end_col() + around) - col};
    std::vector<double> all(static_cast<std::size_t>(area.points()));
    read(area, all);
    replace_blended(margin, area, all);
    for (std::int32_t i = 0; i < part.rows; ++i)
        std::copy_n(all.begin() + std::ptrdiff_t{part.row - row + i} * area.cols + (part.col - col),
                    part.cols, values.begin() + std::ptrdiff_t{i} * part.cols);
}

std::string blended_text(std::int64_t cells, const BlendedMargin& margin, const std::string& raster,
                         const std::string& stored) {
    return cells_have(cells, raster) + (cells == 1 ? "a value" : "values") + " blended with " +
           (margin.with ? value_text(*margin.with) : "another") +
           " beside cells without data, as resampling does before that is declared as NoData, so they are "
           "treated "
           "as no data; resample the original raster again" +
           (margin.with ? ", for example with gdalwarp -srcnodata " + stored : "") + ".";
}

}  // namespace d2b
