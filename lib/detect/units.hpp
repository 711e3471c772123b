#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/disjoint_sets.hpp"
#include "core/executor.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/spool.hpp"
#include "detect/detection.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

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
    struct Interval {
        std::int32_t first = 0;
        std::int32_t length = 0;
    };
    /// Division of the rows, or of the columns.
    struct Axis {
        Interval window;
        std::int32_t parts = 1;
        std::int32_t around = 0;

        [[nodiscard]] Interval own(std::int32_t part) const;
        [[nodiscard]] Interval seen(std::int32_t part) const;
        [[nodiscard]] std::int32_t most_seen() const;
    };

    Axis down_;
    Axis across_;
};

/// Labels of a window, spooled to disk unit by unit as runs: 12 bytes per run and 4 bytes per row of a unit.
class LabelRows {
  public:
    LabelRows() = default;
    /// @param window extent of the labels
    LabelRows(std::unique_ptr<Spool> spool, const Window& window)
        : spool_(std::move(spool)), window_(window) {}

    /// Appends the core cells of the next unit. Units come row by row.
    /// @param labels labels of the unit's extent
    /// @param more offset added to labels other than 0
    void append(const Unit& unit, const Grid<Label>& labels, Executor& threads, Label more = 0);
    /// Relabels all units.
    /// @param number new label by old label
    void renumber(std::vector<Label> number) { number_ = std::move(number); }

    /// Reads the labels of a band of the window. Callable from any thread after the last append().
    /// @throws OutputError if the spool cannot be read
    [[nodiscard]] LabelBand band(const BandShape& shape) const;

  private:
    /// Row of adjacent units.
    struct UnitRow {
        RowBand rows;                                ///< rows of the whole raster
        std::vector<std::vector<SpoolEntry>> units;  ///< spool entries per unit, one per slab of rows
    };
    void read_slab(const SpoolEntry& entry, RowBand rows, LabelBand& band) const;

    std::unique_ptr<Spool> spool_;
    Window window_;
    std::vector<UnitRow> unit_rows_;
    std::vector<Label> number_;
};

/// Object as detected in one unit of a window.
struct SeenObject {
    DetectedObject object;
    bool is_building = false;
    double ground = 0;           ///< elevation in m; NaN if unknown
    std::int64_t own_cells = 0;  ///< its cells within the core of the unit
    std::int64_t covered = 0;    ///< number of these that lie in given footprints

    /// True if footprints cover half of it or more.
    [[nodiscard]] bool is_covered() const { return covered > 0 && 2 * covered >= own_cells; }
};

/// Merges the objects of overlapping units. The extent of a unit exceeds its core, so that two units detect
/// the same objects on both sides of their seam: objects that cover the same cells there are one object, and
/// the unit with most of it in its core provides its attributes (the first unit in case of a tie). Objects
/// that a unit divided from one whole belong together, and so do their counterparts in other units.
class UnitMerger {
  public:
    /// Adds the objects of the next unit.
    /// @param objects objects by label - 1
    /// @return offset for its labels other than 0
    Label add(std::span<const SeenObject> objects);
    /// Compares a line of cells next to a seam, as labelled by the units on both sides. Labels include the
    /// offsets of the units.
    void compare(std::span<const Label> first, std::span<const Label> second);

    struct Merged {
        /// Those that footprints do not cover: buildings first, then doubtful ones. DetectedObject::whole is
        /// the lowest number of those that belong together.
        std::vector<SeenObject> objects;
        Label buildings = 0;
        std::int64_t doubtful = 0;  ///< doubtful objects, including those that are left out
        std::int64_t excluded = 0;  ///< buildings with LeftOut::excluded, which are not among the objects
        std::int64_t denied = 0;    ///< likewise
        std::vector<Label> number;  ///< index in `objects` plus one, by label with offset; 0: dropped
        std::vector<Label> wholes;  ///< lowest label of those that belong together, dropped or not, by label
    };
    /// Call once: clears the objects.
    /// @param min_cells smaller objects are dropped: slivers on the far side of a seam
    [[nodiscard]] Merged finish(std::int64_t min_cells);

  private:
    /// Object detected by several units.
    struct Joined {
        Label says = 0;  ///< label that provides its attributes
        std::int64_t cells = 0;
        std::int64_t covered = 0;
    };
    /// Returns the sets with more than one label, by their representative. They are few, because few objects
    /// touch a seam.
    [[nodiscard]] std::unordered_map<Label, Joined> joined_sets();

    static void count(const SeenObject& whole, Merged& merged);
    /// @param merged with objects and numbers
    void name_wholes(Merged& merged);

    DisjointSets sets_{1};            ///< of labels; 0 is none
    DisjointSets wholes_{1};          ///< sets of labels that belong together
    std::deque<SeenObject> seen_{1};  ///< by label; a deque, because there may be very many
};

/// Labels that a unit assigned along its seams, next to its core.
struct UnitEdges {
    /// Cells on both sides of a seam, the upper or left ones first; empty at the border of the window.
    using Lines = std::array<std::vector<Label>, 2>;

    Lines above;
    Lines left;
    Lines below;
    Lines right;

    /// Adds an offset to all labels other than 0.
    void add(Label more);
};
/// @param labels labels of the unit's extent
[[nodiscard]] UnitEdges edges_of(const Unit& unit, const Grid<Label>& labels);

/// Compares the labels of adjacent units along their seams. Units come row by row, and the edges of one are
/// kept until the unit on the other side arrives.
class UnitSeams {
  public:
    /// @param unit_cols number of units in a row
    explicit UnitSeams(std::int32_t unit_cols) : above_(static_cast<std::size_t>(unit_cols)) {}

    /// @param edges edges of the next unit, with labels that include its offset
    /// @param col column of the unit
    void add(std::int32_t col, UnitEdges&& edges, UnitMerger& merger);

  private:
    std::vector<UnitEdges::Lines>
        above_;              ///< by column: edges at the seam below the latest unit of that column
    UnitEdges::Lines left_;  ///< edges at the seam to the right of the previous unit
};

}  // namespace d2b::detect
