#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// Noded rings of contours: every corner of another ring on an edge of a ring becomes a vertex of it.
class LatticeNet {
  public:
    using Vertex = std::uint32_t;
    /// Directions from a vertex; opposite directions differ by 2.
    enum class Way : std::uint8_t { east, south, west, north };

    /// @throws Cancelled
    LatticeNet(std::span<const Contour* const> contours, const StopRequest& stop);

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    /// Vertices are sorted by row, then column.
    [[nodiscard]] LatticePoint point(Vertex v) const { return points_[v]; }
    /// True if the degree of the vertex is not two.
    [[nodiscard]] bool junction(Vertex v) const { return two_ways.at(ways_[v]) == 0; }
    [[nodiscard]] Way way(Vertex from, Vertex to) const;
    /// Rings grouped by contour: exterior, then interiors.
    [[nodiscard]] std::size_t rings() const { return first_.size() - 1; }
    [[nodiscard]] std::span<const Vertex> ring(std::size_t r) const {
        return std::span(vertices_).subspan(first_[r], first_[r + 1] - first_[r]);
    }

  private:
    static constexpr std::array<std::uint8_t, 16> two_ways{0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, 0, 0};
    std::vector<Vertex> number_corners(const std::vector<LatticePoint>& corners, const StopRequest& stop);
    void order_columns();
    void append_edge(Vertex from, Vertex to);

    std::vector<LatticePoint> points_;
    std::vector<Vertex> by_col_;        // vertices sorted by column, then row
    std::vector<Vertex> place_in_col_;  // per vertex: its index in by_col_
    std::vector<std::uint8_t> ways_;    // per vertex: bits of the directions of its edges
    std::vector<Vertex> vertices_;      // concatenated vertices of all rings
    std::vector<std::size_t> first_;    // per ring: its first vertex
};

}  // namespace d2b
