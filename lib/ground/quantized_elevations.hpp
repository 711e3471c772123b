#pragma once

#include <cstdint>
#include <span>

#include "ground/aligned_grid.hpp"
#include "raster/opening.hpp"

namespace d2b::ground {

/// Elevations of part of a grid as 16-bit integers relative to a base, if all are whole centimetres or
/// millimetres, as delivered by surveys. Openings only compare and copy values, so integers do it in half of
/// the memory with twice as many per vector instruction.
struct QuantizedElevations {
    Grid<std::int16_t> surface;  ///< `no_value_of` for cells without a value
    Grid<std::int16_t> next;
    Workspace<std::int16_t> workspace;
    std::int32_t base = 0;
    std::int32_t steps_per_metre = 100;
    bool gaps = false;  ///< true if any cell has no value, also if take() fails

    /// Converts part of a grid. @return true if `surface` now holds its elevations, so that to_metres()
    /// restores them bit by bit
    [[nodiscard]] bool take(const MetreGrid& metres, const Tile& place);
    void to_metres(std::span<const std::int16_t> values, float* metres) const;

    /// Returns the largest difference in steps that is certainly not more than `rise` metres, however floats
    /// round. @param rise not negative
    [[nodiscard]] int guaranteed_steps(float rise) const;

  private:
    [[nodiscard]] bool quantize_near(float metre, const MetreGrid& metres, const Tile& place);
};

}  // namespace d2b::ground
