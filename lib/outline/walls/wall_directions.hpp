#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "outline/walls/trace_sums.hpp"

namespace d2b::outline {

constexpr double degree = std::numbers::pi / 180;  // in radians
constexpr double min_turn = 12 * degree;           ///< between two walls; flatter corners are not corners
constexpr double sharpest_turn = 122 * degree;     ///< same, unless the trace itself has a sharper corner

/// Directions in which the walls of a chain may run, in radians modulo 90 degrees.
struct WallDirections {
    std::vector<double> frames;  ///< directions of the building, the main one first
    std::vector<double> single;  ///< directions of long stretches that no frame explains
};

/// Steps at either end of a stretch that say nothing of its direction, because traces cut corners off by a
/// cell.
[[nodiscard]] constexpr std::size_t steps_at_corner(std::size_t steps) {
    return steps < 10 ? 0 : 1;
}

/// Smallest angle between two directions modulo 90 degrees, in radians, with its sign.
[[nodiscard]] double angle_between(double from, double to);

/// A stretch of a chain between two turning points.
struct Stretch {
    double length;  ///< cells
    double angle;   ///< radians
};

/// Histogram of the directions of the stretches of chains modulo 90 degrees. Long stretches count more than
/// their length because their direction is known better, and are spread less for the same reason.
class DirectionHistogram {
  public:
    /// Adds stretches to several histograms at a time, because their weights take long to compute.
    static void add(const std::vector<Stretch>& stretches, std::initializer_list<DirectionHistogram*> to);
    /// Adds the weights of another one, but not its walls.
    void add(const DirectionHistogram& other, double weight);
    void take_walls_of(const DirectionHistogram& building) { walls_ = building.walls_; }

    [[nodiscard]] double total() const;
    /// Peaks, the highest first: at least 8 degrees apart, each with at least 6 % of the total, and all but
    /// the first of two walls or more, because a single wall has a direction of its own. One direction of 0
    /// if there are no stretches.
    [[nodiscard]] std::vector<double> frames(std::size_t most) const;

  private:
    static constexpr std::size_t bins = 180;  // of half a degree
    std::array<double, bins> weights_{};
    std::array<int, bins> walls_{};  // stretches long enough for one
};

/// Turns frames to the stretches of a chain that lie along them, because a histogram is coarser than these.
void align_frames(const std::vector<Stretch>& stretches, std::vector<double>& frames);

/// Directions of the longest stretches of a chain that lie neither along a frame nor halfway between two
/// walls of the main one.
/// @param frames radians @param min_length cells
[[nodiscard]] std::vector<double> single_directions(std::vector<Stretch> stretches,
                                                    const std::vector<double>& frames, double min_length,
                                                    std::size_t most);

}  // namespace d2b::outline
