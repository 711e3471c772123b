#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/stop_token.hpp"
#include "dem2buildings/options.hpp"
#include "outline/walls/trace_sums.hpp"
#include "outline/walls/wall_directions.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b::outline {

/// A range of steps of a traced chain that is drawn as one straight wall or circular arc.
struct WallSegment {
    std::size_t first = 0;  ///< step
    std::size_t last = 0;   ///< one past the last step
    int family = 0;  ///< index of its frame or single direction in WallDirections; one more at 45 degrees
    Line2 line;      ///< its direction is that of the chain
    std::optional<Circle> circle;  ///< set if the segment is an arc
    bool on_frame = false;         ///< lies on the edge of the raster, and stays there

    /// True if its line follows the directions of its chain, and may be moved.
    [[nodiscard]] bool is_wall() const { return !circle && !on_frame; }
};

/// Margin in cells subtracted from the tolerance, because intersections of walls are rounded to the fine
/// lattice.
constexpr double wall_clearance = 0.05;

struct WallParameters {
    static constexpr double variance =
        0.3;  ///< variance of step midpoints about their wall, for square cells

    Walls walls = Walls::automatic;
    double tolerance = 0;  ///< cells
    double price = 1;      ///< cost of a wall in square cells: a lower price gives more walls that lie closer
    int higher = 0;        ///< side of the chain on which its building or tier lies: 1 left, -1 right, 0 both
    double inset = 0;      ///< cells by which walls are moved towards higher ground
    double side = 1;       ///< longer side of a cell

    /// Cost of the squared distances of n step midpoints in excess of those that the staircase of a straight
    /// wall has anyway: up to a twelfth of a squared side per step, here slightly more.
    [[nodiscard]] double misfit(double squares, double n) const {
        return std::max(0.0, squares - 0.09 * side * side * n) / variance;
    }
};

/// Moves a wall to the left of the direction of its chain. @param cells negative: to the right
void shift_wall(WallSegment& segment, const TraceSums& samples, double cells);

/// Moves walls towards higher ground, by the largest number of quarters of `cells` that keeps them within a
/// limit of their trace. Arcs move by the full distance, because their distance is checked when they are
/// drawn.
/// @param higher side of the trace on which its building or tier lies: 1 left, -1 right, 0 both (such walls
/// stay)
void move_inward(const TraceSums& samples, int higher, double cells, double limit,
                 std::vector<WallSegment>& segments);

/// Shifts each straight wall in parallel so that the cells along its trace have their centers on the correct
/// sides, as far as possible for one line, and not farther than necessary. This is needed because the line
/// nearest to a staircase leaves some cells on the wrong side, and the error of each is the height of the
/// wall.
/// @param higher side of the trace on which its building or tier lies: 1 left, -1 right, 0 both
/// @param limit largest distance in cells between a wall and its trace
void separate_cells(const TraceSums& samples, int higher, double limit, std::vector<WallSegment>& segments);

/// Walls of a chain and their accumulated shifts.
class ChainWalls {
  public:
    ChainWalls(const Chain& chain, const WallOptions& options);

    [[nodiscard]] const TraceSums& samples() const { return samples_; }
    /// Walls along the edge of the raster; none with Walls::right.
    [[nodiscard]] const std::vector<WallSegment>& on_frame() const { return on_frame_; }
    /// Divides the chain into walls and arcs. @param points steps at which it may turn
    /// @param directions the frames are turned to the walls that follow them if `turn_frames`
    /// @return false if there is no division; nothing has changed then @throws Cancelled
    [[nodiscard]] bool plan(const std::vector<std::size_t>& points, const WallParameters& parameters,
                            WallDirections& directions, bool turn_frames, const StopToken& stop);
    /// True before plan() has succeeded.
    [[nodiscard]] bool empty() const { return segments_.empty(); }
    [[nodiscard]] std::size_t size() const { return segments_.size(); }
    /// A wall at its shifted position.
    [[nodiscard]] WallSegment segment(std::size_t i) const;
    [[nodiscard]] std::vector<WallSegment> segments() const;

    /// Movable walls that lie mostly between two steps.
    [[nodiscard]] std::vector<std::size_t> movable_walls(std::size_t begin, std::size_t end,
                                                         const StopToken& stop) const;
    /// Length in steps.
    [[nodiscard]] double length(std::size_t i) const {
        return static_cast<double>(segments_[i].last - segments_[i].first);
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

    TraceSums samples_;
    std::vector<WallSegment> on_frame_;
    std::vector<WallSegment> segments_;
    std::vector<Shift> shifts_;  // per wall
};

}  // namespace d2b::outline
