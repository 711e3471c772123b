#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ground/aligned_grid.hpp"

namespace d2b::ground {

/// Coarser levels of a grid whose gaps are filled. Reused, so that memory is allocated once.
struct Pyramid {
    std::vector<AlignedGrid> coarser;
    std::vector<Grid<std::uint8_t>> gaps;  ///< flags of cells without a value, starting with the grid's own
};

/// Fills cells without a value from their surroundings by a pyramid (pull-push): going up, means of 2 x 2
/// cells; going down, gaps take the bilinear value of the next coarser level and are smoothed. Wide gaps are
/// thus filled from coarse blocks, narrow ones only from near cells.
/// @param relaxations smoothing steps per level
void fill_gaps(AlignedGrid& surface, int relaxations, Pyramid& pyramid, Executor& threads);

/// Weights for linear interpolation between centres of coarse cells at the centres of fine cells, computed
/// once for all rows.
class InterpolationWeights {
  public:
    /// @param first number of the first fine cell on the raster's grid @param coarse_first same for coarse
    /// cells
    InterpolationWeights(std::int32_t first, std::int32_t cells, std::int32_t coarse_first,
                         std::int32_t coarse_cells, std::int32_t factor);
    struct Weights {
        std::int32_t near;  ///< coarse cell before
        std::int32_t next;  ///< coarse cell after; the same at the border
        float share;        ///< weight of the coarse cell after
    };
    [[nodiscard]] std::size_t size() const { return weights_.size(); }
    [[nodiscard]] const Weights& operator[](std::int32_t cell) const {
        return weights_[static_cast<std::size_t>(cell)];
    }

  private:
    std::vector<Weights> weights_;
};

/// Interpolates between the centres of blocks of 2 x 2 cells, the next coarser level.
class CoarserLevel {
  public:
    CoarserLevel(const AlignedGrid& fine, const AlignedGrid& coarse);

    /// Buffers reused between rows.
    struct Buffers {
        std::vector<float> blocks;
        std::vector<float> cells;
    };
    /// Fills the gaps in a row of the fine grid. @param gap 1 for cells without a value, else 0
    void fill_row(std::int32_t row, std::span<const std::uint8_t> gap, Buffers& buffers,
                  std::span<float> cells) const;

  private:
    void interpolate_row(Buffers& buffers) const;

    const MetreGrid& coarse_;
    InterpolationWeights down_;
    InterpolationWeights across_;
    std::size_t first_second_;  ///< first cell that is the second of its block
};

}  // namespace d2b::ground
