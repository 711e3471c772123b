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

/// Ground of a page, in samples that are squares of cells: the mean of a terrain, or the minimum of
/// elevations that contain buildings.
class PageRelief {
  public:
    /// @param window of the DEM @param lowest true for the minimum per sample, false for the mean
    PageRelief(const Window& window, bool lowest);

    /// @param part of the window @param values in metres, NaN if missing
    void add(const Window& part, std::span<const float> values);
    /// Returns centimetres, row by row, as differences to the previous sample, or to the one above at the
    /// begin of a row. 0 means no data, otherwise the zigzag-encoded difference plus one.
    [[nodiscard]] PackedNumbers packed() const;
    /// Samples per side.
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    /// Cells per side of a sample.
    [[nodiscard]] std::int32_t step() const { return step_; }

  private:
    [[nodiscard]] std::optional<std::int64_t> centimetres(std::size_t sample) const;

    Window window_;
    bool lowest_;
    std::int32_t step_;
    std::int32_t rows_;
    std::int32_t cols_;
    std::vector<double> values_;  ///< sums or minima
    std::vector<std::int32_t> counts_;
};

/// Forwards rows to a relief and writes no file. @param relief shared with the page
[[nodiscard]] std::unique_ptr<RasterSink> open_page_relief(std::shared_ptr<PageRelief> relief);

}  // namespace d2b
