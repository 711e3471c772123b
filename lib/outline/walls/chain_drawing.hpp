#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/chain_walls.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/middles.hpp"
#include "outline/walls/wall_options.hpp"

namespace d2b {

/// One chain, and how it is drawn between its ends: with walls, and closer to its trace where it has to be.
class ChainDrawing {
  public:
    /// @param chain must outlive this
    ChainDrawing(const Chain& chain, const WallOptions& options);
    ChainDrawing(const ChainDrawing&) = delete;
    ChainDrawing& operator=(const ChainDrawing&) = delete;
    ~ChainDrawing() = default;

    [[nodiscard]] const WallSamples& samples() const { return walls_.samples(); }
    [[nodiscard]] const ChainWalls& walls() const { return walls_; }
    [[nodiscard]] ChainWalls& walls() { return walls_; }
    [[nodiscard]] double own_direction() const;
    /// Divides the chain into walls. @param direction the dominant one, radians
    /// @return the direction of its walls; nothing where they are not possible @throws Cancelled
    [[nodiscard]] std::optional<double> plan(double price, double direction, const StopRequest& stop);
    /// Whether walls alone lie within the tolerance. @param ends of an open chain
    [[nodiscard]] bool walls_are_near(const std::optional<ChainEnds>& ends) const;
    /// @param form gets closer where walls leave the trace by more than the tolerance
    /// @param ends of an open chain
    [[nodiscard]] DrawnChain draw(ChainForm& form, const std::optional<ChainEnds>& ends) const;

  private:
    [[nodiscard]] DrawnChain draw_planned(const std::optional<ChainEnds>& ends) const;
    [[nodiscard]] bool is_sound(const DrawnChain& drawn) const;

    LatticePoint origin_;
    CellShape shape_;
    WallStyle style_;
    ChainWalls walls_;
    Middles middles_;
};

}  // namespace d2b
