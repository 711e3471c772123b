#pragma once

#include <cstdint>

#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Block of a window that is processed at once, as windows of the whole raster: a core, and an extent that
/// adds a halo to it.
struct Unit {
    Window own;   ///< the core: results for these cells are used
    Window seen;  ///< the core and its halo: cells that are read
};

/// Limits for dividing a window.
struct UnitSize {
    std::int64_t most_whole = std::int64_t{64} << 20;  ///< points of windows that are not divided
    std::int32_t most_side = 6144;                     ///< rows and columns of the core
};

/// Regular division of a window into units: a single one, or as few rows and columns as their size allows, of
/// nearly equal size, so that no unit is smaller than half of the limit. The division only depends on the
/// shape of the window, its cells and `around`, because it is part of the definition of a result.
class UnitGrid {
  public:
    /// @param around width of the halo in m; at least 64 cells
    UnitGrid(const Window& window, const CellSize& cell, double around, const UnitSize& size = {});

    [[nodiscard]] std::int32_t rows() const { return down_.parts; }
    [[nodiscard]] std::int32_t cols() const { return across_.parts; }
    [[nodiscard]] std::int64_t count() const { return std::int64_t{rows()} * cols(); }
    [[nodiscard]] Unit unit(std::int32_t row, std::int32_t col) const;
    /// Maximum number of points in the extent of a unit.
    [[nodiscard]] std::int64_t most_seen() const;

  private:
    struct Stretch {
        std::int32_t first = 0;
        std::int32_t length = 0;
    };
    /// Division of the rows, or of the columns.
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
