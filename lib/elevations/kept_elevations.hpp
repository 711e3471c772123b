#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Keeps the bands of a window between passes if they fit in memory: as floats if these are exact, otherwise
/// as doubles.
class KeptElevations {
  public:
    /// @param most_bytes memory limit; larger windows are not kept
    KeptElevations(const Window& window, std::size_t most_bytes);

    /// True if the next pass should keep its bands.
    [[nodiscard]] bool wanted() const { return fits_ && !complete_; }
    /// True if all bands are kept.
    [[nodiscard]] bool complete() const { return complete_; }

    /// Discards the kept bands; the next pass keeps its bands if they fit.
    void forget() { complete_ = false; }
    void begin(std::size_t bands, Executor& threads);
    /// Keeps a band as floats. Thread-safe.
    /// @return the elevations to be passed to put() if floats are not exact; empty otherwise
    [[nodiscard]] std::vector<double> keep(const ElevationBand& band);
    /// Completes a band; called in order.
    /// @param i index of the band
    /// @param wide result of keep()
    void put(std::size_t i, const BandShape& band, std::vector<double>&& wide);
    void end();

    /// Appends a part of a band to a list.
    /// @param part rows and columns relative to the band
    void append(std::size_t i, const BandShape& band, const Window& part, std::vector<double>& to) const;
    /// Sets kept floats to NaN.
    /// @param cells indices relative to the band
    void take_out(std::size_t i, const BandShape& band, std::span<const std::size_t> cells);

    /// Lends the window if floats hold all of it; otherwise returns an empty grid. Request nothing until it
    /// is returned.
    [[nodiscard]] MetreGrid lend();
    void take_back(MetreGrid&& lent) { floats_ = std::move(lent); }

  private:
    Window window_;
    std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    bool fits_;
    bool complete_ = false;
    MetreGrid floats_;                       ///< the window: kept bands, except for those in wide_
    std::vector<std::vector<double>> wide_;  ///< by band: kept as doubles; empty if floats hold it
};

}  // namespace d2b
