#include "elevations/elevation_cache.hpp"

#include <algorithm>
#include <limits>

namespace d2b {

void CellDecisions::append(const Cells& cells) {
    SpoolEntry& entry = bands_.emplace_back();
    if (cells.invalid.empty() && cells.spires.empty())
        return;
    ByteWriter writer;
    writer.put_list(cells.invalid);
    writer.put_list(cells.spires);
    entry = d2b::append(*spool_, writer);
}

std::vector<std::size_t> CellDecisions::invalid(std::size_t band) const {
    if (!has(band))
        return {};
    return ByteReader(*spool_, bands_[band]).take_list<std::size_t>();
}

void CellDecisions::apply(std::size_t band, std::int32_t cols, const Window& part,
                          ElevationBand& cells) const {
    if (!has(band))
        return;
    const auto in_part = [&](const std::vector<std::size_t>& of_band) {
        std::vector<std::size_t> found;
        for (const std::size_t cell : of_band) {
            const std::int64_t row = static_cast<std::int64_t>(cell) / cols - part.row;
            const std::int64_t col = static_cast<std::int64_t>(cell) % cols - part.col;
            if (row >= 0 && row < part.rows && col >= 0 && col < part.cols)
                found.push_back(static_cast<std::size_t>(row * part.cols + col));
        }
        return found;
    };
    ByteReader reader(*spool_, bands_[band]);
    for (const std::size_t cell : in_part(reader.take_list<std::size_t>()))
        cells.elevations[cell] = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t cell : in_part(reader.take_list<std::size_t>()))
        cells.spires.push_back(cell);
}

namespace {

template <typename T>
void append_part(const T* band, std::int32_t cols, const Window& part, std::vector<double>& to) {
    const bool whole_rows = part.cols == cols;
    const std::int64_t length = whole_rows ? part.points() : part.cols;
    for (std::int32_t row = part.row; row < (whole_rows ? part.row + 1 : part.end_row()); ++row) {
        const T* const from = band + std::ptrdiff_t{row} * cols + part.col;
        to.insert(to.end(), from, from + length);
    }
}

/// Converts to floats. Branch-free, so that the loop vectorises.
/// @return true if the conversion is exact
D2B_MULTIVERSION bool narrowed(std::span<const double> values, float* narrow) {
    int lost = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double z = values[i];
        narrow[i] = static_cast<float>(z);
        const bool same = static_cast<double>(narrow[i]) == z;
        const bool known = z == z;
        lost |= (same ? 0 : 1) & (known ? 1 : 0);
    }
    return lost == 0;
}

}  // namespace

ElevationCache::ElevationCache(const Window& window, std::size_t most_bytes)
    : window_(window),
      most_bytes_(most_bytes),
      fits_(static_cast<std::size_t>(window.points()) <= most_bytes / sizeof(float)) {}

void ElevationCache::begin(std::size_t bands, Executor& threads) {
    bytes_ = 0;
    wide_.assign(bands, {});
    floats_ = {};
    floats_ = MetreGrid::unset(window_.rows, window_.cols,
                               threads);  // pages are only allocated when they are written
}

std::vector<double> ElevationCache::keep(const ElevationBand& band) {
    const std::int32_t first = band.shape.first_row - window_.row;
    for (std::int32_t row = 0; row < band.shape.rows; ++row)
        if (!narrowed(band.row(row), floats_.row(first + row).data()))
            return band.elevations;
    return {};
}

void ElevationCache::put(std::size_t i, const BandShape& band, std::vector<double>&& wide) {
    if (!fits_)
        return;
    bytes_ += wide.empty() ? band.size() * sizeof(float) : wide.size() * sizeof(double);
    wide_[i] = std::move(wide);
    if (bytes_ <= most_bytes_)
        return;
    fits_ = false;                               // other threads may still write floats
    wide_ = std::vector<std::vector<double>>();  // {} would keep the capacity
}

void ElevationCache::end() {
    complete_ = fits_;
    if (!complete_)
        floats_ = {};
}

void ElevationCache::append(std::size_t i, const BandShape& band, const Window& part,
                            std::vector<double>& to) const {
    if (wide_[i].empty())
        append_part(floats_.row(band.first_row - window_.row).data(), band.cols, part, to);
    else
        append_part(wide_[i].data(), band.cols, part, to);
}

void ElevationCache::set_invalid(std::size_t i, const BandShape& band, std::span<const std::size_t> cells) {
    if (!wide_[i].empty())
        return;
    float* const first = floats_.row(band.first_row - window_.row).data();
    for (const std::size_t cell : cells)
        first[cell] = std::numeric_limits<float>::quiet_NaN();
}

MetreGrid ElevationCache::lend() {
    const auto narrow = [](const std::vector<double>& wide) { return wide.empty(); };
    if (!complete_ || !std::ranges::all_of(wide_, narrow))
        return {};
    return std::exchange(floats_, {});
}

}  // namespace d2b
