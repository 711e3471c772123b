#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/chain_walls.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/middles.hpp"
#include "outline/walls/turning_points.hpp"
#include "outline/walls/wall_options.hpp"

namespace d2b {

/// Draws one chain between its ends: with walls, and closer to its trace if necessary.
class ChainDrawing {
  public:
    /// @param chain must outlive this
    ChainDrawing(const Chain& chain, const WallOptions& options);
    ChainDrawing(const ChainDrawing&) = delete;
    ChainDrawing& operator=(const ChainDrawing&) = delete;
    ~ChainDrawing() = default;

    [[nodiscard]] const WallSamples& samples() const { return walls_.samples(); }
    [[nodiscard]] const ChainWalls& walls() const { return walls_; }
    /// Moves a wall to the left of the direction of the chain.
    void shift(std::size_t wall, double cells) {
        walls_.shift(wall, cells);
        planned_.reset();
    }
    [[nodiscard]] double own_direction() const { return dominant_direction(samples(), turning_points_); }
    /// Divides the chain into walls. @param direction dominant direction in radians
    /// @return direction of the walls; nullopt if walls are impossible @throws Cancelled
    [[nodiscard]] std::optional<double> plan(double price, double direction, const StopRequest& stop);
    /// True if the chain drawn with walls only stays within the tolerance. @param ends of an open chain
    [[nodiscard]] bool walls_are_near(const std::optional<ChainEnds>& ends);
    /// @param form raised at walls that leave the trace by more than the tolerance
    /// @param ends of an open chain
    [[nodiscard]] DrawnChain draw(ChainForm& form, const std::optional<ChainEnds>& ends);

  private:
    /// Draws the whole chain with walls.
    const DrawnChain& draw_planned(const std::optional<ChainEnds>& ends);
    [[nodiscard]] bool is_sound(const DrawnChain& drawn) const;

    LatticePoint origin_;
    CellShape shape_;
    WallStyle style_;
    double limit_;  // cells between vertices and trace before rounding to the fine lattice
    ChainWalls walls_;
    std::vector<std::size_t> turning_points_;  // steps
    Middles middles_;
    std::optional<DrawnChain> planned_;         // drawn with walls only; kept until used or outdated
    std::optional<ChainEnds> ends_of_planned_;  // ends for which that was drawn
};

}  // namespace d2b
