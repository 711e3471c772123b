#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/contour_list.hpp"

namespace d2b {

/// Children of each contour in the tree of contours, in CSR form.
class ContourChildren {
  public:
    ContourChildren() = default;
    explicit ContourChildren(const ContourList& contours);
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t contour) const {
        return std::span(children_).subspan(first_[contour], first_[contour + 1] - first_[contour]);
    }

  private:
    std::vector<std::uint32_t> children_;  ///< concatenated over contours
    std::vector<std::size_t> first_;       ///< index of each contour's first child; one more at the end
};

}  // namespace d2b
