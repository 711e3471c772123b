#include "detect/tree_crowns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/grid.hpp"
#include "detect/detection.hpp"
#include "raster/morphology.hpp"

namespace d2b::detect {

/// Line along which a crown is cut off.
struct CutLine {
    BoundaryLine seam;
    WallLine wall;
};

/// Returns the lines along which a part of an object is cut off as a crown: one if a wall continues beyond
/// both ends of the seam, two at a corner, or one if the crown hides the other end of the wall; none if the
/// part stays.
/// @param objects cells of all objects
/// @param eaves maximum distance of a seam outside of its wall, in cells
[[nodiscard]] std::vector<CutLine> crown_cuts(const SharedBoundary& part, const ObjectFeatures& features,
                                              const Mask& objects, const CellSize& cell, int eaves);

namespace {

// Length of the wall that is tested on either side: half of the seam's length, within these limits.
constexpr double shortest_wall_m = 3;
constexpr double shortest_wall = 3;  // cells
constexpr double longest_wall_m = 8;
constexpr double corner_cells = 2;   // cells next to the seam that the crown's own border may cover
constexpr double sample_step = 0.5;  // cells
constexpr double in_line = 0.7;      // share of the samples
constexpr int wall_tolerance = 1;    // cells that a wall may lie outside of its seam, and inside of the eaves

/// Samples the mask of objects in coordinates along and across a seam.
class SeamSampler {
  public:
    SeamSampler(const BoundaryLine& seam, const CellSize& cell, const Mask& objects)
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
    const BoundaryLine& seam_;
    const CellSize& cell_;
    const Mask& objects_;
};

/// Point on a wall beyond one end of a seam.
struct WallPoint {
    double along = 0;
    double inward = 0;
};

/// @param way 1 or -1: forwards or backwards along the line
std::optional<WallPoint> wall_after(double end, int way, double wall, double side, int eaves,
                                    const SeamSampler& beside) {
    const int samples = 1 + static_cast<int>(wall / (sample_step * side));
    int hits = 0;
    WallPoint sum;
    for (int i = 0; i < samples; ++i) {
        const double along = end + way * (corner_cells + i * sample_step) * side;
        if (beside.object_at(along, -wall_tolerance * side) != 0 ||
            beside.object_at(along, (eaves + wall_tolerance) * side) != 1)
            continue;
        int quarters = 1;
        while (quarters < 4 * (eaves + 2 * wall_tolerance) &&
               beside.object_at(along, (0.25 * quarters - wall_tolerance) * side) != 1)
            ++quarters;
        ++hits;
        sum.along += along;
        sum.inward += (0.25 * (quarters - 0.5) - wall_tolerance) * side;
    }
    if (hits < in_line * samples)
        return std::nullopt;
    return WallPoint{sum.along / hits, sum.inward / hits};
}

double tested_length(const BoundaryLine& seam, double side) {
    return std::max(
        {shortest_wall_m, shortest_wall * side, std::min((seam.last - seam.first) / 2, longest_wall_m)});
}

/// @param is_last true for the last end of the seam
std::optional<WallLine> wall_at_end(const BoundaryLine& seam, bool is_last, const Mask& objects,
                                    const CellSize& cell, int eaves) {
    const double side = std::sqrt(cell.area());
    const std::optional<WallPoint> wall =
        wall_after(is_last ? seam.last : seam.first, is_last ? 1 : -1, tested_length(seam, side), side, eaves,
                   SeamSampler(seam, cell, objects));
    return wall ? std::optional(WallLine{wall->inward, wall->inward}) : std::nullopt;
}

constexpr double straight = 1.3;         // RMS in cells
constexpr std::size_t fewest_edges = 4;  // minimum per line at a corner
constexpr double sharpest = 0.8;         // cosine of the angle between two walls
constexpr int rounds_of_halving = 8;

double distance_along(const BoundaryLine& line, const MetricPoint& place) {
    return (place.x - line.middle.x) * line.along.x + (place.y - line.middle.y) * line.along.y;
}

double distance_from(const BoundaryLine& line, const MetricPoint& place) {
    return std::abs((place.x - line.middle.x) * line.inward.x + (place.y - line.middle.y) * line.inward.y);
}

constexpr double sticks_out = 0.55;    // share of a part's border that is the object's own outline
constexpr double surely_no_crown = 2;  // limit of roof_score()

// Stronger evidence is required if the wall is only visible beyond one end of the seam.
constexpr double sticks_out_past_an_end = 0.6;
constexpr double no_crown_past_an_end = 1.25;
constexpr double hangs_by_a_thread =
    0.9;  // beyond this the part is a separate object, such as a house behind a hedge
constexpr double largest_cell_m = 1.5;  // in larger cells a wall of three cells may be chance

/// Cuts for a crown at a corner: one line for each of the two walls.
std::vector<CutLine> corner_cuts(const CornerBoundary& corner, const Mask& objects, const CellSize& cell,
                                 int eaves) {
    const std::optional<WallLine> one = wall_away_from(corner.other.middle, corner.one, objects, cell, eaves);
    const std::optional<WallLine> other =
        wall_away_from(corner.one.middle, corner.other, objects, cell, eaves);
    if (!one || !other)
        return {};
    return {{corner.one, *one}, {corner.other, *other}};
}

/// True if the walls of a corner enclose the roof, not the part, as they do in a courtyard.
bool turns_around_roof(const CornerBoundary& corner) {
    const double across = corner.other.middle.x - corner.one.middle.x;
    const double down = corner.other.middle.y - corner.one.middle.y;
    return corner.one.inward.x * across + corner.one.inward.y * down > 0;
}

/// Cut for a crown that hides the end of a wall: the line of the wall visible on its other side.
std::vector<CutLine> cut_past_an_end(const SharedBoundary& part, const BoundaryLine& seam, double score,
                                     const Mask& objects, const CellSize& cell, int eaves) {
    const double free = part.free_share();
    if (std::max(cell.across, cell.down) > largest_cell_m || free <= sticks_out_past_an_end ||
        free >= hangs_by_a_thread || score >= no_crown_past_an_end)
        return {};
    const std::optional<WallLine> wall = wall_beyond_one_end(seam, objects, cell, eaves);
    return wall ? std::vector<CutLine>{{seam, *wall}} : std::vector<CutLine>{};
}

constexpr double large_segment_m2 = 50;
constexpr double eaves_m = 1;
constexpr double least_crown_m2 = 4;

/// Returns the cells of large smooth segments.
Mask roofs_of(const Scene& scene, const SmoothSegments& segments, const Mask& objects, Executor& threads) {
    const std::int64_t least = cells_covering(large_segment_m2, scene.cell);
    Mask roofs(objects.rows, objects.cols, 0, threads);
    for_rows(threads, objects.rows, objects.cols, [&](std::int32_t r) {
        for (const RegionRun& run : segments.regions.row(r))
            if (segments.pieces[run.label - 1].cells >= least)
                std::copy(objects.row(r).begin() + run.begin, objects.row(r).begin() + run.end,
                          roofs.row(r).begin() + run.begin);
    });
    return roofs;
}

Regions parts_beside(const Mask& roofs, const Mask& objects, std::int64_t min_cells, Executor& threads) {
    Mask rest = Mask::unset(objects.rows, objects.cols, threads);
    for_rows(threads, objects.rows, objects.cols, [&](std::int32_t r) {
        const std::span<const std::uint8_t> object = objects.row(r);
        const std::span<const std::uint8_t> roof = roofs.row(r);
        const std::span<std::uint8_t> out = rest.row(r);
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c] = object[c] > roof[c] ? 1 : 0;
    });
    return connected_regions(rest, 1, min_cells, threads);
}

/// Clears the parts to be cut.
std::vector<CutCrown> clear(const Regions& parts, const std::vector<std::vector<CutLine>>& cuts,
                            Mask& objects, Executor& threads) {
    const auto is_cut = [&](Label label) { return !cuts[label - 1].empty(); };
    paint(parts, is_cut, 0, objects, threads);
    std::vector<CutCrown> crowns;
    for_first_runs(parts, [&](std::int32_t r, const RegionRun& run) {
        if (is_cut(run.label))
            crowns.push_back({{r, run.begin}, parts.cells[run.label]});
    });
    return crowns;
}

/// Relabels the remaining cells. Each new object inherits the classification of the object it was part of.
void relabel_remaining(const Mask& cells, std::int64_t min_cells, Candidates& judged, Executor& threads) {
    Candidates left;
    left.regions = connected_regions(cells, 1, 0, threads);
    const std::vector<FirstCell> small = remove_small(left.regions, min_cells);
    judged.rejected.small.insert(judged.rejected.small.end(), small.begin(), small.end());
    for_first_runs(left.regions, [&](std::int32_t r, const RegionRun& run) {
        const Label whole = run_at(judged.regions.row(r), run.begin)->label;
        left.objects.push_back(judged.objects[whole - 1]);
        left.objects.back().cells = left.regions.cells[run.label];
        left.features.push_back(judged.features[whole - 1]);
    });
    judged.regions = std::move(left.regions);
    judged.objects = std::move(left.objects);
    judged.features = std::move(left.features);
}

}  // namespace

