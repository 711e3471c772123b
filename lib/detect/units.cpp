#include "detect/units.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/byte_stream.hpp"

namespace d2b::detect {
namespace {

constexpr double fewest_around = 64;  // cells

std::int32_t cells_around(double around, double step, std::int32_t length) {
    return static_cast<std::int32_t>(std::clamp(
        std::ceil(around / step), std::min<double>(fewest_around, length), static_cast<double>(length)));
}

constexpr std::int32_t slab_rows = 16;

std::int32_t slabs_of(RowBand rows) {
    return (rows.end - rows.begin - 1) / slab_rows + 1;
}
RowBand slab_of(RowBand rows, std::int32_t slab) {
    const std::int32_t begin = rows.begin + slab * slab_rows;
    return {begin, std::min(begin + slab_rows, rows.end)};
}

using Lines = UnitEdges::Lines;

/// Returns the cells of a window on both sides of a seam between rows, or between columns.
Lines lines_at(const Grid<Label>& labels, const Window& own, std::int32_t seam, bool between_rows) {
    Lines lines;
    for (const std::int32_t side : {0, 1}) {
        std::vector<Label>& line = lines[static_cast<std::size_t>(side)];
        const std::int32_t at = seam - 1 + side;
        if (between_rows && seam > 0 && seam < labels.rows)
            line.assign(labels.row(at).begin() + own.col, labels.row(at).begin() + own.end_col());
        else if (!between_rows && seam > 0 && seam < labels.cols)
            for (std::int32_t row = own.row; row < own.end_row(); ++row)
                line.push_back(labels.at(row, at));
    }
    return lines;
}

void compare(const Lines& first, const Lines& second, UnitMerger& merger) {
    for (std::size_t side = 0; side < first.size(); ++side)
        merger.compare(first[side], second[side]);
}

}  // namespace

UnitGrid::UnitGrid(const Window& window, const CellSize& cell, double around, const UnitSize& size)
    : down_{{window.row, window.rows}, 1, cells_around(around, cell.down, window.rows)},
      across_{{window.col, window.cols}, 1, cells_around(around, cell.across, window.cols)} {
    if (window.points() <= size.most_whole)
        return;
    for (Axis* axis : {&down_, &across_})
        axis->parts = (axis->window.length - 1) / size.most_side + 1;
}

Unit UnitGrid::unit(std::int32_t row, std::int32_t col) const {
    const auto window = [](const Interval& rows, const Interval& cols) {
        return Window{rows.first, cols.first, rows.length, cols.length};
    };
    return {window(down_.own(row), across_.own(col)), window(down_.seen(row), across_.seen(col))};
}

std::int64_t UnitGrid::most_seen() const {
    return std::int64_t{down_.most_seen()} * across_.most_seen();
}

UnitGrid::Interval UnitGrid::Axis::own(std::int32_t part) const {
    const auto border = [this](std::int64_t i) {
        return static_cast<std::int32_t>(window.length * i / parts);
    };
    return {window.first + border(part), border(part + std::int64_t{1}) - border(part)};
}

UnitGrid::Interval UnitGrid::Axis::seen(std::int32_t part) const {
    const Interval middle = own(part);
    const std::int32_t before = std::min(around, middle.first - window.first);
    const std::int32_t behind =
        std::min(around, window.length - (middle.first - window.first) - middle.length);
    return {middle.first - before, before + middle.length + behind};
}

std::int32_t UnitGrid::Axis::most_seen() const {
    std::int32_t most = 0;
    for (std::int32_t part = 0; part < parts; ++part)
        most = std::max(most, seen(part).length);
    return most;
}

void LabelRows::append(const Unit& unit, const Grid<Label>& labels, Executor& threads, Label more) {
    const Window& own = unit.own;
    if (own.col == window_.col)
        unit_rows_.push_back({{own.row, own.end_row()}, {}});
    const UnitRow& here = unit_rows_.back();
    std::vector<SpoolEntry>& slabs = unit_rows_.back().units.emplace_back();
    threads.in_order(
        static_cast<std::size_t>(slabs_of(here.rows)),
        [&](std::size_t k, std::size_t) {
            ByteWriter writer;
            const RowBand rows = slab_of(here.rows, static_cast<std::int32_t>(k));
            std::vector<RegionRun> runs;
            for (std::int32_t row = rows.begin; row < rows.end; ++row) {
                runs.clear();
                const auto cells = labels.row(row - unit.seen.row)
                                       .subspan(static_cast<std::size_t>(own.col - unit.seen.col),
                                                static_cast<std::size_t>(own.cols));
                const std::int32_t first = own.col - window_.col;
                for_equal_runs(cells, [&](std::int32_t begin, std::int32_t end, Label label) {
                    runs.push_back({first + begin, first + end, label + more});
                });
                writer.put(static_cast<std::uint32_t>(runs.size()));
                writer.put_bytes(std::as_bytes(std::span(runs)));
            }
            return writer;
        },
        [&](std::size_t, const ByteWriter& writer) { slabs.push_back(d2b::append(*spool_, writer)); });
}

void LabelRows::read_slab(const SpoolEntry& entry, RowBand rows, LabelBand& band) const {
    ByteReader reader(*spool_, entry);
    for (std::int32_t row = rows.begin; row < rows.end; ++row) {
        const auto runs = reader.take<std::uint32_t>();
        const std::int32_t r = row - band.shape.first_row;
        if (r < 0 || r >= band.shape.rows) {
            (void)reader.take_bytes(runs * sizeof(RegionRun));
            continue;
        }
        const auto cells = band.labels.begin() + std::ptrdiff_t{r} * band.shape.cols;
        for (std::uint32_t i = 0; i < runs; ++i) {
            const auto run = reader.take<RegionRun>();
            std::fill(cells + run.begin, cells + run.end, number_[run.label]);
        }
    }
}

LabelBand LabelRows::band(const BandShape& shape) const {
    LabelBand band{shape, std::vector<Label>(shape.size())};
    const std::int32_t end = shape.first_row + shape.rows;
    for (const UnitRow& here : unit_rows_) {
        const std::int32_t first = std::max(shape.first_row, here.rows.begin) - here.rows.begin;
        const std::int32_t last = std::min(end, here.rows.end) - here.rows.begin;
        if (first >= last)
            continue;
        for (std::int32_t slab = first / slab_rows; slab <= (last - 1) / slab_rows; ++slab)
            for (const std::vector<SpoolEntry>& unit : here.units)
                read_slab(unit[static_cast<std::size_t>(slab)], slab_of(here.rows, slab), band);
    }
    return band;
}

Label UnitMerger::add(std::span<const SeenObject> objects) {
    const auto before = static_cast<Label>(seen_.size() - 1);
    std::unordered_map<Label, Label> first;  // label by whole
    for (const SeenObject& object : objects) {
        const Label label = sets_.add();
        wholes_.add();
        if (object.object.whole != 0)
            wholes_.join(first.try_emplace(object.object.whole, label).first->second, label);
        seen_.push_back(object);
    }
    return before;
}

void UnitMerger::compare(std::span<const Label> first, std::span<const Label> second) {
    std::map<std::pair<Label, Label>, std::int64_t> shared;
    std::map<Label, std::int64_t> cells;
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (const Label label : {first[i], second[i]})
            if (label != 0)
                ++cells[label];
        if (first[i] != 0 && second[i] != 0)
            ++shared[{first[i], second[i]}];
    }
    // Units may differ slightly, so a few shared cells do not make two neighbours the same object.
    for (const auto& [labels, n] : shared)
        if (2 * n >= std::min(cells[labels.first], cells[labels.second]))
            sets_.join(labels.first, labels.second);
}

