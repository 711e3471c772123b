#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"

namespace d2b {

/// How far above the highest of its eight neighbours a cell is no elevation, and no roof. In vertical units.
struct SpikeRules {
    double no_elevation = std::numeric_limits<double>::infinity();
    double no_roof = std::numeric_limits<double>::infinity();
};
/// In metres. No wall is one cell wide and 100 m high; masts, cranes and birds in flight may be 30.
inline constexpr SpikeRules spikes_m{100, 30};

/// Cells of a row, side by side.
struct Stretch {
    std::int32_t row = 0;    ///< of the band
    std::int32_t begin = 0;  ///< columns
    std::int32_t end = 0;
};

/// A cell that is above those of its neighbours that have been looked at.
struct Spike {
    std::int32_t row = 0;  ///< of the band
    std::int32_t col = 0;
    double elevation = 0;
    double around =
        -std::numeric_limits<double>::infinity();  ///< the highest of them; -infinity: none is valid

    /// Looks at the row above or below the one that it is in.
    void see(std::span<const double> other);
    [[nodiscard]] bool above(double by) const { return elevation - around > by; }
    [[nodiscard]] bool stands_alone() const { return around == -std::numeric_limits<double>::infinity(); }
};

/// The cells that are no roof by what the band shows: of its first and last row they may turn out to be none
/// when the rows beyond are seen. In scan order.
/// @param steep where to look; beside it no cell is a spike
[[nodiscard]] std::vector<Spike> find_spikes(const ElevationBand& band, std::span<const Stretch> steep,
                                             const SpikeRules& rules);

/// Brings together spikes and the rows beyond the bands that they are in, while bands pass from the first to
/// the last.
class SpikeSeams {
  public:
    /// @param spikes of the band, which is the next
    /// @return those of the band before, all of whose neighbours have been seen now
    [[nodiscard]] std::vector<Spike> add(const ElevationBand& band, std::vector<Spike> spikes);
    /// @return those of the last band
    [[nodiscard]] std::vector<Spike> finish() { return std::move(waiting_); }

  private:
    std::vector<Spike> waiting_;
    std::int32_t last_ = 0;         ///< row of their band
    std::vector<double> last_row_;  ///< its elevations
};

}  // namespace d2b
