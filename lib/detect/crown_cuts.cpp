#include "detect/crown_cuts.hpp"

#include <algorithm>
#include <optional>

namespace d2b {
namespace {

constexpr double sticks_out = 0.55;    // share of a part's border that is the object's own outline
constexpr double surely_no_crown = 2;  // limit of roof_likeness()

// Stronger evidence is required if the wall is only visible beyond one end of the seam.
constexpr double sticks_out_past_an_end = 0.6;
constexpr double no_crown_past_an_end = 1.25;
constexpr double hangs_by_a_thread =
    0.9;  // beyond this the part is a separate object, such as a house behind a hedge
constexpr double largest_cell_m = 1.5;  // in larger cells a wall of three cells may be chance

/// Cuts for a crown at a corner: one line for each of the two walls.
std::vector<CutLine> corner_cuts(const CornerSeam& corner, const Mask& objects, const CellSize& cell,
                                 int eaves) {
    const std::optional<WallLine> one = wall_away_from(corner.other.middle, corner.one, objects, cell, eaves);
    const std::optional<WallLine> other =
        wall_away_from(corner.one.middle, corner.other, objects, cell, eaves);
    if (!one || !other)
        return {};
    return {{corner.one, *one}, {corner.other, *other}};
}

/// True if the walls of a corner enclose the roof, not the part, as they do in a courtyard.
bool turns_around_roof(const CornerSeam& corner) {
    const double across = corner.other.middle.x - corner.one.middle.x;
    const double down = corner.other.middle.y - corner.one.middle.y;
    return corner.one.inward.x * across + corner.one.inward.y * down > 0;
}

/// Cut for a crown that hides the end of a wall: the line of the wall visible on its other side.
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
    // A seam around a corner does not follow a single wall.
    if (cuts.empty() && seam && !(corner && turns_around_roof(*corner)))
        cuts = cut_past_an_end(part, *seam, likeness, objects, cell, eaves);
    return cuts;
}

}  // namespace d2b
