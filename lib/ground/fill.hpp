#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ground/aligned_grid.hpp"

namespace d2b::ground {

/// The coarser levels of a grid whose gaps are filled. Kept from one filling to the next, so that memory is
/// asked for once.
struct Pyramid {
    std::vector<AlignedGrid> coarser;
    std::vector<Grid<std::uint8_t>> gaps;  ///< 1 where a cell has no value, of the grid itself and each level
};

/// Fills cells without a value from those around them: means of blocks of 2 x 2 cells, of blocks of those,
/// and so on up; down again, gaps take the bilinear value of the level above and are smoothed. Far gaps are
/// filled from coarse blocks, narrow ones from near cells alone.
/// @param relaxations of smoothing at each level
void fill_gaps(AlignedGrid& surface, int relaxations, Pyramid& pyramid, Executor& threads);

/// The value of `coarse` between the centres of its cells, at the centre of each of the `cells` after
/// `first_col` of a row: the weights for bilinear interpolation, computed once for all rows.
class Between {
  public:
    /// @param first number of the first fine cell on the raster's grid @param coarse_first the same of coarse
    /// cells
    Between(std::int32_t first, std::int32_t cells, std::int32_t coarse_first, std::int32_t coarse_cells,
            std::int32_t factor);
    struct Place {
        std::int32_t near;  ///< the coarse cell before
        std::int32_t next;  ///< the one behind; the same at the border
        float share;        ///< of the one behind
    };
    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] const Place& operator[](std::int32_t cell) const {
        return places_[static_cast<std::size_t>(cell)];
    }

  private:
    std::vector<Place> places_;
};

}  // namespace d2b::ground
