#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/evidence.hpp"
#include "detect/wall_line.hpp"

namespace d2b {

/// Two straight parts of a seam around a corner.
struct CornerSeam {
    SeamLine one;
    SeamLine other;
};

/// Border of a part of an object: the seam with the rest of the object, and the free border.
class PartSeam {
  public:
    /// Adds an edge between a cell of the part and its neighbour.
    /// @param down, across offset of the neighbour in cells
    void add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell);
    void add_free() { ++free_; }

    /// Share of the border that belongs to the object's outline; 1 if there is no seam.
    [[nodiscard]] double free_share() const;
    /// Least-squares line of the seam, if it is straight.
    [[nodiscard]] std::optional<SeamLine> straight_line(const CellSize& cell) const;
    /// Two lines that fit the seam best, if both are straight and meet at an angle like the walls at the
    /// corner of a roof.
    [[nodiscard]] std::optional<CornerSeam> corner(const CellSize& cell) const;

  private:
    struct Edge {
        MetrePlace middle;
        MetrePlace to_rest;  // vector across the edge
    };
    [[nodiscard]] std::optional<SeamLine> fitted_line(double most_squared) const;
    [[nodiscard]] PartSeam half(const std::vector<std::uint8_t>& is_second, std::uint8_t which) const;

    std::vector<Edge> edges_;  // edges of the seam
    std::int64_t free_ = 0;
};

/// Computes the border of each part, by label - 1.
/// @param parts cells of objects, and the regions of these cells that are parts
/// @param rest cells of objects on the other side of seams
[[nodiscard]] std::vector<PartSeam> seams_of(const DetectedObjects& parts, const Mask& rest,
                                             const CellSize& cell, Executor& threads);

}  // namespace d2b
