#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/value_counts.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Values that mark missing data without being declared as NoData: many cells share exactly this value, they
/// reach the edge of the raster, and all neighbours differ by a step. Each comes with its number of cells in
/// regions at the edge.
struct UndeclaredValues {
    std::vector<SharedValue> taken;  ///< treated as NoData: at least a tenth of the cells
    std::vector<SharedValue> named;  ///< at least a hundredth: kept as elevations, with a warning

    [[nodiscard]] bool none() const { return taken.empty() && named.empty(); }
    /// Returns the values that are treated as NoData.
    [[nodiscard]] std::vector<double> values() const;
};

/// Outermost cells of a window; NaN if they are not valid.
struct BorderCells {
    std::vector<double> top;
    std::vector<double> bottom;
    std::vector<double> left;   ///< first row first
    std::vector<double> right;  ///< first row first
};

/// Thresholds for detecting undeclared NoData.
struct UndeclaredRules {
    /// Smallest step, in m, because a lower one is not a wall, and buildings do not rise that little above
    /// their surroundings.
    static constexpr double step_m = 2;

    double step = step_m;  ///< smallest step in units of the values
    /// Smallest breadth in cells of the regions that the value surrounds, which must be wider than buildings:
    /// in a plain model with exactly equal elevations only the houses differ. 0 if nothing stands on the
    /// surface.
    double least_breadth = 0;
};

/// Returns the problem as a clause without a full stop: "12 cells of 'dem.tif' have the elevation 0, lie at
/// its edge, and all around is at least 2 m higher or lower".
[[nodiscard]] std::string undeclared_text(const SharedValue& value, const std::string& raster);

/// Reads the values of a part of the window; NaN if not valid.
using ReadValues = std::function<void(const Window&, std::span<double>)>;

/// Reads the outermost cells of a window.
[[nodiscard]] BorderCells read_border(const Window& window, const ReadValues& read);

/// Returns values that may be undeclared NoData, judged by the border alone; most rasters have none. At most
/// the eight most frequent ones.
[[nodiscard]] std::vector<double> border_candidates(const BorderCells& border, double step);

/// Reads the whole window, if the border has candidates, and checks them by the connected regions of their
/// cells. @param border of the window
[[nodiscard]] UndeclaredValues find_undeclared(const Window& window, const BorderCells& border,
                                               const UndeclaredRules& rules, const ReadValues& read);

}  // namespace d2b