std::unordered_map<Label, UnitMerger::Joined> UnitMerger::joined_sets() {
    std::unordered_map<Label, Joined> all;
    for (Label label = 1; label < seen_.size(); ++label) {
        const Label set = sets_.find(label);
        if (set == label)
            continue;  // the representative comes before the other members
        Joined& joined =
            all.try_emplace(set, Joined{set, seen_[set].own_cells, seen_[set].covered}).first->second;
        joined.cells += seen_[label].own_cells;
        joined.covered += seen_[label].covered;
        if (seen_[label].own_cells > seen_[joined.says].own_cells)
            joined.says = label;
    }
    return all;
}

void UnitMerger::count(const SeenObject& whole, Merged& merged) {
    if (!whole.is_building)
        ++merged.doubtful;
    else if (whole.object.left_out == LeftOut::denied)
        ++merged.denied;
    else if (whole.object.left_out == LeftOut::excluded)
        ++merged.excluded;
}

UnitMerger::Merged UnitMerger::finish(std::int64_t min_cells) {
    const std::unordered_map<Label, Joined> joined = joined_sets();
    const auto object = [&](Label set) {
        const auto known = joined.find(set);
        SeenObject merged = seen_[known == joined.end() ? set : known->second.says];
        merged.own_cells = merged.object.cells =
            known == joined.end() ? merged.own_cells : known->second.cells;
        merged.covered = known == joined.end() ? merged.covered : known->second.covered;
        return merged;
    };
    Merged merged;
    merged.objects.reserve(seen_.size() - 1);
    merged.number.assign(seen_.size(), 0);
    const auto keep = [&](Label set, const SeenObject& whole) {
        merged.objects.push_back(whole);
        merged.number[set] = static_cast<Label>(merged.objects.size());
    };
    for (const bool sure : {true, false}) {
        for (Label set = 1; set < seen_.size(); ++set) {
            if (sets_.find(set) != set)
                continue;
            const SeenObject whole = object(set);
            if (whole.is_building != sure || whole.own_cells < min_cells)
                continue;
            count(whole, merged);
            if (whole.object.left_out == LeftOut::no && !whole.is_covered())
                keep(set, whole);
        }
        if (sure)
            merged.buildings = static_cast<Label>(merged.objects.size());
    }
    for (Label label = 1; label < seen_.size(); ++label)
        merged.number[label] = merged.number[sets_.find(label)];
    name_wholes(merged);
    seen_ = {};
    return merged;
}

