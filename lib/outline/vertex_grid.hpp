#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/lattice.hpp"

namespace d2b {

/// Uniform grid of points with buckets of 16 x 16, for finding points in triangles.
class VertexGrid {
  public:
    void add(LatticePoint point) {
        buckets_[bucket(point.row >> shift, point.col >> shift)].push_back(point);
    }
    /// Removes one of the points equal to this.
    void remove(LatticePoint point);
    /// Returns true if the closed triangle contains a point other than its corners.
    [[nodiscard]] bool any_in(LatticePoint a, LatticePoint b, LatticePoint c) const;

  private:
    static constexpr int shift = 4;
    static std::uint64_t bucket(std::int32_t row, std::int32_t col) {
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) |
               static_cast<std::uint32_t>(col);
    }
    std::unordered_map<std::uint64_t, std::vector<LatticePoint>> buckets_;
};

}  // namespace d2b
