#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/band.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// The bands of a window between one pass and the next, where they fit in memory: as floats where nothing is
/// lost by it, else as they are.
class KeptElevations {
  public:
    /// @param most_bytes of memory; bands that need more are not kept
    KeptElevations(const Window& window, std::size_t most_bytes);

    /// Whether the next pass is to keep its bands.
    [[nodiscard]] bool wanted() const { return fits_ && !complete_; }
    /// Whether all bands are kept.
    [[nodiscard]] bool complete() const { return complete_; }

    /// What is kept: the next pass is to keep its bands anew, where they fit.
    void forget() { complete_ = false; }
    void begin(std::size_t bands, Executor& threads);
    /// Keeps a band as floats, on any thread. @return what is to be put else; empty: nothing
    [[nodiscard]] std::vector<double> keep(const ElevationBand& band);
    /// One band after the other, when it is kept. @param i the band's number @param wide what keep() returned
    void put(std::size_t i, const BandShape& band, std::vector<double>&& wide);
    void end();

    /// Adds some cells of a band to others. @param part rows and columns counted from the band's first
    void append(std::size_t i, const BandShape& band, const Window& part, std::vector<double>& to) const;
    /// What is kept as floats is no elevation. @param cells of a band, counted from its first
    void take_out(std::size_t i, const BandShape& band, std::span<const std::size_t> cells);

    /// All of it, where floats hold it; else nothing. Until it is taken back, nothing else may be asked for.
    [[nodiscard]] MetreGrid lend();
    void take_back(MetreGrid&& lent) { floats_ = std::move(lent); }

  private:
    Window window_;
    std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    bool fits_;
    bool complete_ = false;
    MetreGrid floats_;                       ///< of the window: kept bands, but for those that are wide
    std::vector<std::vector<double>> wide_;  ///< by band: kept as they are; empty where floats hold them
};

}  // namespace d2b