void UnitMerger::name_wholes(Merged& merged) {
    const std::vector<Label>& number = merged.number;
    merged.wholes.assign(number.size(), 0);
    for (Label label = 1; label < number.size(); ++label)
        wholes_.join(label, sets_.find(label));
    std::vector<Label> lowest(number.size(), 0);  // number by whole
    for (Label label = 1; label < number.size(); ++label) {
        merged.wholes[label] = wholes_.find(label);
        if (Label& of = lowest[merged.wholes[label]]; number[label] != 0)
            of = of == 0 ? number[label] : std::min(of, number[label]);
    }
    for (Label label = 1; label < number.size(); ++label)
        if (number[label] != 0)
            merged.objects[number[label] - 1].object.whole = lowest[merged.wholes[label]];
}

void UnitEdges::add(Label more) {
    for (Lines* lines : {&above, &left, &below, &right})
        for (std::vector<Label>& line : *lines)
            for (Label& label : line)
                label += label != 0 ? more : 0;
}

UnitEdges edges_of(const Unit& unit, const Grid<Label>& labels) {
    const Window own{unit.own.row - unit.seen.row, unit.own.col - unit.seen.col, unit.own.rows,
                     unit.own.cols};
    return {lines_at(labels, own, own.row, true), lines_at(labels, own, own.col, false),
            lines_at(labels, own, own.end_row(), true), lines_at(labels, own, own.end_col(), false)};
}

void UnitSeams::add(std::int32_t col, UnitEdges&& edges, UnitMerger& merger) {
    UnitEdges::Lines& above = above_[static_cast<std::size_t>(col)];
    compare(above, edges.above, merger);
    compare(left_, edges.left, merger);
    above = std::move(edges.below);
    left_ = std::move(edges.right);
}

}  // namespace d2b::detect
