#include "read/column_readers.hpp"

#include <algorithm>
#include <utility>

#include "dem2buildings/error.hpp"
#include "read/window.hpp"

namespace d2b {

ColumnReaders::ColumnReaders(OpenRaster raster, const ReadOptions& options, std::string path,
                             const DemInfo& info, Warnings& warnings, const std::vector<std::int32_t>& ends)
    : options_(options), path_(std::move(path)), info_(info), warnings_(warnings) {
    std::int32_t begin = 0;
    for (const std::int32_t end : ends) {
        Column& column = columns_.emplace_back();
        column.begin = std::exchange(begin, end);
        column.end = end;
    }
    columns_.front().reader = std::make_unique<RasterReader>(std::move(raster), options, info, warnings);
}

std::unique_ptr<RasterReader> ColumnReaders::reopen() const {
    try {
        Warnings unheard;  // repeats warnings of the first opening
        return std::make_unique<RasterReader>(open_raster(options_, path_, unheard), options_, info_,
                                              unheard);
    } catch (const Error&) {
        return nullptr;
    }
}

void ColumnReaders::read(const Window& part, std::span<double> elevations) {
    require_part(info_, part, elevations.size());
    std::vector<Column*> left;
    for (Column& column : columns_)
        if (column.begin < part.end_col() && part.col < column.end)
            left.push_back(&column);
    while (!left.empty()) {
        auto next = std::ranges::find_if(left, [](Column* column) { return column->at_work.try_lock(); });
        if (next == left.end()) {
            next = left.begin();
            (*next)->at_work.lock();
        }
        const std::unique_lock<std::mutex> lock((*next)->at_work, std::adopt_lock);
        read(**next, part, elevations);
        left.erase(next);
    }
}

/// Reads the part that lies in a column. The caller holds the lock of the column.
void ColumnReaders::read(Column& column, const Window& part, std::span<double> elevations) {
    if (!column.reader)
        column.reader = reopen();
    if (column.reader)
        return read(column, *column.reader, part, elevations);
    // Falls back on the first reader. A deadlock is impossible because a thread that holds the first column
    // waits for no other.
    const std::lock_guard lock(columns_.front().at_work);
    read(column, *columns_.front().reader, part, elevations);
}

void ColumnReaders::read(Column& column, RasterReader& reader, const Window& part,
                         std::span<double> elevations) {
    const std::int32_t col = std::max(part.col, column.begin);
    const Window here{part.row, col, part.rows, std::min(part.end_col(), column.end) - col};
    if (here.cols == part.cols)
        return reader.bands.read(here, elevations, warnings_);
    column.values.resize(static_cast<std::size_t>(here.points()));
    reader.bands.read(here, column.values, warnings_);
    for (std::int32_t row = 0; row < here.rows; ++row)
        std::copy_n(column.values.begin() + std::ptrdiff_t{row} * here.cols, here.cols,
                    elevations.begin() + (std::ptrdiff_t{row} * part.cols + (col - part.col)));
}

}  // namespace d2b
