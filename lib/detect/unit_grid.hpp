#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// A part of a window in which ground and buildings are looked for at a time. Rows and columns are those of
/// the whole raster.
struct Unit {
    Window own;   ///< what is said of these cells counts
    Window seen;  ///< and of these it is known that they are there
};

/// How a window is divided.
struct UnitSize {
    std::int64_t most_whole = std::int64_t{64} << 20;  ///< points of windows that are not divided
    std::int32_t most_side = 6144;                     ///< rows and columns that are a unit's own
};

/// The units of a window: one, or as few rows and columns of them as their size allows, about as large as
/// each other, so none that is divided off has less than half of the most rows or columns. They depend on the
/// shape of the window, its cells and `around`, and on nothing else: they are what a result is defined by.
class UnitGrid {
  public:
    /// @param around metres on all sides that a unit sees beside its own cells; 64 cells at least
    UnitGrid(const Window& window, const CellSize& cell, double around, const UnitSize& size = {});

    [[nodiscard]] std::int32_t rows() const { return down_.parts; }
    [[nodiscard]] std::int32_t cols() const { return across_.parts; }
    [[nodiscard]] std::int64_t count() const { return std::int64_t{rows()} * cols(); }
    [[nodiscard]] Unit unit(std::int32_t row, std::int32_t col) const;
    /// The most points that a unit sees.
    [[nodiscard]] std::int64_t most_seen() const;

  private:
    struct Stretch {
        std::int32_t first = 0;
        std::int32_t length = 0;
    };
    /// The rows, or the columns.
    struct Axis {
        Stretch window;
        std::int32_t parts = 1;
        std::int32_t around = 0;

        [[nodiscard]] Stretch own(std::int32_t part) const;
        [[nodiscard]] Stretch seen(std::int32_t part) const;
        [[nodiscard]] std::int32_t most_seen() const;
    };

    Axis down_;
    Axis across_;
};

}  // namespace d2b
