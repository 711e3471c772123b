#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/band.hpp"

namespace d2b {

/// One value per slab of rows of a window, so that processing a band visits only the slabs that overlap it.
template <typename Slab>
class RowSlabs {
  public:
    /// @param first_row of the window @param rows of the window
    RowSlabs(std::int32_t first_row, std::int32_t rows)
        : first_row_(first_row), slabs_(static_cast<std::size_t>(rows / slab_rows + 1)) {}

    /// @param row of the window, numbered as in the whole raster
    [[nodiscard]] std::size_t index(std::int32_t row) const {
        return static_cast<std::size_t>((row - first_row_) / slab_rows);
    }
    [[nodiscard]] Slab& operator[](std::size_t i) { return slabs_[i]; }
    [[nodiscard]] const Slab& operator[](std::size_t i) const { return slabs_[i]; }
    /// Calls use(slab) for each slab that overlaps a band of the window, in ascending order.
    template <typename Use>
    void for_band(const BandShape& band, const Use& use) const {
        if (band.rows == 0)
            return;
        for (std::size_t i = index(band.first_row); i <= index(band.first_row + band.rows - 1); ++i)
            use(slabs_[i]);
    }

  private:
    static constexpr std::int32_t slab_rows = 64;
    std::int32_t first_row_;
    std::vector<Slab> slabs_;
};

}  // namespace d2b
