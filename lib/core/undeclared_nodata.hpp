#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/invalid_elevations.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Cells beside missing ones whose values were blended with the value of these, so that many of them lie
/// beyond the range of land.
struct BlendedMargin {
    std::int32_t cells = 0;        ///< rows and columns beside missing cells; 0: nothing was blended
    std::vector<double> missing;   ///< values of missing cells that are not read as NaN
    std::optional<double> with{};  ///< value that was blended; nothing if it is unknown
    double lowest = 0;             ///< of land
    double highest = 0;

    [[nodiscard]] bool is_beyond(double value) const { return value < lowest || value > highest; }
};

/// Values that mark missing data without being declared as NoData: many cells share exactly this value, they
/// reach the edge of the raster, and all neighbours differ by a step. Each comes with its number of cells in
/// regions at the edge.
struct UndeclaredNodata {
    std::vector<SharedValue> taken;  ///< treated as NoData: at least a tenth of the cells
    std::vector<SharedValue> named;  ///< at least a hundredth: kept as elevations, with a warning

    /// Lowest elevation at the edge, because a lower plain would reach it, and a hole need not.
    std::optional<double> lowest_at_edge;
    BlendedMargin margin;  ///< treated as NoData

    [[nodiscard]] bool none() const { return taken.empty() && named.empty(); }
    /// Returns the values that are treated as NoData.
    [[nodiscard]] std::vector<double> values() const;
};

/// Outermost valid cells of a window, because a raster may be surrounded by declared NoData.
struct BorderCells {
    std::vector<double> top;     ///< first row with a valid cell; NaN if not valid
    std::vector<double> bottom;  ///< last row with a valid cell
    std::vector<double> left;    ///< of each row that has a valid cell
    std::vector<double> right;

    [[nodiscard]] std::array<const std::vector<double>*, 4> sides() const {
        return {&top, &bottom, &left, &right};
    }
    /// Adds rows below the others. @param row_at returns a row by its number from 0; NaN if not valid
    void add_rows(std::int32_t rows, const std::function<std::span<const double>(std::int32_t)>& row_at);
};

/// Thresholds for detecting undeclared NoData.
struct UndeclaredNodataRules {
    /// Smallest step, in m, because a lower one is not a wall, and buildings do not rise that little above
    /// their surroundings.
    static constexpr double step_m = 2;
    /// At least one of this many valid cells has a value that is named.
    static constexpr std::int64_t named_share = 100;

    double step = step_m;  ///< smallest step in units of the values
    /// Smallest breadth in cells of the regions that the value surrounds, which must be wider than buildings:
    /// in a plain model with exactly equal elevations only the houses differ. 0 if nothing stands on the
    /// surface.
    double min_breadth = 0;
};

/// Returns the problem as a clause without a full stop: "12 cells of 'dem.tif' have the elevation 0, lie at
/// its edge, and most cells around are at least 2 m higher or lower".
[[nodiscard]] std::string undeclared_text(const SharedValue& value, const std::string& raster);

/// Reads the values of a part of the window; NaN if not valid.
using ReadValues = std::function<void(const Window&, std::span<double>)>;

/// Reads the outermost cells of a window: all of it if some at its edge are not valid.
[[nodiscard]] BorderCells read_border(const Window& window, const ReadValues& read);

/// Returns values that may be undeclared NoData, judged by the border alone; most rasters have none. At most
/// the eight most frequent ones.
[[nodiscard]] std::vector<double> border_candidates(const BorderCells& border, double step);

/// Returns true if one of some values may have so many cells that it is named.
using AnyCommon = std::function<bool(const std::vector<double>&)>;

/// Reads the whole window, if the border has candidates, and checks them by the connected regions of their
/// cells. @param border of the window @param any_common if it is known; spares reading
[[nodiscard]] UndeclaredNodata find_undeclared_nodata(const Window& window, const BorderCells& border,
                                                      const UndeclaredNodataRules& rules,
                                                      const ReadValues& read,
                                                      const AnyCommon& any_common = {});

}  // namespace d2b
