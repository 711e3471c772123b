#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/evidence.hpp"
#include "detect/wall_line.hpp"

namespace d2b {

/// Two straight pieces of a seam around a corner.
struct CornerSeam {
    SeamLine one;
    SeamLine other;
};

/// The border of a part of an object: with the rest of the object, the seam, and with what is no object.
class PartSeam {
  public:
    /// An edge between a cell of the part and its neighbour. @param down, across to the neighbour, cells
    void add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell);
    void add_free() { ++free_; }

    /// Share of the border that is the object's own; 1 where there is no seam.
    [[nodiscard]] double free_share() const;
    /// The line that fits the seam best, if it is straight.
    [[nodiscard]] std::optional<SeamLine> straight_line(const CellSize& cell) const;
    /// The two lines that fit the seam best, if both are straight and meet at an angle, as the walls at the
    /// corner of a roof do.
    [[nodiscard]] std::optional<CornerSeam> corner(const CellSize& cell) const;

  private:
    struct Edge {
        MetrePlace middle;
        MetrePlace to_rest;  // the way over it
    };
    [[nodiscard]] std::optional<SeamLine> fitted_line(double most_squared) const;
    [[nodiscard]] PartSeam half(const std::vector<std::uint8_t>& is_second, std::uint8_t which) const;

    std::vector<Edge> edges_;  // of the seam
    std::int64_t free_ = 0;
};

/// One a part, by label - 1. @param parts cells of objects, and regions of these that are parts
/// @param rest cells of objects that are on the other side of seams
[[nodiscard]] std::vector<PartSeam> seams_of(const DetectedObjects& parts, const Mask& rest,
                                             const CellSize& cell, Executor& threads);

}  // namespace d2b
