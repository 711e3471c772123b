#include "detect/label_rows.hpp"

#include <algorithm>
#include <cstddef>

#include "core/byte_record.hpp"

namespace d2b {

void LabelRows::append(std::span<const Label> labels) {
    ByteWriter writer;
    for (std::size_t begin = 0; begin < labels.size();) {
        const auto from = labels.begin() + static_cast<std::ptrdiff_t>(begin);
        const Label label = *from;
        const auto to = std::find_if(from, labels.end(), [label](Label other) { return other != label; });
        const auto end = static_cast<std::size_t>(to - labels.begin());
        if (label != 0)
            writer.put(Run{static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), label});
        begin = end;
    }
    rows_.push_back(d2b::append(*spool_, writer));
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

}  // namespace d2b