std::optional<WallLine> wall_beyond(const BoundaryLine& seam, const Mask& objects, const CellSize& cell,
                                    int eaves) {
    const double side = std::sqrt(cell.area());
    const double wall = tested_length(seam, side);
    const SeamSampler beside(seam, cell, objects);
    const std::optional<WallPoint> after = wall_after(seam.last, 1, wall, side, eaves, beside);
    if (!after)
        return std::nullopt;
    const std::optional<WallPoint> before = wall_after(seam.first, -1, wall, side, eaves, beside);
    if (!before)
        return std::nullopt;
    const double slope = (after->inward - before->inward) / (after->along - before->along);
    return WallLine{before->inward + slope * (seam.first - before->along),
                    before->inward + slope * (seam.last - before->along)};
}

std::optional<WallLine> wall_away_from(const MetricPoint& meeting, const BoundaryLine& seam,
                                       const Mask& objects, const CellSize& cell, int eaves) {
    const double at_meeting =
        (meeting.x - seam.middle.x) * seam.along.x + (meeting.y - seam.middle.y) * seam.along.y;
    return wall_at_end(seam, at_meeting < (seam.first + seam.last) / 2, objects, cell, eaves);
}

std::optional<WallLine> wall_beyond_one_end(const BoundaryLine& seam, const Mask& objects,
                                            const CellSize& cell, int eaves) {
    const std::optional<WallLine> wall = wall_at_end(seam, true, objects, cell, eaves);
    return wall ? wall : wall_at_end(seam, false, objects, cell, eaves);
}

