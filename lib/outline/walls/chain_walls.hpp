#pragma once

#include <cstddef>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_graph.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// Walls of a chain and their accumulated shifts.
class ChainWalls {
  public:
    ChainWalls(const Chain& chain, const CellShape& shape)
        : samples_(chain.trace, chain.closed, shape), higher_(chain.higher) {}

    [[nodiscard]] const WallSamples& samples() const { return samples_; }
    /// Divides the chain into walls. @param points steps at which it may turn
    /// @param direction dominant direction in radians; adjusted to the walls that follow it
    /// @return false if there is no division; nothing has changed then @throws Cancelled
    [[nodiscard]] bool plan(const std::vector<std::size_t>& points, const WallStyle& style, double& direction,
                            const StopRequest& stop);
    /// True before plan() has succeeded.
    [[nodiscard]] bool empty() const { return pieces_.empty(); }
    [[nodiscard]] std::size_t size() const { return pieces_.size(); }
    /// A wall at its shifted position.
    [[nodiscard]] WallPiece piece(std::size_t i) const;
    [[nodiscard]] std::vector<WallPiece> pieces() const;

    /// Movable walls that lie mostly between two steps.
    [[nodiscard]] std::vector<std::size_t> along(std::size_t begin, std::size_t end,
                                                 const StopRequest& stop) const;
    /// Length in steps.
    [[nodiscard]] double length(std::size_t i) const {
        return static_cast<double>(pieces_[i].last - pieces_[i].first);
    }
    /// Moves a wall to the left of the direction of the chain.
    void shift(std::size_t i, double cells) {
        ++shifts_[i].times;
        shifts_[i].cells += cells;
    }

  private:
    struct Shift {
        double cells = 0;
        int times = 0;  // number of shifts
    };

    WallSamples samples_;
    int higher_;
    std::vector<WallPiece> pieces_;
    std::vector<Shift> shifts_;  // per wall
};

}  // namespace d2b
