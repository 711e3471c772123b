#include "outline/walls/frame_walls.hpp"

#include <cstdint>
#include <cstdlib>

namespace d2b::outline {
namespace {

constexpr std::size_t longest_dent = 8;  // steps by which a wall leaves the edge of the raster

enum class Side : std::uint8_t { none, top, bottom, left, right };

/// Side of the frame along which an edge of a trace runs.
Side side_of(LatticePoint a, LatticePoint b, const LatticeBox& frame) {
    const auto both_in = [&](std::int32_t LatticePoint::*at, std::int32_t line) {
        return a.*at == line && b.*at == line;
    };
    return both_in(&LatticePoint::row, frame.low.row)    ? Side::top
           : both_in(&LatticePoint::row, frame.high.row) ? Side::bottom
           : both_in(&LatticePoint::col, frame.low.col)  ? Side::left
           : both_in(&LatticePoint::col, frame.high.col) ? Side::right
                                                         : Side::none;
}

/// True if a wall goes on after a dent of a cell, which is noise of the trace.
bool goes_on(const TraceSums& samples, const WallSegment& wall, std::size_t first) {
    return first - wall.last <= longest_dent &&
           dot(samples.at(first) - samples.at(wall.last), wall.line.along) > 0 &&
           samples.near(wall.last, first, wall.line, 1.01 * samples.longest_step());
}

}  // namespace

std::vector<WallSegment> walls_on_frame(const Chain& chain, const TraceSums& samples,
                                        const LatticeBox& frame) {
    std::vector<WallSegment> walls;
    Side side_before = Side::none;
    const std::size_t corners = chain.trace.size();
    std::size_t last = 0;
    // A closed chain begins at a corner, so that none of its walls is divided.
    for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < corners; ++i) {
        const LatticePoint a = chain.trace[i];
        const LatticePoint b = chain.trace[i + 1 < corners ? i + 1 : 0];
        const std::size_t first = last;
        last += static_cast<std::size_t>(std::abs(b.row - a.row)) +
                static_cast<std::size_t>(std::abs(b.col - a.col));
        const Side side = side_of(a, b, frame);
        if (side == Side::none)
            continue;
        if (side == side_before && goes_on(samples, walls.back(), first)) {
            walls.back().last = last;
            continue;
        }
        const Vec2 run = samples.at(last) - samples.at(first);
        walls.push_back({.first = first,
                         .last = last,
                         .line = {samples.at(first), 1 / length(run) * run},
                         .circle = {},
                         .on_frame = true});
        side_before = side;
    }
    return walls;
}

}  // namespace d2b::outline