void clear_beyond_wall(const BoundaryLine& seam, const WallLine& wall, const Mask& roofs,
                       const CellSize& cell, Mask& objects) {
    // A crown is slightly wider between its seam and the wall.
    const double beyond = (corner_cells + wall_tolerance) * std::sqrt(cell.area());
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

void SharedBoundary::add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell) {
    edges_.push_back({{(col + 0.5 + 0.5 * across) * cell.across, (row + 0.5 + 0.5 * down) * cell.down},
                      {across * cell.down, down * cell.across}});
}

double SharedBoundary::free_share() const {
    const auto free = static_cast<double>(free_);
    return edges_.empty() ? 1 : free / (free + static_cast<double>(edges_.size()));
}

std::optional<BoundaryLine> SharedBoundary::straight_line(const CellSize& cell) const {
    return fitted_line(straight * straight * cell.area());
}

std::optional<BoundaryLine> SharedBoundary::fitted_line(double most_squared) const {
    if (edges_.empty())
        return std::nullopt;
    const auto n = static_cast<double>(edges_.size());
    BoundaryLine line;
    MetricPoint to_rest;
    for (const auto& [p, way] : edges_) {
        line.middle.x += p.x / n;
        line.middle.y += p.y / n;
        to_rest.x += way.x;
        to_rest.y += way.y;
    }
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const auto& [p, way] : edges_) {
        const double x = p.x - line.middle.x;
        const double y = p.y - line.middle.y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    const double spread = std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
    if ((xx + yy - spread) / 2 > n * most_squared)
        return std::nullopt;
    // Half the angle of (xx - yy, 2 xy).
    const double turned = spread > 0 ? (xx - yy) / spread : 1;
    line.along = {std::sqrt((1 + turned) / 2), std::copysign(std::sqrt((1 - turned) / 2), xy)};
    line.inward = {-line.along.y, line.along.x};
    if (line.inward.x * to_rest.x + line.inward.y * to_rest.y < 0)
        line.inward = {line.along.y, -line.along.x};
    for (const auto& [p, way] : edges_) {
        const double t = distance_along(line, p);
        line.first = std::min(line.first, t);
        line.last = std::max(line.last, t);
    }
    return line;
}

SharedBoundary SharedBoundary::half(const std::vector<std::uint8_t>& is_second, std::uint8_t which) const {
    SharedBoundary some;
    for (std::size_t i = 0; i < edges_.size(); ++i)
        if (is_second[i] == which)
            some.edges_.push_back(edges_[i]);
    return some;
}

