#pragma once

#include <cstddef>
#include <vector>

#include "core/stop_request.hpp"
#include "outline/walls/wall_graph.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// The walls into which a chain is divided, and how far each has been moved since.
class ChainWalls {
  public:
    ChainWalls(const Chain& chain, const CellShape& shape)
        : samples_(chain.trace, chain.closed, shape), higher_(chain.higher) {}

    [[nodiscard]] const WallSamples& samples() const { return samples_; }
    /// Divides the chain into walls. @param points where it may turn
    /// @param direction the dominant one, radians; adjusted to the walls that follow it
    /// @return whether that is possible: else nothing has changed @throws Cancelled
    [[nodiscard]] bool plan(const std::vector<std::size_t>& points, const WallStyle& style, double& direction,
                            const StopRequest& stop);
    /// Nothing has been planned.
    [[nodiscard]] bool empty() const { return pieces_.empty(); }
    [[nodiscard]] std::size_t size() const { return pieces_.size(); }
    /// A wall where it has been moved to.
    [[nodiscard]] WallPiece piece(std::size_t i) const;
    [[nodiscard]] std::vector<WallPiece> pieces() const;

    /// The walls that stand between two steps for the most part, and may still be moved.
    [[nodiscard]] std::vector<std::size_t> along(std::size_t begin, std::size_t end,
                                                 const StopRequest& stop) const;
    /// In steps.
    [[nodiscard]] double length(std::size_t i) const {
        return static_cast<double>(pieces_[i].last - pieces_[i].first);
    }
    /// Moves a wall to the left of the way that the chain runs.
    void shift(std::size_t i, double cells) {
        ++shifts_[i].times;
        shifts_[i].cells += cells;
    }

  private:
    struct Shift {
        double cells = 0;
        int times = 0;  // that it has been changed
    };

    WallSamples samples_;
    int higher_;
    std::vector<WallPiece> pieces_;
    std::vector<Shift> shifts_;  // of each
};

}  // namespace d2b
