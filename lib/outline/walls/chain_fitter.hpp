#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "outline/walls/chain_polyline.hpp"
#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_clusters.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Degrees of fidelity to the trace, from fully regularized to conflict-free: as long as the ends of arcs
/// keep their traced positions, two stretches of the last mode only share points that their traces share.
enum class FitMode : std::uint8_t {
    regularized,  ///< straight walls and circular arcs
    midpoint,     ///< lines through midpoints of steps, within 0.6 cells of the trace
    tight,        ///< same, within 0.45 cells
    beveled       ///< the trace with the corners of its staircases cut off at the midpoints of steps
};

/// Mode of each step of a chain. Stretches that conflict with others switch to a closer mode; the rest keeps
/// its walls.
class ChainFitMode {
  public:
    /// A range of steps of one mode. It may wrap around in a closed chain: last <= first + steps.
    struct Stretch {
        std::size_t first;
        std::size_t last;
        FitMode mode;
    };

    ChainFitMode() = default;
    ChainFitMode(std::size_t steps, bool closed) : modes_(steps, FitMode::regularized), closed_(closed) {}

    [[nodiscard]] FitMode at(std::size_t step) const { return modes_[step % modes_.size()]; }
    /// Least close mode in a range. Steps may be up to twice the number of the chain's; those beyond the ends
    /// of an open chain are ignored.
    [[nodiscard]] FitMode least(std::size_t first, std::size_t last) const;
    /// Raises a range to the mode next to the least close one in it.
    /// @param margin steps on either side to be raised as well @return false if the mode is the closest
    /// already
    bool tighten(std::size_t first, std::size_t last, std::size_t margin);
    /// Raises a range to at least this mode.
    /// @return true if anything has changed
    bool raise(std::size_t first, std::size_t last, std::size_t margin, FitMode mode);
    bool raise_all(FitMode mode) { return raise(0, modes_.size(), 0, mode); }
    [[nodiscard]] bool has_walls() const {
        return std::ranges::find(modes_, FitMode::regularized) != modes_.end();
    }
    /// True if the trace is kept on both sides of the point at which a step begins.
    [[nodiscard]] bool beveled_around(std::size_t step) const;
    /// Stretches in order, beginning at the first step of an open chain, or at a change of mode in a closed
    /// one. Walls too short to stand between other modes are left out.
    [[nodiscard]] std::vector<Stretch> stretches() const;

  private:
    std::vector<FitMode> modes_;
    bool closed_ = false;
};

/// Draws parts of a chain through the midpoints of its steps. These lie evenly about the line that the
/// staircase approximates and half a cell from all cell centers, so no cell changes sides.
class StepMidpoints {
  public:
    /// @param node_steps steps of the chain at which nodes may be; must outlive this, as must samples
    /// @param tolerance largest distance in cells from the trace in all modes
    StepMidpoints(const TraceSums& samples, const std::vector<std::uint32_t>& node_steps, double tolerance);

    /// Returns true if cutting off corners stays within the tolerance; otherwise the closest mode is the
    /// trace itself. @param side longer side of a cell
    [[nodiscard]] static bool can_bevel(double side, double tolerance) { return side / 2 <= tolerance; }
    /// Appends the vertices of a stretch: from the midpoint of its first step to that of its last, or around
    /// a closed chain. @param chain the new vertices are joined to its last one, if any
    /// @param end the end of an open chain, if the stretch reaches it
    void append(const ChainFitMode::Stretch& stretch, const FinePoint* end, ChainPolyline& chain) const;

  private:
    struct Candidate {
        Vec2 place;
        std::size_t step;
        bool on_corner;  // on a lattice corner; otherwise at the midpoint of the step
        bool kept;       // a node
    };
    [[nodiscard]] Vec2 unit(std::size_t step) const { return samples_.at(step + 1) - samples_.at(step); }
    [[nodiscard]] double turn(std::size_t step) const;
    [[nodiscard]] bool is_node(std::size_t step) const;
    [[nodiscard]] bool is_vertex(std::size_t step, FitMode mode) const;
    [[nodiscard]] std::vector<Candidate> candidates(const ChainFitMode::Stretch& stretch) const;
    [[nodiscard]] double error(const Candidate& from, const Candidate& to, double limit) const;
    void select_vertices(std::vector<Candidate>& points, double limit) const;
    static void remove_collinear(std::vector<Candidate>& points);

    const TraceSums& samples_;
    const std::vector<std::uint32_t>& node_steps_;
    double tolerance_;
    bool can_bevel_;
};

/// Draws one chain between its ends: with walls, and closer to its trace if necessary.
class ChainFitter {
  public:
    /// @param chain must outlive this
    ChainFitter(const Chain& chain, const WallOptions& options);
    ChainFitter(const ChainFitter&) = delete;
    ChainFitter& operator=(const ChainFitter&) = delete;
    ~ChainFitter() = default;

    [[nodiscard]] const TraceSums& samples() const { return walls_.samples(); }
    [[nodiscard]] const ChainWalls& walls() const { return walls_; }
    /// Moves a wall to the left of the direction of the chain.
    void shift(std::size_t wall, double cells) {
        walls_.shift(wall, cells);
        planned_.reset();
    }
    /// Stretches of the chain without those on the frame of the raster.
    [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
    /// Divides the chain into walls. @param price relative to the usual one of a wall
    /// @param directions the frames are turned to the walls if `turn_frames`
    /// @return false if walls are impossible @throws Cancelled
    [[nodiscard]] bool plan(double price, WallDirections& directions, bool turn_frames,
                            const StopToken& stop);
    /// True if the chain drawn with walls only stays within the tolerance. @param ends of an open chain
    [[nodiscard]] bool walls_are_near(const std::optional<ChainEnds>& ends);
    /// @param mode raised at walls that leave the trace by more than the tolerance
    /// @param ends of an open chain
    [[nodiscard]] ChainPolyline draw(ChainFitMode& mode, const std::optional<ChainEnds>& ends);

  private:
    /// Draws the whole chain with walls.
    const ChainPolyline& draw_planned(const std::optional<ChainEnds>& ends);
    [[nodiscard]] bool is_sound(const ChainPolyline& drawn) const;

    WallParameters parameters_;
    double limit_;  // cells between vertices and trace before rounding to the fine lattice
    ChainWalls walls_;
    std::vector<std::size_t> turning_points_;  // steps
    std::vector<Stretch> stretches_;
    StepMidpoints midpoints_;
    std::optional<ChainPolyline> planned_;      // drawn with walls only; kept until used or outdated
    std::optional<ChainEnds> ends_of_planned_;  // ends for which that was drawn
};

}  // namespace d2b::outline
