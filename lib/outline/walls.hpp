#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/lattice.hpp"
#include "outline/wall_samples.hpp"
#include "trace/contour.hpp"

namespace d2b {

struct WallOptions;

/// The outlines of all contours with the staircase taken out of them.
class RegularOutlines {
  public:
    RegularOutlines(const std::vector<Contour>& contours, const WallOptions& options);
    RegularOutlines(RegularOutlines&&) noexcept;
    RegularOutlines& operator=(RegularOutlines&&) noexcept;
    ~RegularOutlines();

    /// A contour's outline: shared with neighbours and with other levels vertex for vertex.
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const;
    struct Quality {
        bool fitted = false;     ///< its exterior ring; else a part of that runs as it was traced
        double deviation = 0;    ///< cells: outline and trace are nowhere farther apart, either way
        double area_change = 0;  ///< share of the traced area
    };
    [[nodiscard]] Quality quality(std::size_t contour) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
