#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace d2b {

/// Cells of a raster that have been visited, as ranges of columns per row. Ranges of adjacent or overlapping
/// parts are merged, so that few remain.
class SeenCells {
  public:
    explicit SeenCells(std::int32_t rows) : rows_(static_cast<std::size_t>(rows)) {}

    /// Visits columns [begin, end) of a row: calls use(begin, end) for each range of them that was not
    /// visited before.
    void add(std::int32_t row, std::int32_t begin, std::int32_t end,
             const std::function<void(std::int32_t, std::int32_t)>& use);

  private:
    using Stretch = std::pair<std::int32_t, std::int32_t>;  ///< half-open
    std::vector<std::vector<Stretch>> rows_;                ///< ascending and disjoint
};

}  // namespace d2b
