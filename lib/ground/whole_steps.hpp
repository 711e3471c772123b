#pragma once

#include <cstdint>
#include <span>

#include "ground/opening.hpp"
#include "ground/tiles.hpp"

namespace d2b::ground {

/// Elevations of a part of a grid that are whole centimetres or millimetres, as surveys deliver them, above
/// or below a base: openings only compare and move them, so they do it in half of the memory, with twice as
/// many at a time.
struct WholeSteps {
    Grid<std::int16_t> surface;  ///< `no_value_of` where there is none
    Grid<std::int16_t> next;
    Workspace<std::int16_t> workspace;
    std::int32_t base = 0;
    std::int32_t in_metre = 100;
    bool gaps = false;  ///< whether any cell has none, also where they are no whole steps

    /// @return whether `surface` now holds the elevations of a part of a grid, so that in_metres() gives the
    /// same bit by bit
    [[nodiscard]] bool take(const MetreGrid& metres, const Tile& place);
    void in_metres(std::span<const std::int16_t> values, float* metres) const;

    /// Steps by which one elevation may stand above another one and is surely no more than `rise` metres
    /// above it, however floats round. @param rise not negative
    [[nodiscard]] int surely_within(float rise) const;

  private:
    [[nodiscard]] bool take_near(float metre, const MetreGrid& metres, const Tile& place);
};

}  // namespace d2b::ground
