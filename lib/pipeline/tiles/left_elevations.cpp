#include "pipeline/tiles/left_elevations.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace d2b {

void LeftElevations::add(const LeftCells& cells) {
    std::map<LatticePoint, ByteWriter> parts;
    auto next = cells.elevations.begin();
    for (const RowSpan& run : cells.runs)
        for (std::int32_t begin = run.begin; begin < run.end;) {
            const std::int32_t block_col = begin - begin % block_cols;
            const RowSpan part{run.row, begin, std::min(run.end, block_col + block_cols)};
            ByteWriter& writer = parts[{run.row - run.row % block_rows, block_col}];
            writer.put(part);
            for (; begin < part.end; ++begin)
                writer.put(*next++);
        }
    for (const auto& [block, writer] : parts)
        blocks_[block].push_back(append(*spool_, writer));
}

StackError LeftElevations::error(const DrawnStack& stack, const Window& window,
                                 const FixedPoint& fixed) const {
    StackError error;
    for (const auto& [first, entries] : blocks_) {
        const std::int32_t row = std::max(first.row, window.row);
        const std::int32_t col = std::max(first.col, window.col);
        ElevationBand band{{row, std::min(first.row + block_rows, window.end_row()) - row,
                            std::min(first.col + block_cols, window.end_col()) - col},
                           {}};
        if (band.shape.rows <= 0 || band.shape.cols <= 0)
            continue;
        band.elevations.assign(band.shape.size(), std::numeric_limits<double>::quiet_NaN());
        for (const SpoolEntry& entry : entries) {
            ByteReader reader(*spool_, entry);
            while (reader.left() > 0) {
                const auto run = reader.take<RowSpan>();
                for (std::int32_t c = run.begin; c < run.end; ++c) {
                    const auto z = reader.take<double>();
                    if (window.holds(run.row, c))
                        band.elevations[static_cast<std::size_t>(run.row - row) *
                                            static_cast<std::size_t>(band.shape.cols) +
                                        static_cast<std::size_t>(c - col)] = z;
                }
            }
        }
        error.merge(stack.error(band, col - window.col, fixed));
    }
    return error;
}

}  // namespace d2b
