#include "detect/crown_cuts.hpp"

#include <algorithm>
#include <optional>

namespace d2b {
namespace {

constexpr double sticks_out = 0.55;    // share of a part's border that is the object's own
constexpr double surely_no_crown = 2;  // of roof_likeness()

// Where a wall is seen beyond one end of the seam alone, more has to speak for a crown.
constexpr double sticks_out_past_an_end = 0.6;
constexpr double no_crown_past_an_end = 1.25;
constexpr double hangs_by_a_thread = 0.9;  // what does is an object of its own, as a house beyond a hedge
constexpr double largest_cell_m = 1.5;     // in larger ones a wall of three cells may be chance

/// Of a crown at a corner: a line for each of the two walls.
std::vector<CutLine> corner_cuts(const CornerSeam& corner, const Mask& objects, const CellSize& cell,
                                 int eaves) {
    const std::optional<WallLine> one = wall_away_from(corner.other.middle, corner.one, objects, cell, eaves);
    const std::optional<WallLine> other =
        wall_away_from(corner.one.middle, corner.other, objects, cell, eaves);
    if (!one || !other)
        return {};
    return {{corner.one, *one}, {corner.other, *other}};
}

/// Whether the walls of a corner turn around the roof, not around the part as they do in a court.
bool turns_around_roof(const CornerSeam& corner) {
    const double across = corner.other.middle.x - corner.one.middle.x;
    const double down = corner.other.middle.y - corner.one.middle.y;
    return corner.one.inward.x * across + corner.one.inward.y * down > 0;
}

/// Of a crown that hides where a wall ends: the line of the wall that is seen on its other side.
std::vector<CutLine> cut_past_an_end(const PartSeam& part, const SeamLine& seam, double likeness,
                                     const Mask& objects, const CellSize& cell, int eaves) {
    const double free = part.free_share();
    if (std::max(cell.across, cell.down) > largest_cell_m || free <= sticks_out_past_an_end ||
        free >= hangs_by_a_thread || likeness >= no_crown_past_an_end)
        return {};
    const std::optional<WallLine> wall = wall_beyond_one_end(seam, objects, cell, eaves);
    return wall ? std::vector<CutLine>{{seam, *wall}} : std::vector<CutLine>{};
}

}  // namespace

std::vector<CutLine> crown_cuts(const PartSeam& part, const Evidence& evidence, const Mask& objects,
                                const CellSize& cell, int eaves) {
    const double likeness = roof_likeness(evidence);
    if (part.free_share() <= sticks_out || likeness >= surely_no_crown)
        return {};
    const std::optional<SeamLine> seam = part.straight_line(cell);
    if (const std::optional<WallLine> wall = seam ? wall_beyond(*seam, objects, cell, eaves) : std::nullopt)
        return {{*seam, *wall}};
    const std::optional<CornerSeam> corner = part.corner(cell);
    std::vector<CutLine> cuts;
    if (corner)
        cuts = corner_cuts(*corner, objects, cell, eaves);
    // Around a corner a seam is no wall's.
    if (cuts.empty() && seam && !(corner && turns_around_roof(*corner)))
        cuts = cut_past_an_end(part, *seam, likeness, objects, cell, eaves);
    return cuts;
}

}  // namespace d2b
