#include "features/reprojection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace d2b::features {
namespace {

constexpr double max_bend = 0.1;  // distance of the midpoint from that of the image, relative to the length
constexpr int max_subdivisions = 24;        // reduces an edge of a few cells to a millionth of a cell
constexpr double projection_error = 1e-10;  // relative error of projected coordinates
constexpr double max_gap =
    0.25;  // share of the ring; above zero because datum grids have small steps at their edges
constexpr std::size_t max_cuts = std::size_t{1} << 16;  // per ring
constexpr std::size_t max_pieces = std::size_t{1} << 20;

double plain_distance(const Position& a, const Position& b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

Position middle_of(const Position& a, const Position& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/// Splits long edges into equal parts. Independent of the edge's direction, so that shared edges are split
/// alike.
WorldRing segmentize(const WorldRing& ring, double longest) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position from = ring[i];
        const Position to = ring[(i + 1) % ring.size()];
        result.push_back(from);
        const auto pieces = static_cast<std::size_t>(
            std::min(static_cast<double>(max_pieces), std::ceil(plain_distance(from, to) / longest)));
        const bool forwards = std::pair(from.x, from.y) < std::pair(to.x, to.y);
        const Position a = forwards ? from : to;
        const Position b = forwards ? to : from;
        for (std::size_t k = 1; k < pieces; ++k) {
            const double share = static_cast<double>(forwards ? k : pieces - k) / static_cast<double>(pieces);
            result.push_back({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share});
        }
    }
    return result;
}

std::vector<Position> corners_of(const Window& window, const Georeference& georeference) {
    std::vector<Position> corners;
    for (const std::int32_t row : {window.row, window.row + window.rows})
        for (const std::int32_t col : {window.col, window.col + window.cols})
            corners.push_back(georeference.position(LatticePoint{row, col}));
    return corners;
}

/// Returns the maximum length of an edge that is projected in one piece. Its image bends by about L^2 / 8R,
/// far less than a cell for this length. Edges get no more pieces than the cells they cross.
double longest_edge(const Georeference& georeference) {
    constexpr double cells = 64;
    const Position row = georeference.step(1, 0);
    const Position col = georeference.step(0, 1);
    return std::max(
        {cells * std::sqrt(georeference.cell_area()), std::hypot(row.x, row.y), std::hypot(col.x, col.y)});
}

double cross(const Position& origin, const Position& a, const Position& b) {
    return (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
}

double longest_side(const WorldRing& frame) {
    double longest = 0;
    for (std::size_t i = 1; i < frame.size(); ++i)
        longest = std::max(longest, std::hypot(frame[i].x - frame[i - 1].x, frame[i].y - frame[i - 1].y));
    return longest;
}

/// True if the projection turns the frame inside out, as around the antipode of an azimuthal projection: the
/// orientation of small steps at a corner then differs from that of the whole frame.
bool is_inside_out(const WorldRing& frame, const WorldRing& image, RingTransform& transform) {
    constexpr double step = 1e-5;  // small enough for curves to look straight
    constexpr double flattest = 1e-6;
    const auto towards = [&](const Position& to) {
        return Position{frame[0].x + (to.x - frame[0].x) * step, frame[0].y + (to.y - frame[0].y) * step};
    };
    const std::array<Position, 3> steps{frame[0], towards(frame[1]), towards(frame[3])};
    std::array<Position, 3> images = steps;
    if (!transform.apply_to_positions(images))
        return false;
    const double turn = cross(images[0], images[1], images[2]);
    const double sides = std::hypot(images[1].x - images[0].x, images[1].y - images[0].y) *
                         std::hypot(images[2].x - images[0].x, images[2].y - images[0].y);
    const bool kept = (twice_area(frame) > 0) == (twice_area(image) > 0);
    const bool kept_here = (cross(steps[0], steps[1], steps[2]) > 0) == (turn > 0);
    return std::abs(turn) > flattest * sides && kept != kept_here;
}

/// Returns metres; nullopt if a part of the frame is outside of the projection's domain.
std::optional<double> length_on_ground(const WorldRing& frame, const Crs& crs) {
    try {
        return Geodesy(crs).ring(frame).perimeter_m;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

std::optional<RingTransform> output_transform(const Crs& crs, const Crs& target,
                                              const Georeference& georeference, const Window& window,
                                              const StopToken& stop) {
    if (target.kind() == Crs::Kind::none)
        return std::nullopt;
    return RingTransform(crs, target, corners_of(window, georeference), longest_edge(georeference), stop);
}

double length_of(std::span<const Position> ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        sum += plain_distance(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    return sum;
}

double twice_area(std::span<const Position> ring) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += cross(ring[0], ring[i], ring[i + 1]);
    return sum;
}

RingTransform::RingTransform(const Crs& from, const Crs& to, std::span<const Position> area, double longest,
                             StopToken stop)
    : transform_(from, to, area), stop_(std::move(stop)), longest_(longest), turn_(to.turn()) {}

bool RingTransform::apply_to_positions(std::span<Position> positions) {
    constexpr std::size_t at_once = 10000;  // takes about 10 ms
    bool all = true;
    for (; !positions.empty(); positions = positions.subspan(std::min(positions.size(), at_once))) {
        stop_.check();
        all = transform_.try_apply(positions.first(std::min(positions.size(), at_once))) && all;
    }
    return all;
}

/// Scales longitudes by the cosine of the latitude, because a degree of longitude is short near a pole.
double RingTransform::distance(const Position& a, const Position& b) const {
    const double width = turn_ > 0 ? std::cos((a.y + b.y) * std::numbers::pi / turn_) : 1;
    return std::hypot((b.x - a.x) * width, b.y - a.y);
}

/// True if the image of an edge's midpoint is close to the midpoint of its image. @param middle image of the
/// midpoint
bool RingTransform::has_straight_image(const Position& from, const Position& middle,
                                       const Position& to) const {
    const double off = distance(middle, middle_of(from, to));
    const double largest = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
    return off <= std::max(max_bend * distance(from, to), projection_error * largest);
}

RingProjection RingTransform::apply(WorldRing& ring) {
    const WorldRing source = segmentize(ring, longest_);
    ring = source;
    return apply_to_positions(ring) ? subdivide_bent_edges(source, ring) : RingProjection::no_image;
}

RingProjection RingTransform::apply_with_elevations(WorldRing& ring, std::span<const double> elevations,
                                                    std::vector<double>& projected) {
    WorldRing corners = ring;
    const RingProjection projection = apply(ring);
    if (projection != RingProjection::whole || !apply_to_positions(corners))
        return projection == RingProjection::whole ? RingProjection::no_image : projection;
    std::size_t corner = 0;
    for (const Position& p : ring) {
        while (corner + 1 < corners.size() && p == corners[corner + 1])
            ++corner;
        const std::size_t next = corner + 1 < corners.size() ? corner + 1 : 0;
        const double length = plain_distance(corners[corner], corners[next]);
        const double share = length > 0 ? plain_distance(corners[corner], p) / length : 0;
        projected.push_back(elevations[corner] + share * (elevations[next] - elevations[corner]));
    }
    return projection;
}

/// Tests all midpoints in one batch first, because almost no ring has a bent edge.
RingProjection RingTransform::subdivide_bent_edges(const WorldRing& source, WorldRing& images) {
    const std::size_t n = source.size();
    const auto next = [n](std::size_t i) { return i + 1 == n ? 0 : i + 1; };
    WorldRing middles(n);
    for (std::size_t i = 0; i < n; ++i)
        middles[i] = middle_of(source[i], source[next(i)]);
    const bool known = apply_to_positions(middles);
    const auto is_straight = [&](std::size_t i) {
        return has_straight_image(images[i], middles[i], images[next(i)]);
    };
    std::size_t bent = 0;
    while (known && bent < n && is_straight(bent))
        ++bent;
    if (bent == n)
        return RingProjection::whole;
    smooth_ = jump_ = 0;
    cuts_ = 0;
    WorldRing pieces;
    for (std::size_t i = 0; i < n; ++i) {
        pieces.push_back(images[i]);
        const std::size_t size = pieces.size();
        const double jump = std::exchange(jump_, 0);
        subdivide({source[i], images[i]}, {source[next(i)], images[next(i)]}, max_subdivisions, pieces);
        if (jump_ > 0)  // subdivision did not help
            pieces.resize(size);
        jump_ = std::max(jump, jump_);
    }
    images = std::move(pieces);
    return jump_ <= max_gap * smooth_ ? RingProjection::whole : RingProjection::split;
}

/// Adds the vertices needed between the ends of an edge.
// NOLINTNEXTLINE(misc-no-recursion): it ends with the halvings
void RingTransform::subdivide(const End& from, const End& to, int halvings, WorldRing& pieces) {
    End middle{middle_of(from.source, to.source), {}};
    middle.image = middle.source;
    const double length = distance(from.image, to.image);
    if (!transform_.try_apply({&middle.image, 1})) {
        jump_ = std::numeric_limits<double>::infinity();
    } else if (has_straight_image(from.image, middle.image, to.image)) {
        smooth_ += length;
    } else if (halvings == 0 || ++cuts_ > max_cuts) {
        jump_ = std::max(jump_, length);
    } else {
        subdivide(from, middle, halvings - 1, pieces);
        pieces.push_back(middle.image);
        subdivide(middle, to, halvings - 1, pieces);
    }
}

LatticeBox lattice_frame(const Window& window, TraceMode mode) {
    const std::int32_t less = mode == TraceMode::points ? 1 : 0;
    return {{window.row, window.col}, {window.row + window.rows - less, window.col + window.cols - less}};
}

bool is_overstretched(double length, const Crs& crs, double ground_m) {
    constexpr double most = 1000;
    const auto unit = crs.horizontal_unit();
    return unit && length * unit->metres > most * ground_m;
}

Position require_projectable(const DemInfo& info, const RunPlan& plan, const Crs& crs, const Crs& target) {
    const TraceMode mode = plan.trace;
    const Georeference georeference(info.transform, mode);
    const Window& w = info.window;
    Position middle = georeference.position(LatticePoint{w.row + w.rows / 2, w.col + w.cols / 2});
    if (target.kind() == Crs::Kind::none)
        return middle;
    const WorldRing frame = georeference.corners(lattice_frame(w, mode));
    constexpr double pieces = 64;  // initial pieces per side
    const double longest = longest_side(frame) / pieces;
    RingTransform transform(crs, target, frame, longest);
    static_cast<void>(transform.apply_to_positions({&middle, 1}));
    WorldRing image = frame;
    // A single point has no frame, and areas without data do not need an image.
    if (!(longest > 0))
        return middle;
    const RingProjection fate = transform.apply(image);
    if (fate == RingProjection::no_image)
        return middle;
    const auto ground_m = length_on_ground(frame, crs);
    if (fate == RingProjection::split || is_inside_out(frame, image, transform) ||
        (ground_m && is_overstretched(length_of(image), target, *ground_m)))
        throw split_by_projection_error(info.name, display_name(target, plan.asked.outline.target_crs));
    return middle;
}

std::string display_name(const Crs& crs, const std::string& given) {
    const std::string name = crs.name();
    return given.empty() || (name != "unknown" && name != "unnamed") ? name : given;
}

InputError split_by_projection_error(const std::string& input, const std::string& target) {
    return InputError("'" + input + "' cannot be converted to '" + target +
                      "', which splits the area or distorts it too much (for example across 180 degrees, "
                      "over a pole or far from the area of use); choose another -t_srs, such as the UTM zone "
                      "of the area, or use a part of the raster (-srcwin, -projwin or -te).");
}

}  // namespace d2b::features
