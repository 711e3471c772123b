#include "detect/wall_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {
namespace {

// Length of the wall that is tested on either side: half of the seam's length, within these limits.
constexpr double shortest_wall_m = 3;
constexpr double shortest_wall = 3;  // cells
constexpr double longest_wall_m = 8;
constexpr double corner = 2;         // cells next to the seam that the crown's own border may cover
constexpr double sample_step = 0.5;  // cells
constexpr double in_line = 0.7;      // share of the samples
constexpr int outside = 1;           // cells that a wall may lie outside of its seam, and inside of the eaves

/// Samples the mask of objects in coordinates along and across a seam.
class Beside {
  public:
    Beside(const SeamLine& seam, const CellSize& cell, const Mask& objects)
        : seam_(seam), cell_(cell), objects_(objects) {}
    /// Returns 1 if a point is inside an object, 0 if not, -1 outside of the raster.
    [[nodiscard]] int object_at(double along, double inward) const {
        const double row = (seam_.middle.y + along * seam_.along.y + inward * seam_.inward.y) / cell_.down;
        const double col = (seam_.middle.x + along * seam_.along.x + inward * seam_.inward.x) / cell_.across;
        if (row < 0 || col < 0 || row >= objects_.rows || col >= objects_.cols)
            return -1;
        return objects_.at(static_cast<std::int32_t>(row), static_cast<std::int32_t>(col));
    }

  private:
    const SeamLine& seam_;
    const CellSize& cell_;
    const Mask& objects_;
};

/// Point on a wall beyond one end of a seam.
struct Stretch {
    double along = 0;
    double inward = 0;
};

/// @param way 1 or -1: forwards or backwards along the line
std::optional<Stretch> wall_after(double end, int way, double wall, double side, int eaves,
                                  const Beside& beside) {
    const int samples = 1 + static_cast<int>(wall / (sample_step * side));
    int hits = 0;
    Stretch sum;
    for (int i = 0; i < samples; ++i) {
        const double along = end + way * (corner + i * sample_step) * side;
        if (beside.object_at(along, -outside * side) != 0 ||
            beside.object_at(along, (eaves + outside) * side) != 1)
            continue;
        int quarters = 1;
        while (quarters < 4 * (eaves + 2 * outside) &&
               beside.object_at(along, (0.25 * quarters - outside) * side) != 1)
            ++quarters;
        ++hits;
        sum.along += along;
        sum.inward += (0.25 * (quarters - 0.5) - outside) * side;
    }
    if (hits < in_line * samples)
        return std::nullopt;
    return Stretch{sum.along / hits, sum.inward / hits};
}

double length_looked_at(const SeamLine& seam, double side) {
    return std::max(
        {shortest_wall_m, shortest_wall * side, std::min((seam.last - seam.first) / 2, longest_wall_m)});
}

/// @param is_last true for the last end of the seam
std::optional<WallLine> wall_at_end(const SeamLine& seam, bool is_last, const Mask& objects,
                                    const CellSize& cell, int eaves) {
    const double side = std::sqrt(cell.area());
    const std::optional<Stretch> wall =
        wall_after(is_last ? seam.last : seam.first, is_last ? 1 : -1, length_looked_at(seam, side), side,
                   eaves, Beside(seam, cell, objects));
    return wall ? std::optional(WallLine{wall->inward, wall->inward}) : std::nullopt;
}

}  // namespace

std::optional<WallLine> wall_beyond(const SeamLine& seam, const Mask& objects, const CellSize& cell,
                                    int eaves) {
    const double side = std::sqrt(cell.area());
    const double wall = length_looked_at(seam, side);
    const Beside beside(seam, cell, objects);
    const std::optional<Stretch> after = wall_after(seam.last, 1, wall, side, eaves, beside);
    if (!after)
        return std::nullopt;
    const std::optional<Stretch> before = wall_after(seam.first, -1, wall, side, eaves, beside);
    if (!before)
        return std::nullopt;
    const double slope = (after->inward - before->inward) / (after->along - before->along);
    return WallLine{before->inward + slope * (seam.first - before->along),
                    before->inward + slope * (seam.last - before->along)};
}

std::optional<WallLine> wall_away_from(const MetrePlace& meeting, const SeamLine& seam, const Mask& objects,
                                       const CellSize& cell, int eaves) {
    const double at_meeting =
        (meeting.x - seam.middle.x) * seam.along.x + (meeting.y - seam.middle.y) * seam.along.y;
    return wall_at_end(seam, at_meeting < (seam.first + seam.last) / 2, objects, cell, eaves);
}

std::optional<WallLine> wall_beyond_one_end(const SeamLine& seam, const Mask& objects, const CellSize& cell,
                                            int eaves) {
    const std::optional<WallLine> wall = wall_at_end(seam, true, objects, cell, eaves);
    return wall ? wall : wall_at_end(seam, false, objects, cell, eaves);
}

void clear_outside(const SeamLine& seam, const WallLine& wall, const Mask& roofs, const CellSize& cell,
                   Mask& objects) {
    // A crown is slightly wider between its seam and the wall.
    const double beyond = (corner + outside) * std::sqrt(cell.area());
    const double first = seam.first - beyond;
    const double last = seam.last + beyond;
    const double deepest = std::max({wall.at_first, wall.at_last, 0.0}) + cell.across + cell.down;
    const double slope = (wall.at_last - wall.at_first) / std::max(seam.last - seam.first, cell.across);
    const auto range = [&](double middle, double step, std::int32_t count) {
        const auto at = [&](double place) {
            return static_cast<std::int32_t>(
                std::clamp(std::floor(place / step), 0.0, static_cast<double>(count)));
        };
        const double reach = std::max(-first, last) + deepest;
        return std::pair(at(middle - reach), at(middle + reach + step));
    };
    const auto rows = range(seam.middle.y, cell.down, objects.rows);
    const auto cols = range(seam.middle.x, cell.across, objects.cols);
    for (std::int32_t r = rows.first; r < rows.second; ++r)
        for (std::int32_t c = cols.first; c < cols.second; ++c) {
            const double x = (c + 0.5) * cell.across - seam.middle.x;
            const double y = (r + 0.5) * cell.down - seam.middle.y;
            const double along = x * seam.along.x + y * seam.along.y;
            const double inward = x * seam.inward.x + y * seam.inward.y;
            if (along > first && along < last && inward > -cell.across - cell.down &&
                inward < wall.at_first + slope * (along - seam.first) && roofs.at(r, c) == 0)
                objects.at(r, c) = 0;
        }
}

}  // namespace d2b
