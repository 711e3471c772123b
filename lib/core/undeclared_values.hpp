#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/value_counts.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Values of a raster that stand for no data without being declared: many cells share one to the bit, they
/// lie at the raster's edge, and everything else is a step away. Each with how many cells of it reach the
/// edge.
struct UndeclaredValues {
    std::vector<SharedValue> taken;  ///< for no data: at least a tenth of the cells have one
    std::vector<SharedValue> named;  ///< at least a hundredth: these stay elevations, and are warned of

    [[nodiscard]] bool none() const { return taken.empty() && named.empty(); }
    /// The values that are taken for no data.
    [[nodiscard]] std::vector<double> values() const;
};

/// The outermost cells of a window, NaN where they are not valid.
struct BorderCells {
    std::vector<double> top;
    std::vector<double> bottom;
    std::vector<double> left;   ///< from the first row to the last
    std::vector<double> right;  ///< likewise
};

/// When a value may stand for no data.
struct UndeclaredRules {
    /// A smaller step is no wall, and what lies so much higher than it is no building.
    static constexpr double step_m = 2;

    double step = step_m;  ///< in units of the values
    /// What the value surrounds must be wider than buildings are: of a plain whose elevations are equal to
    /// the bit, as of a model on a level ground, the houses are all else there is. Cells; 0 where nothing
    /// stands on the surface.
    double least_breadth = 0;
};

/// "12 cells of 'dem.tif' have the elevation 0, lie at its edge, and all around is at least 2 m higher or
/// lower": what is wrong with such a value, without a full stop.
[[nodiscard]] std::string undeclared_text(const SharedValue& value, const std::string& raster);

/// Gives the values of a part of the window, NaN where one is not valid.
using ReadValues = std::function<void(const Window&, std::span<double>)>;

/// Reads what lies along the edge of a window.
[[nodiscard]] BorderCells read_border(const Window& window, const ReadValues& read);

/// Values that may be undeclared NoData by what lies along the border alone: next to none does in most
/// rasters. At most eight, those that most cells of the border have.
[[nodiscard]] std::vector<double> border_candidates(const BorderCells& border, double step);

/// Reads all of a window, where the border has candidates, and judges them by the regions of their cells.
/// @param border of the window
[[nodiscard]] UndeclaredValues find_undeclared(const Window& window, const BorderCells& border,
                                               const UndeclaredRules& rules, const ReadValues& read);

}  // namespace d2b
