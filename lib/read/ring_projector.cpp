#include "read/ring_projector.hpp"

#include <cmath>
#include <utility>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

namespace {

constexpr double most_deviation = 0.02;  // cells
constexpr double long_edge = 16;  // cells; longer edges are halved at least twice, because an S-shaped one
                                  // may pass through the midpoint of the chord
constexpr int deepest = 12;       // at most 4096 parts per edge

}  // namespace

RingProjector::RingProjector(OGRCoordinateTransformationH transform, const AffineTransform& grid,
                             std::string name)
    : transform_(transform), name_(std::move(name)) {
    AffineTransform forward = grid;  // GDALInvGeoTransform() takes no const argument
    if (GDALInvGeoTransform(forward.data(), to_cells_.data()) == 0)
        throw InputError("The transform of the DEM cannot be inverted, so that the " + name_ +
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
        throw InputError("The " + name_ + " has a position without an image in the DEM's coordinate " +
                         "reference system (" + number_text(source.x) + ", " + number_text(source.y) +
                         "); clip it to the surroundings of the DEM.");
    return pixel;
}

// NOLINTNEXTLINE(misc-no-recursion): it ends with the depth
void RingProjector::add_between(const Vertex& from, const Vertex& to, int depth, WorldRing& ring) const {
    Vertex middle{{(from.source.x + to.source.x) / 2, (from.source.y + to.source.y) / 2}, {}};
    middle.pixel = to_pixel(middle.source);
    const double deviation = std::hypot(middle.pixel.x - (from.pixel.x + to.pixel.x) / 2,
                                        middle.pixel.y - (from.pixel.y + to.pixel.y) / 2);
    const double length = std::hypot(to.pixel.x - from.pixel.x, to.pixel.y - from.pixel.y);
    if (depth >= deepest || (deviation < most_deviation && (depth >= 2 || length < long_edge)))
        return;
    add_between(from, middle, depth + 1, ring);
    ring.push_back(middle.pixel);
    add_between(middle, to, depth + 1, ring);
}

WorldRing RingProjector::project(const WorldRing& ring) {
    WorldRing result;
    Vertex before;
    for (const Position& source : ring) {
        const Vertex vertex{source, to_pixel(source)};
        if (transform_ != nullptr && !result.empty())
            add_between(before, vertex, 0, result);
        result.push_back(vertex.pixel);
        before = vertex;
    }
    return result;
}

}  // namespace d2b
