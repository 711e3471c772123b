#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "write/packed_numbers.hpp"

namespace d2b {

/// The ground of a page, in samples that are squares of cells: of a terrain their mean, of elevations with
/// buildings in them the lowest.
class PageRelief {
  public:
    /// @param window of the DEM @param lowest whether a sample is its lowest cell
    PageRelief(const Window& window, bool lowest);

    /// @param part of the window @param values in metres, NaN where there is none
    void add(const Window& part, std::span<const float> values);
    /// Centimetres, row by row: each less the one before it, of the first of a row the one above; 0 where
    /// there is none, else one more than the number packed with its sign.
    [[nodiscard]] PackedNumbers packed() const;
    /// Samples a side.
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    /// Cells a side of a sample.
    [[nodiscard]] std::int32_t step() const { return step_; }

  private:
    [[nodiscard]] std::optional<std::int64_t> centimetres(std::size_t sample) const;

    Window window_;
    bool lowest_;
    std::int32_t step_;
    std::int32_t rows_;
    std::int32_t cols_;
    std::vector<double> values_;  ///< sums, or the lowest
    std::vector<std::int32_t> counts_;
};

/// Gives a relief what comes; nothing of its own is written. @param relief shared with the page
[[nodiscard]] std::unique_ptr<RasterSink> open_page_relief(std::shared_ptr<PageRelief> relief);

}  // namespace d2b
