#include "pipeline/tiles/tile_labels.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace d2b {
namespace {

constexpr std::int32_t rows_read_at_once = 256;

}  // namespace

TileLabels::TileLabels(const TileRun& run, const JoinedTile& joined)
    : window_(joined.window), buildings_(static_cast<Label>(joined.buildings.size())) {
    std::map<std::int64_t, std::vector<const JoinedUnit*>> tiles;  // reads each tile once
    for (const JoinedUnit& unit : joined.units)
        tiles[run.tiles().tile_of(unit.unit)].push_back(&unit);
    for (const auto& [tile, units] : tiles) {
        const FoundTile found = run.load_found(tile);
        const std::vector<PlacedUnit> placed = run.tiles().units_of(tile);
        for (const JoinedUnit* unit : units) {
            const auto here = std::ranges::find(placed, unit->unit, &PlacedUnit::number);
            for (LabelRun label : found.units[static_cast<std::size_t>(here - placed.begin())].runs) {
                label.begin = std::max(label.begin, window_.col);
                label.end = std::min(label.end, window_.end_col());
                if (label.label >= unit->number.size())
                    throw InputError(
                        "What 'join' wrote of tile " + std::to_string(tile) +
                        " does not fit what 'find' wrote; delete the folders of both steps and run "
                        "them again.");
                label.label = unit->number[label.label];
                if (label.label != 0 && label.begin < label.end && label.row >= window_.row &&
                    label.row < window_.end_row())
                    runs_.push_back(label);
            }
        }
    }
    std::ranges::sort(runs_, {}, [](const LabelRun& r) { return std::pair(r.row, r.begin); });
    first_.resize(static_cast<std::size_t>(window_.rows) + 1);
    for (const LabelRun& label : runs_)
        ++first_[static_cast<std::size_t>(label.row - window_.row) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
}

std::span<const LabelRun> TileLabels::row(std::int32_t row) const {
    if (row < window_.row || row >= window_.end_row())
        return {};
    const auto i = static_cast<std::size_t>(row - window_.row);
    return std::span(runs_).subspan(first_[i], first_[i + 1] - first_[i]);
}

LabelRows TileLabels::own(Context& context) const {
    LabelRows rows(context.make_spool(), window_);
    for (std::int32_t first = window_.row; first < window_.end_row(); first += rows_read_at_once) {
        const Window part{first, window_.col, std::min(rows_read_at_once, window_.end_row() - first),
                          window_.cols};
        Grid<Label> labels(part.rows, part.cols);
        for (std::int32_t r = part.row; r < part.end_row(); ++r)
            for (const LabelRun& run : row(r))
                if (run.label <= buildings_)
                    std::fill(labels.row(r - part.row).begin() + (run.begin - part.col),
                              labels.row(r - part.row).begin() + (run.end - part.col), run.label);
        rows.append({part, part}, labels, *context.threads);
    }
    std::vector<Label> number(buildings_ + std::size_t{1});
    for (Label label = 0; label <= buildings_; ++label)
        number[label] = label;
    rows.renumber(std::move(number));
    return rows;
}

std::vector<bool> TileLabels::near_others(LatticePoint reach) const {
    std::vector<bool> near(buildings_);
    for (const LabelRun& other : runs_) {
        if (other.label <= buildings_)
            continue;
        for (std::int32_t r = other.row - reach.row; r <= other.row + reach.row; ++r) {
            const auto runs = row(r);
            // Runs of a row do not overlap, so their ends ascend as well.
            auto run = std::ranges::lower_bound(runs, other.begin - reach.col, {}, &LabelRun::end);
            for (; run != runs.end() && run->begin <= other.end + reach.col; ++run)
                if (run->label <= buildings_)
                    near[run->label - 1] = true;
        }
    }
    return near;
}

std::vector<RowSpan> TileLabels::around(const std::vector<bool>& wanted, LatticePoint reach) const {
    std::vector<RowSpan> grown;
    for (const LabelRun& run : runs_) {
        if (run.label > buildings_ || !wanted[run.label - 1])
            continue;
        for (std::int32_t r = std::max(run.row - reach.row, window_.row);
             r <= std::min(run.row + reach.row, window_.end_row() - 1); ++r)
            grown.push_back({r, std::max(run.begin - reach.col, window_.col),
                             std::min(run.end + reach.col, window_.end_col())});
    }
    std::ranges::sort(grown, {}, [](const RowSpan& s) { return std::pair(s.row, s.begin); });
    std::vector<RowSpan> spans;
    for (const RowSpan& span : grown) {
        if (!spans.empty() && spans.back().row == span.row && span.begin <= spans.back().end)
            spans.back().end = std::max(spans.back().end, span.end);
        else
            spans.push_back(span);
    }
    return spans;
}

}  // namespace d2b
