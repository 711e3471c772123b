#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "core/stop_request.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// All rings of some contours over the distinct corners of all of them: every corner that another outline has
/// on a ring's edge is a vertex of that ring.
class LatticeNet {
  public:
    using Vertex = std::uint32_t;
    /// The four ways from a vertex; a way and its opposite differ by 2.
    enum class Way : std::uint8_t { east, south, west, north };

    /// @throws Cancelled
    LatticeNet(std::span<const Contour* const> contours, const StopRequest& stop);

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    /// Vertices are sorted by row, then column.
    [[nodiscard]] LatticePoint point(Vertex v) const { return points_[v]; }
    /// Whether other than two edges meet there.
    [[nodiscard]] bool junction(Vertex v) const { return two_ways.at(ways_[v]) == 0; }
    [[nodiscard]] Way way(Vertex from, Vertex to) const;
    /// Exteriors and interiors of one contour after the other.
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
    std::vector<Vertex> place_in_col_;  // of a vertex among these
    std::vector<std::uint8_t> ways_;    // bits of a vertex
    std::vector<Vertex> vertices_;      // of all rings
    std::vector<std::size_t> first_;    // of each ring
};

}  // namespace d2b
