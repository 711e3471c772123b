#include "pipeline/seen_surface.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

MetreGrid read_surface(ElevationReader& reader, const Window& seen, double metres, Executor& threads) {
    MetreGrid surface = MetreGrid::unset(seen.rows, seen.cols, threads);
    reader.for_part(seen, [&](const ElevationBand& band) {
        std::ranges::transform(band.elevations, surface.row(band.shape.first_row - seen.row).data(),
                               [&](double z) { return static_cast<float>(z * metres); });
    });
    return surface;
}

}  // namespace

SeenSurface::SeenSurface(ElevationReader& reader, const Window& seen, double metres, Executor& threads)
    : reader_(reader) {
    if (metres == 1)
        elevations_ = reader.lend(seen);
    lent_ = elevations_.size() > 0;
    if (!lent_)
        elevations_ = read_surface(reader, seen, metres, threads);
}

SeenSurface::~SeenSurface() {
    if (!lent_)
        return;
    for (const TakenOut& taken : taken_out_)
        elevations_.values[taken.cell] = taken.elevation;
    reader_.take_back(std::move(elevations_));
}

void SeenSurface::take_out(const Grid<std::uint8_t>& flags, std::uint8_t flag, Executor& threads) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    std::mutex mutex;
    for_cells(threads, flags, [&](std::size_t begin, std::size_t end) {
        std::vector<TakenOut> here;
        for (std::size_t i = begin; i < end; ++i)
            if ((flags.values[i] & flag) != 0)
                here.push_back({i, std::exchange(elevations_.values[i], unknown)});
        const std::lock_guard lock(mutex);
        taken_out_.insert(taken_out_.end(), here.begin(), here.end());
    });
}

}  // namespace d2b
