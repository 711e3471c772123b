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

void BandCells::apply(std::size_t band, std::int32_t first, ElevationBand& part) const {
    if (band >= bands_.size() || bands_[band].place.size == 0)
        return;
    const Entry& entry = bands_[band];
    const std::size_t begin = static_cast<std::size_t>(first) * static_cast<std::size_t>(part.shape.cols);
    ByteReader reader(*spool_, entry.place);
    for (std::size_t i = 0; i < entry.place.size / sizeof(std::size_t); ++i) {
        const std::size_t cell = reader.take<std::size_t>() - begin;  // beyond all where it is above the part
        if (cell >= part.elevations.size())
            continue;
        if (i < entry.invalid)
            part.elevations[cell] = std::numeric_limits<double>::quiet_NaN();
        else
            part.spires.push_back(cell);
    }
}

}  // namespace d2b
