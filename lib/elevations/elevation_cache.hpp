#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/byte_stream.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Pool of buffers for the elevations of bands. Reuse is faster, because the system clears newly allocated
/// pages, and vectors fill them with zeros again. Thread-safe.
class BufferPool {
  public:
    /// Returns a buffer with arbitrary length and contents.
    [[nodiscard]] std::vector<double> take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty())
            return {};
        std::vector<double> buffer = std::move(idle_.back());
        idle_.pop_back();
        return buffer;
    }
    void give(std::vector<double>&& buffer) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(buffer));
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        idle_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<std::vector<double>> idle_;
};

/// Single cells of bands with a decision that holds for the whole run, spooled to disk, because every fourth
/// cell of a raster of noise is one.
class CellDecisions {
  public:
    /// Indices into the elevations of a band, ascending.
    struct Cells {
        std::vector<std::size_t> invalid;
        std::vector<std::size_t> spires;
    };
    explicit CellDecisions(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// Appends the cells of the next band.
    /// @throws OutputError if there is no space
    void append(const Cells& cells);
    /// Sets invalid cells to NaN, and marks the spires; does nothing if the band has not been appended yet.
    /// Thread-safe.
    /// @param cols columns of the band
    /// @param part part of the window covered by `cells`; rows and columns relative to the band
    /// @throws OutputError
    void apply(std::size_t band, std::int32_t cols, const Window& part, ElevationBand& cells) const;

    /// Returns the indices of a band's invalid cells.
    /// @throws OutputError
    [[nodiscard]] std::vector<std::size_t> invalid(std::size_t band) const;

  private:
    [[nodiscard]] bool has(std::size_t band) const { return band < bands_.size() && bands_[band].size > 0; }

    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> bands_;  ///< empty if there are no such cells
};

/// Keeps the bands of a window between passes if they fit in memory: as floats if these are exact, otherwise
/// as doubles.
class ElevationCache {
  public:
    /// @param most_bytes memory limit; larger windows are not kept
    ElevationCache(const Window& window, std::size_t most_bytes);

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
    void set_invalid(std::size_t i, const BandShape& band, std::span<const std::size_t> cells);

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