std::optional<CornerBoundary> SharedBoundary::corner(const CellSize& cell) const {
    constexpr double any = std::numeric_limits<double>::infinity();
    const std::optional<BoundaryLine> whole = fitted_line(any);
    if (!whole)
        return std::nullopt;
    // Fits two lines by k-means, starting from a division in the middle: each edge is assigned to the nearer
    // line, then the lines are fitted again.
    std::vector<std::uint8_t> is_second(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i)
        is_second[i] = distance_along(*whole, edges_[i].middle) > 0 ? 1 : 0;
    for (int round = 0; round < rounds_of_halving; ++round) {
        const std::optional<BoundaryLine> one = half(is_second, 0).fitted_line(any);
        const std::optional<BoundaryLine> other = half(is_second, 1).fitted_line(any);
        if (!one || !other)
            return std::nullopt;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            is_second[i] =
                distance_from(*other, edges_[i].middle) < distance_from(*one, edges_[i].middle) ? 1 : 0;
    }
    const SharedBoundary first = half(is_second, 0);
    const SharedBoundary second = half(is_second, 1);
    const std::optional<BoundaryLine> one = first.straight_line(cell);
    const std::optional<BoundaryLine> other = second.straight_line(cell);
    if (!one || !other || std::min(first.edges_.size(), second.edges_.size()) < fewest_edges ||
        std::abs(one->along.x * other->along.x + one->along.y * other->along.y) > sharpest)
        return std::nullopt;
    return CornerBoundary{*one, *other};
}

std::vector<SharedBoundary> shared_boundaries(const ObjectRegions& parts, const Mask& rest,
                                              const CellSize& cell, Executor& threads) {
    std::vector<SharedBoundary> seams(parts.regions.count());
    for_runs_by_label(threads, parts.regions, [&](std::int32_t r, const RegionRun& run) {
        SharedBoundary& seam = seams[run.label - 1];
        const auto visit = [&](std::int32_t c, int down, int across) {
            const std::int32_t y = r + down;
            const std::int32_t x = c + across;
            if (y < 0 || x < 0 || y >= rest.rows || x >= rest.cols)
                return;
            if (rest.at(y, x) != 0)
                seam.add(r, c, down, across, cell);
            else if (parts.cells.at(y, x) == 0)
                seam.add_free();
        };
        visit(run.begin, 0, -1);
        visit(run.end - 1, 0, 1);
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            visit(c, -1, 0);
            visit(c, 1, 0);
        }
    });
    return seams;
}

std::vector<CutLine> crown_cuts(const SharedBoundary& part, const ObjectFeatures& features,
                                const Mask& objects, const CellSize& cell, int eaves) {
    const double score = roof_score(features);
    if (part.free_share() <= sticks_out || score >= surely_no_crown)
        return {};
    const std::optional<BoundaryLine> seam = part.straight_line(cell);
    if (const std::optional<WallLine> wall = seam ? wall_beyond(*seam, objects, cell, eaves) : std::nullopt)
        return {{*seam, *wall}};
    const std::optional<CornerBoundary> corner = part.corner(cell);
    std::vector<CutLine> cuts;
    if (corner)
        cuts = corner_cuts(*corner, objects, cell, eaves);
    // A seam around a corner does not follow a single wall.
    if (cuts.empty() && seam && !(corner && turns_around_roof(*corner)))
        cuts = cut_past_an_end(part, *seam, score, objects, cell, eaves);
    return cuts;
}

std::vector<CutCrown> remove_attached_crowns(const Scene& scene, const SmoothSegments& segments,
                                             const Grid<std::uint8_t>& flags, std::int64_t min_cells,
                                             Mask cells, Candidates& judged, Executor& threads) {
    const int eaves = std::max(1, static_cast<int>(std::lround(eaves_m / scene.side())));
    const Mask roofs = roofs_of(scene, segments, cells, threads);
    const Mask near_roofs = dilate_within(roofs, cells, eaves, threads);
    ObjectRegions parts{std::move(cells), {}};
    parts.regions =
        parts_beside(near_roofs, parts.cells, cells_covering(least_crown_m2, scene.cell), threads);
    const std::vector<SharedBoundary> seams = shared_boundaries(parts, near_roofs, scene.cell, threads);
    const std::vector<ObjectFeatures> features = compute_features(scene, parts, segments, flags, threads);
    std::vector<std::vector<CutLine>> cuts(seams.size());
    threads.for_each(seams.size(), [&](std::size_t i) {
        cuts[i] = crown_cuts(seams[i], features[i], parts.cells, scene.cell, eaves);
    });
    std::vector<CutCrown> crowns = clear(parts.regions, cuts, parts.cells, threads);
    for (const std::vector<CutLine>& lines : cuts)
        for (const CutLine& cut : lines)
            clear_beyond_wall(cut.seam, cut.wall, roofs, scene.cell, parts.cells);
    if (!crowns.empty())
        relabel_remaining(parts.cells, min_cells, judged, threads);
    return crowns;
}

}  // namespace d2b::detect
