#include "detect/label_rows.hpp"

#include <algorithm>
#include <cstddef>

#include "core/byte_record.hpp"

namespace d2b {

void LabelRows::append(const Grid<Label>& labels, RowBand rows, Executor& threads) {
    constexpr std::int32_t rows_at_once = 64;
    const std::int32_t count = rows.end - rows.begin;
    threads.in_order(
        static_cast<std::size_t>((count + rows_at_once - 1) / rows_at_once),
        [&](std::size_t k, std::size_t) {
            std::vector<ByteWriter> writers;
            const std::int32_t begin = rows.begin + static_cast<std::int32_t>(k) * rows_at_once;
            for (std::int32_t r = begin; r < std::min(begin + rows_at_once, rows.end); ++r)
                for_label_runs(labels.row(r), [writer = &writers.emplace_back()](
                                                  std::int32_t from, std::int32_t to, Label label) {
                    writer->put(Run{from, to, label});
                });
            return writers;
        },
        [&](std::size_t, const std::vector<ByteWriter>& writers) {
            for (const ByteWriter& writer : writers)
                rows_.push_back(d2b::append(*spool_, writer));
        });
}

void LabelRows::read(std::int32_t row, std::int32_t cols, std::span<Label> labels) const {
    std::ranges::fill(labels, 0);
    for (std::size_t first = 0; first < labels.size(); first += static_cast<std::size_t>(cols), ++row) {
        const SpoolEntry entry = rows_[static_cast<std::size_t>(row)];
        ByteReader reader(*spool_, entry);
        for (std::size_t i = 0; i < entry.size / sizeof(Run); ++i) {
            const Run run = reader.take<Run>();
            std::fill(labels.begin() + static_cast<std::ptrdiff_t>(first) + run.begin,
                      labels.begin() + static_cast<std::ptrdiff_t>(first) + run.end, number_[run.label]);
        }
    }
}

LabelBand LabelRows::band(const BandShape& shape, std::int32_t window_row) const {
    LabelBand band{shape, std::vector<Label>(shape.size())};
    read(shape.first_row - window_row, shape.cols, band.labels);
    return band;
}

}  // namespace d2b
