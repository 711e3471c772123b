#include "detect/label_rows.hpp"

#include <algorithm>
#include <cstddef>

#include "core/byte_record.hpp"
#include "core/equal_runs.hpp"

namespace d2b {
namespace {

constexpr std::int32_t slab_rows = 16;

std::int32_t slabs_of(RowBand rows) {
    return (rows.end - rows.begin - 1) / slab_rows + 1;
}
RowBand slab_of(RowBand rows, std::int32_t slab) {
    const std::int32_t begin = rows.begin + slab * slab_rows;
    return {begin, std::min(begin + slab_rows, rows.end)};
}

}  // namespace

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
            std::vector<Run> runs;
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
            (void)reader.take_bytes(runs * sizeof(Run));
            continue;
        }
        const auto cells = band.labels.begin() + std::ptrdiff_t{r} * band.shape.cols;
        for (std::uint32_t i = 0; i < runs; ++i) {
            const Run run = reader.take<Run>();
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

}  // namespace d2b
