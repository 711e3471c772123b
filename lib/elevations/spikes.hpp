#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"

namespace d2b {

/// Heights above the highest of its eight neighbours from which a cell is not an elevation, or not a roof. In
/// vertical units.
struct SpikeRules {
    double no_elevation = std::numeric_limits<double>::infinity();
    double no_roof = std::numeric_limits<double>::infinity();
};
/// Rules in m. No wall is one cell wide and 100 m high; masts, cranes and birds may reach 30 m.
inline constexpr SpikeRules spikes_m{100, 30};

/// Run of adjacent cells in a row.
struct Stretch {
    std::int32_t row = 0;    ///< row of the band
    std::int32_t begin = 0;  ///< first column
    std::int32_t end = 0;
};

/// Cell that exceeds its neighbours read so far.
struct Spike {
    std::int32_t row = 0;  ///< row of the band
    std::int32_t col = 0;
    double elevation = 0;
    double around =
        -std::numeric_limits<double>::infinity();  ///< its highest neighbour; -infinity: none is valid

    /// Compares with the row above or below.
    void see(std::span<const double> other);
    [[nodiscard]] bool above(double by) const { return elevation - around > by; }
    [[nodiscard]] bool stands_alone() const { return around == -std::numeric_limits<double>::infinity(); }
};

/// Finds the cells that are too high for a roof compared to the band. Spikes in the first and last row are
/// provisional until the adjacent rows are read. In scan order.
/// @param steep stretches to search; cells elsewhere are not spikes
[[nodiscard]] std::vector<Spike> find_spikes(const ElevationBand& band, std::span<const Stretch> steep,
                                             const SpikeRules& rules);

/// Compares spikes with the rows beyond their band while bands pass from the first to the last.
class SpikeSeams {
  public:
    /// @param spikes spikes of the band, which is the next one
    /// @return spikes of the previous band, compared with all their neighbours
    [[nodiscard]] std::vector<Spike> add(const ElevationBand& band, std::vector<Spike> spikes);
    /// @return spikes of the last band
    [[nodiscard]] std::vector<Spike> finish() { return std::move(waiting_); }

  private:
    std::vector<Spike> waiting_;
    std::int32_t last_ = 0;         ///< last row of their band
    std::vector<double> last_row_;  ///< its elevations
};

}  // namespace d2b
