#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/opening.hpp"
#include "ground/tiles.hpp"
#include "ground/whole_steps.hpp"

namespace d2b::ground {

/// Which structuring elements are opened with, and what rises too far above them.
struct StructuringElements {
    double radius = 1;         ///< of the next element, metres
    double last_radius = 1;    ///< of the widest
    double rise = 0;           ///< an object rises above the opened surface by this ...
    double slope = 0;          ///< ... and this times the radius
    double growth = 1.2;       ///< from an element to the next, but at least by a cell
    double border_reach = 14;  ///< elements reach as far into the grid at its border, or their whole radius
    double border_width = 0;   ///< as near the border of the grid ...
    double border_share = 1;   ///< ... an object rises by this share of that
};

/// A structuring element in cells.
struct Step {
    Radius radius;
    Radius outside;          ///< how far it reaches out of the grid
    float rise = 0;          ///< how far an object rises above the surface that it leaves
    Radius border = {0, 0};  ///< as near the border of the grid ...
    float border_rise = 0;   ///< ... it rises by this
};

/// The openings of a grid one after the other, by structuring elements on cells of one size.
struct OpeningSteps {
    std::vector<Step> steps;
    double next_radius = 0;  ///< of the element that would be next, metres
};
[[nodiscard]] OpeningSteps opening_steps(const StructuringElements& elements, const CellSize& cell);

/// A part of a grid without objects up to some width, and the height above which a cell was part of one;
/// `no_value` where it was of none. Kept from one part to the next, so that memory is asked for once.
struct OpenedPart {
    Tile tile;   ///< the part that was asked for
    Tile place;  ///< and what its elements see around it
    std::int32_t grid_rows = 0;
    std::int32_t grid_cols = 0;
    MetreGrid limits;       ///< of `tile`
    bool in_steps = false;  ///< `whole` has the surface, else `surface`
    WholeSteps whole;
    MetreGrid surface;  ///< of `place`, but right in `tile` alone
    MetreGrid next;
    Workspace<float> workspace;

    /// A row of the part of `surface`, or of another grid of `place`. @param i from the tile's first row
    template <typename T>
    [[nodiscard]] std::span<const T> row(const Grid<T>& grid, std::int32_t i) const {
        return grid.row(tile.row - place.row + i)
            .subspan(static_cast<std::size_t>(tile.col - place.col), static_cast<std::size_t>(tile.cols));
    }
    /// What is left of the surface, in metres. @param i from the tile's first row @param out of as many cells
    void write_row(std::int32_t i, float* out) const;
};

/// Progressive opening (SMRF): each element opens what the one before has left.
void open_part(const MetreGrid& surface, const Tile& tile, std::span<const Step> steps, Element element,
               OpenedPart& part);

/// The same for all cells, but elements of more than some ten cells are opened on blocks of 2 x 2 cells, and
/// so on: the cost a cell does not grow with the widest element. @return the limits
/// @param beside work for one thread alone that needs none of it: done once, while the others open
[[nodiscard]] MetreGrid limits_on_blocks(const AlignedGrid& surface, const StructuringElements& elements,
                                         Element element, Executor& threads,
                                         std::function<void()> beside = {});

/// A block's limit holds for its cells and, as walls do not run along blocks, for those of its neighbours,
/// but for what the ground may rise until there.
[[nodiscard]] MetreGrid with_neighbours_limits(const MetreGrid& limits, const CellSize& cell,
                                               Executor& threads);

}  // namespace d2b::ground
