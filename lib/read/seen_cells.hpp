#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace d2b {

/// Which cells of a raster have been looked at, as stretches of columns a row: of neighbouring parts of a
/// raster, which may overlap, one stretch a row is left.
class SeenCells {
  public:
    explicit SeenCells(std::int32_t rows) : rows_(static_cast<std::size_t>(rows)) {}

    /// Looks at the columns from `begin` to before `end` of a row: calls use(begin, end) for each stretch of
    /// them that is new.
    void add(std::int32_t row, std::int32_t begin, std::int32_t end,
             const std::function<void(std::int32_t, std::int32_t)>& use);

  private:
    using Stretch = std::pair<std::int32_t, std::int32_t>;  ///< half open
    std::vector<std::vector<Stretch>> rows_;                ///< ascending, with gaps between them
};

}  // namespace d2b
