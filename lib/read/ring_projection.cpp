#include "read/ring_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"

namespace d2b::reading {
namespace {

/// Side of a box.
struct Side {
    double Position::*across;  ///< bounded coordinate
    double Position::*along;
    double limit = 0;
    bool keeps_above = true;

    [[nodiscard]] bool keeps(const Position& p) const {
        return keeps_above ? p.*across >= limit : p.*across <= limit;
    }
    [[nodiscard]] Position crossing(const Position& a, const Position& b) const {
        const double share = (limit - a.*across) / (b.*across - a.*across);
        Position p;
        p.*across = limit;
        p.*along = a.*along + (b.*along - a.*along) * share;
        return p;
    }
};

WorldRing cut(const WorldRing& ring, const Side& side) {
    WorldRing kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& from = ring[i];
        const Position& to = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (side.keeps(from))
            kept.push_back(from);
        if (side.keeps(from) != side.keeps(to))
            kept.push_back(side.crossing(from, to));
    }
    return kept;
}

constexpr double max_deviation = 0.02;  // cells
constexpr double long_edge = 16;  // cells; longer edges are halved at least twice, because an S-shaped one
                                  // may pass through the midpoint of the chord
constexpr int deepest = 12;       // at most 4096 parts per edge

constexpr double window_margin = 4;  // in sizes of the window

/// Returns a full circle of longitude in units of the CRS, or 0 for projected ones.
double full_circle_of(OGRSpatialReferenceH crs) {
    return OSRIsGeographic(crs) != FALSE ? 2 * std::numbers::pi / OSRGetAngularUnits(crs, nullptr) : 0;
}

}  // namespace

bool ClipBox::holds(std::span<const Position> ring) const {
    return std::ranges::all_of(ring, [this](const Position& p) {
        return p.x >= left && p.x <= right && p.y >= bottom && p.y <= top;
    });
}

ClipBox box_of(std::span<const WorldRing> rings) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    ClipBox box{inf, inf, -inf, -inf};
    for (const WorldRing& ring : rings)
        for (const Position& p : ring)
            box = {std::min(box.left, p.x), std::min(box.bottom, p.y), std::max(box.right, p.x),
                   std::max(box.top, p.y)};
    return box;
}

WorldRing clipped(const WorldRing& ring, const ClipBox& box) {
    if (box.holds(ring))
        return ring;
    const std::array<Side, 4> sides{Side{&Position::x, &Position::y, box.left, true},
                                    {&Position::x, &Position::y, box.right, false},
                                    {&Position::y, &Position::x, box.bottom, true},
                                    {&Position::y, &Position::x, box.top, false}};
    WorldRing kept = ring;
    if (kept.size() > 1 && kept.front() == kept.back())
        kept.pop_back();
    for (const Side& side : sides)
        kept = cut(kept, side);
    if (!kept.empty())
        kept.push_back(Position(kept.front()));
    return kept;
}

RingProjector::RingProjector(OGRCoordinateTransformationH transform, const AffineTransform& grid,
                             std::string name)
    : transform_(transform), name_(std::move(name)) {
    AffineTransform forward = grid;  // GDALInvGeoTransform() takes no const argument
    if (GDALInvGeoTransform(forward.data(), to_cells_.data()) == 0)
        throw InputError("The transform of the DEM cannot be inverted, so the " + name_ +
                         " cannot be placed.");
}

Position RingProjector::to_pixel(Position source) const {
    Position p = source;
    const GdalMessages messages;
    if (transform_ != nullptr && OCTTransform(transform_, 1, &p.x, &p.y, nullptr) == FALSE)
        p.x = HUGE_VAL;
    const AffineTransform& g = to_cells_;
    const Position pixel{g[0] + p.x * g[1] + p.y * g[2], g[3] + p.x * g[4] + p.y * g[5]};
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y))
        throw InputError("The " + name_ + " has a position that has no counterpart in the DEM's coordinate " +
                         "reference system (" + number_text(source.x) + ", " + number_text(source.y) +
                         "); clip it to the surroundings of the DEM.");
    return pixel;
}

// NOLINTNEXTLINE(misc-no-recursion): it ends with the depth
void RingProjector::densify(const Vertex& from, const Vertex& to, int depth, WorldRing& ring) const {
    Vertex middle{{(from.source.x + to.source.x) / 2, (from.source.y + to.source.y) / 2}, {}};
    middle.pixel = to_pixel(middle.source);
    const double deviation = std::hypot(middle.pixel.x - (from.pixel.x + to.pixel.x) / 2,
                                        middle.pixel.y - (from.pixel.y + to.pixel.y) / 2);
    const double length = std::hypot(to.pixel.x - from.pixel.x, to.pixel.y - from.pixel.y);
    if (depth >= deepest || (deviation < max_deviation && (depth >= 2 || length < long_edge)))
        return;
    densify(from, middle, depth + 1, ring);
    ring.push_back(middle.pixel);
    densify(middle, to, depth + 1, ring);
}

WorldRing RingProjector::project(const WorldRing& ring) const {
    WorldRing result;
    Vertex before;
    for (const Position& source : ring) {
        const Vertex vertex{source, to_pixel(source)};
        if (transform_ != nullptr && !result.empty())
            densify(before, vertex, 0, result);
        result.push_back(vertex.pixel);
        before = vertex;
    }
    return result;
}

std::optional<WorldRing> lattice_over(const Window& part, double margin, const AffineTransform& grid,
                                      OGRCoordinateTransformationH to_layer) {
    constexpr int n = 16;
    const GdalMessages quiet;
    const double rows = part.rows + 2 * margin;
    const double cols = part.cols + 2 * margin;
    WorldRing places;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) {
            const double row = part.row - margin + rows * i / n;
            const double col = part.col - margin + cols * k / n;
            Position p{grid[0] + col * grid[1] + row * grid[2], grid[3] + col * grid[4] + row * grid[5]};
            if (to_layer != nullptr && OCTTransform(to_layer, 1, &p.x, &p.y, nullptr) == FALSE)
                return std::nullopt;
            if (!std::isfinite(p.x + p.y))
                return std::nullopt;
            places.push_back(p);
        }
    return places;
}

SearchExtents search_extents(OGRSpatialReferenceH polygons, OGRSpatialReferenceH dem, const DemInfo& info) {
    const GdalMessages quiet;
    const TransformOwner back(OCTNewCoordinateTransformation(dem, polygons));
    const std::optional<WorldRing> places =
        back ? lattice_over(info.window, 0, info.transform, back.get()) : std::nullopt;
    if (!places)
        return {};
    ClipBox box = box_of({&*places, 1});
    const double turn = full_circle_of(polygons);
    if (turn > 0) {
        std::tie(box.left, box.right) = longitude_range(*places, turn);
        if (box.right < box.left)
            box.right += turn;
    }
    const double room = window_margin * std::max(box.right - box.left, box.top - box.bottom);
    box = {box.left - room, box.bottom - room, box.right + room, box.top + room};
    if (!(turn > 0))
        return {{box}, {}};
    SearchExtents found;
    found.earth.top = turn / 4 * (1 + 1e-9);
    found.earth.bottom = -found.earth.top;
    if (box.right - box.left >= turn) {
        box.left = found.earth.left;
        box.right = found.earth.right;
        found.boxes = {box};
        return found;
    }
    for (const double shift : {0.0, -turn, turn})
        found.boxes.push_back({box.left + shift, box.bottom, box.right + shift, box.top});
    return found;
}

}  // namespace d2b::reading
