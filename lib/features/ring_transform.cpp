#include "features/ring_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr double most_bend = 0.1;  // distance of the midpoint from that of the image, relative to the length
constexpr int most_halvings = 24;  // reduces an edge of a few cells to a millionth of a cell
constexpr double projection_error = 1e-10;  // relative error of projected coordinates
constexpr double widest_gap =
    0.25;  // share of the ring; above zero because datum grids have small steps at their edges
constexpr std::size_t most_cuts = std::size_t{1} << 16;  // per ring
constexpr std::size_t most_pieces = std::size_t{1} << 20;

double plain_distance(const Position& a, const Position& b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

Position middle_of(const Position& a, const Position& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/// Splits long edges into equal parts. Independent of the edge's direction, so that shared edges are split
/// alike.
WorldRing with_short_edges(const WorldRing& ring, double longest) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position from = ring[i];
        const Position to = ring[(i + 1) % ring.size()];
        result.push_back(from);
        const auto pieces = static_cast<std::size_t>(
            std::min(static_cast<double>(most_pieces), std::ceil(plain_distance(from, to) / longest)));
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

}  // namespace

std::optional<RingTransform> output_transform(const Crs& crs, const Crs& target,
                                              const Georeference& georeference, const Window& window,
                                              const StopRequest& stop) {
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

RingTransform::RingTransform(const Crs& from, const Crs& to, std::span<const Position> area, double longest,
                             StopRequest stop)
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
bool RingTransform::runs_straight(const Position& from, const Position& middle, const Position& to) const {
    const double off = distance(middle, middle_of(from, to));
    const double largest = std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
    return off <= std::max(most_bend * distance(from, to), projection_error * largest);
}

RingFate RingTransform::apply(WorldRing& ring) {
    const WorldRing source = with_short_edges(ring, longest_);
    ring = source;
    return apply_to_positions(ring) ? cut_where_bent(source, ring) : RingFate::without_image;
}

/// Tests all midpoints in one batch first, because almost no ring has a bent edge.
RingFate RingTransform::cut_where_bent(const WorldRing& source, WorldRing& images) {
    const std::size_t n = source.size();
    const auto next = [n](std::size_t i) { return i + 1 == n ? 0 : i + 1; };
    WorldRing middles(n);
    for (std::size_t i = 0; i < n; ++i)
        middles[i] = middle_of(source[i], source[next(i)]);
    const bool known = apply_to_positions(middles);
    const auto is_straight = [&](std::size_t i) {
        return runs_straight(images[i], middles[i], images[next(i)]);
    };
    std::size_t bent = 0;
    while (known && bent < n && is_straight(bent))
        ++bent;
    if (bent == n)
        return RingFate::whole;
    smooth_ = jump_ = 0;
    cuts_ = 0;
    WorldRing pieces;
    for (std::size_t i = 0; i < n; ++i) {
        pieces.push_back(images[i]);
        const std::size_t size = pieces.size();
        const double jump = std::exchange(jump_, 0);
        cut({source[i], images[i]}, {source[next(i)], images[next(i)]}, most_halvings, pieces);
        if (jump_ > 0)  // subdivision did not help
            pieces.resize(size);
        jump_ = std::max(jump, jump_);
    }
    images = std::move(pieces);
    return jump_ <= widest_gap * smooth_ ? RingFate::whole : RingFate::torn;
}

/// Adds the vertices needed between the ends of an edge.
// NOLINTNEXTLINE(misc-no-recursion): it ends with the halvings
void RingTransform::cut(const End& from, const End& to, int halvings, WorldRing& pieces) {
    End middle{middle_of(from.source, to.source), {}};
    middle.image = middle.source;
    const double length = distance(from.image, to.image);
    if (!transform_.try_apply({&middle.image, 1})) {
        jump_ = std::numeric_limits<double>::infinity();
    } else if (runs_straight(from.image, middle.image, to.image)) {
        smooth_ += length;
    } else if (halvings == 0 || ++cuts_ > most_cuts) {
        jump_ = std::max(jump_, length);
    } else {
        cut(from, middle, halvings - 1, pieces);
        pieces.push_back(middle.image);
        cut(middle, to, halvings - 1, pieces);
    }
}

}  // namespace d2b
