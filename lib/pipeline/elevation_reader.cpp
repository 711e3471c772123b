#include "pipeline/elevation_reader.hpp"

#include <algorithm>

#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

// Some 4 MiB of elevations, in whole multiples of the usual block heights.
constexpr std::int64_t points_a_band = 1 << 19;
constexpr std::int32_t block_rows = 64;

std::int32_t band_rows(std::int32_t cols) {
    const std::int64_t rows = points_a_band / std::max(cols, 1) / block_rows * block_rows;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(rows, block_rows, 1 << 16));
}

}  // namespace

ElevationReader::ElevationReader(DemSource& source, Context& context, std::size_t keep_bytes)
    : source_(source), context_(context), rows_a_band_(band_rows(source.info().window.cols)) {
    const Window& window = source.info().window;
    const std::size_t points = static_cast<std::size_t>(window.rows) * static_cast<std::size_t>(window.cols);
    keep_ = points <= keep_bytes / sizeof(double);
}

void ElevationReader::for_each(const std::function<void(const ElevationBand&)>& use) {
    if (complete_) {
        for (const ElevationBand& band : kept_)
            use(band);
        return;
    }
    kept_.clear();
    const Window& window = source_.info().window;
    const std::int32_t end = window.row + window.rows;
    for (std::int32_t row = window.row; row < end;) {
        const std::int64_t border = (std::int64_t{row} / rows_a_band_ + 1) * rows_a_band_;
        const auto next = static_cast<std::int32_t>(std::min<std::int64_t>(end, border));
        ElevationBand band{{row, next - row, window.cols}, {}};
        band.elevations.resize(band.shape.size());
        {
            const StageClock clock(context_.report, Stage::read);
            source_.read(row, band.shape.rows, band.elevations);
        }
        use(band);
        if (keep_)
            kept_.push_back(std::move(band));
        row = next;
    }
    complete_ = keep_;
}

}  // namespace d2b
