#include "elevations/band_cells.hpp"

#include <limits>
#include <span>

namespace d2b {

void BandCells::append(const Cells& cells) {
    Entry& entry = bands_.emplace_back();
    if (cells.invalid.empty() && cells.spires.empty())
        return;
    ByteWriter writer;
    writer.put_bytes(std::as_bytes(std::span(cells.invalid)));
    writer.put_bytes(std::as_bytes(std::span(cells.spires)));
    entry = {d2b::append(*spool_, writer), cells.invalid.size()};
}

std::vector<std::size_t> BandCells::invalid(std::size_t band) const {
    std::vector<std::size_t> cells;
    if (band >= bands_.size() || bands_[band].invalid == 0)
        return cells;
    ByteReader reader(*spool_, bands_[band].place);
    for (std::size_t i = 0; i < bands_[band].invalid; ++i)
        cells.push_back(reader.take<std::size_t>());
    return cells;
}

void BandCells::apply(std::size_t band, std::int32_t cols, const Window& part, ElevationBand& cells) const {
    if (band >= bands_.size() || bands_[band].place.size == 0)
        return;
    const Entry& entry = bands_[band];
    ByteReader reader(*spool_, entry.place);
    for (std::size_t i = 0; i < entry.place.size / sizeof(std::size_t); ++i) {
        const auto cell = static_cast<std::int64_t>(reader.take<std::size_t>());
        const std::int64_t row = cell / cols - part.row;
        const std::int64_t col = cell % cols - part.col;
        if (row < 0 || row >= part.rows || col < 0 || col >= part.cols)
            continue;
        const auto at = static_cast<std::size_t>(row * part.cols + col);
        if (i < entry.invalid)
            cells.elevations[at] = std::numeric_limits<double>::quiet_NaN();
        else
            cells.spires.push_back(at);
    }
}

}  // namespace d2b
