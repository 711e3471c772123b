#include "core/undeclared_nodata.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/text.hpp"
#include "core/value_regions.hpp"

namespace d2b {
namespace {

constexpr std::int64_t border_share = 1000;  // at least one of this many cells of the border
constexpr double max_similar_border = 0.5;   // of neighbours along the border, which are few

/// Reads a window in parts and passes on its rows.
template <typename Take>
void for_each_row(const Window& window, const ReadValues& read, const Take& take) {
    constexpr std::int64_t cells_at_once = 1 << 20;
    if (window.points() == 0)
        return;
    const auto cols = static_cast<std::size_t>(window.cols);
    const auto rows =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(cells_at_once / window.cols, 1, 256));
    std::vector<double> values;
    for (std::int32_t row = window.row; row < window.end_row(); row += rows) {
        const Window part{row, window.col, std::min(rows, window.end_row() - row), window.cols};
        values.resize(static_cast<std::size_t>(part.points()));
        read(part, values);
        for (std::size_t i = 0; i < static_cast<std::size_t>(part.rows); ++i)
            take(std::span<const double>(values).subspan(i * cols, cols));
    }
}

struct BorderCount {
    std::int64_t cells = 0;
    Contour contour;
};

void count_along(std::span<const double> cells, double step, std::map<double, BorderCount>& counts) {
    const auto is_missing = [&](std::size_t i) { return std::isnan(cells[i]); };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (std::isnan(cells[i]))
            continue;
        ++counts[cells[i]].cells;
        if (i == 0 || std::isnan(cells[i - 1]) || cells[i] == cells[i - 1])
            continue;
        counts[cells[i]].contour.add(largest_step(cells, i, i - 1, is_missing), step);
        counts[cells[i - 1]].contour.add(largest_step(cells, i - 1, i, is_missing), step);
    }
}

/// Finds the values next to the outermost cells.
UndeclaredNodata find_at_border(const Window& window, const BorderCells& border,
                                const UndeclaredNodataRules& rules, const ReadValues& read) {
    double step = rules.step;
    std::vector<double> candidates = border_candidates(border, step);
    while (!candidates.empty()) {
        ValueRegions regions(candidates, step);
        for_each_row(window, read, [&](std::span<const double> row) { regions.add(row); });
        const Verdict verdict = regions.finish(rules.min_breadth);
        if (verdict.rounding > 0) {
            // Each value of a surface that was rounded to large steps is a large step away from the others.
            step = 1.5 * verdict.rounding;
            candidates = border_candidates(border, step);
        } else if (verdict.elevations.empty()) {
            return verdict.found;
        } else {
            std::erase_if(candidates, [&](double candidate) {
                return std::ranges::find(verdict.elevations, candidate) != verdict.elevations.end();
            });
        }
    }
    return {};
}

}  // namespace

std::vector<double> UndeclaredNodata::values() const {
    std::vector<double> all;
    for (const SharedValue& one : taken)
        all.push_back(one.value);
    return all;
}

std::string undeclared_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) +
           ", lie at its edge, and most cells around are at least " +
           number_text(UndeclaredNodataRules::step_m) + " m higher or lower";
}

void BorderCells::add_rows(std::int32_t rows,
                           const std::function<std::span<const double>(std::int32_t)>& row_at) {
    const auto is_valid = [](double value) { return !std::isnan(value); };
    std::optional<std::int32_t> last;
    for (std::int32_t i = 0; i < rows; ++i) {
        const std::span<const double> row = row_at(i);
        const auto first = std::ranges::find_if(row, is_valid);
        if (first == row.end())
            continue;
        left.push_back(*first);
        right.push_back(*std::find_if(row.rbegin(), row.rend(), is_valid));
        if (top.empty())
            top.assign(row.begin(), row.end());
        last = i;
    }
    if (last) {
        const std::span<const double> row = row_at(*last);
        bottom.assign(row.begin(), row.end());
    }
}

BorderCells read_border(const Window& window, const ReadValues& read) {
    const auto strip = [&](const Window& part) {
        std::vector<double> values(static_cast<std::size_t>(part.points()));
        read(part, values);
        return values;
    };
    if (window.points() == 0)
        return {};
    BorderCells border{strip({window.row, window.col, 1, window.cols}),
                       strip({window.end_row() - 1, window.col, 1, window.cols}),
                       strip({window.row, window.col, window.rows, 1}),
                       strip({window.row, window.end_col() - 1, window.rows, 1})};
    if (std::ranges::all_of(border.sides(), [](const std::vector<double>* side) {
            return std::ranges::none_of(*side, [](double value) { return std::isnan(value); });
        }))
        return border;
    border = {};
    for_each_row(window, read,
                 [&](std::span<const double> row) { border.add_rows(1, [&](std::int32_t) { return row; }); });
    return border;
}

std::vector<double> border_candidates(const BorderCells& border, double step) {
    std::map<double, BorderCount> counts;
    std::size_t all = 0;
    for (const std::vector<double>* side : border.sides()) {
        count_along(*side, step, counts);
        all += side->size();
    }
    const std::int64_t least =
        std::max<std::int64_t>(2, (static_cast<std::int64_t>(all) + border_share - 1) / border_share);
    std::vector<SharedValue> candidates;
    for (const auto& [value, count] : counts)
        if (count.cells >= least && count.contour.is_step(max_similar_border))
            candidates.push_back({value, count.cells});
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &SharedValue::cells);
    candidates.resize(std::min(candidates.size(), max_candidates));
    std::vector<double> values;
    values.reserve(candidates.size());
    for (const SharedValue& one : candidates)
        values.push_back(one.value);
    return values;
}

UndeclaredNodata find_undeclared_nodata(const Window& window, const BorderCells& border,
                                        const UndeclaredNodataRules& rules, const ReadValues& read,
                                        const AnyCommon& any_common) {
    UndeclaredNodata found;
    if (!any_common || any_common(border_candidates(border, rules.step)))
        found = find_at_border(window, border, rules, read);
    for (const std::vector<double>* side : border.sides())
        for (const double value : *side)
            if (!std::isnan(value))
                found.lowest_at_edge = std::min(value, found.lowest_at_edge.value_or(value));
    for (UndeclaredNodata outer = found; !outer.taken.empty();) {
        // Another value may surround the rest, because rasters are cut out and warped more than once.
        const std::vector<double> values = found.values();
        const ReadValues read_rest = [&](const Window& part, std::span<double> cells) {
            read(part, cells);
            for (const double value : values)
                std::ranges::replace(cells, value, std::numeric_limits<double>::quiet_NaN());
        };
        outer = find_at_border(window, read_border(window, read_rest), rules, read_rest);
        found.taken.insert(found.taken.end(), outer.taken.begin(), outer.taken.end());
        found.named = outer.named;
    }
    return found;
}

}  // namespace d2b
