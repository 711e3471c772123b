#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trace/contour_list.hpp"

namespace d2b {

/// The contours that stand on each contour.
class ContourChildren {
  public:
    ContourChildren() = default;
    explicit ContourChildren(const ContourList& contours);
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t contour) const {
        return std::span(children_).subspan(first_[contour], first_[contour + 1] - first_[contour]);
    }

  private:
    std::vector<std::uint32_t> children_;  ///< of one contour after the other
    std::vector<std::size_t> first_;       ///< of a contour; one more at the end
};

}  // namespace d2b
