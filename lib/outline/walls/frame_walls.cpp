#include "outline/walls/frame_walls.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace d2b::outline {
namespace {

constexpr std::size_t longest_dent = 8;  // steps by which a wall leaves the edge of the raster

enum class Side : std::uint8_t { none, top, bottom, left, right };

/// Side of the frame along which a step runs.
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

/// Sides of the frame along which the steps of a chain run.
std::vector<Side> sides_of(const Chain& chain, const LatticeBox& frame) {
    std::vector<Side> sides;
    const std::size_t corners = chain.trace.size();
    for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < corners; ++i) {
        const LatticePoint a = chain.trace[i];
        const LatticePoint b = chain.trace[i + 1 < corners ? i + 1 : 0];
        const auto steps = static_cast<std::size_t>(std::abs(b.row - a.row)) +
                           static_cast<std::size_t>(std::abs(b.col - a.col));
        sides.insert(sides.end(), steps, side_of(a, b, frame));
    }
    return sides;
}

}  // namespace

std::vector<WallSegment> walls_on_frame(const Chain& chain, const TraceSums& samples,
                                        const LatticeBox& frame) {
    const std::vector<Side> sides = sides_of(chain, frame);
    const std::size_t n = sides.size();
    const auto is_on = [&](std::size_t step) { return sides[step % n] != Side::none; };
    if (std::ranges::find_if(sides, [](Side side) { return side != Side::none; }) == sides.end())
        return {};
    // A closed chain is followed from the end of a wall, so that none of them is divided.
    std::size_t begin = 0;
    if (chain.closed)
        while (begin < n && sides[begin] == sides[(begin + n - 1) % n])
            ++begin;
    std::vector<WallSegment> walls;
    for (std::size_t first = begin; first < begin + n; ++first) {
        if (!is_on(first))
            continue;
        std::size_t last = first + 1;
        while (last < begin + n && sides[last % n] == sides[first % n])
            ++last;
        const Vec2 run = samples.at(last) - samples.at(first);
        if (!walls.empty()) {
            // A dent of a cell is noise of the trace.
            WallSegment& before = walls.back();
            const bool one_side = sides[(before.last - 1) % n] == sides[first % n];
            if (one_side && first - before.last <= longest_dent &&
                dot(samples.at(first) - samples.at(before.last), before.line.along) > 0 &&
                samples.near(before.last, first, before.line, 1.01 * samples.longest_step())) {
                before.last = last;
                first = last - 1;
                continue;
            }
        }
        walls.push_back({.first = first,
                         .last = last,
                         .line = {samples.at(first), 1 / length(run) * run},
                         .circle = {},
                         .on_frame = true});
        first = last - 1;
    }
    for (WallSegment& wall : walls)
        if (wall.first >= n) {
            wall.first -= n;
            wall.last -= n;
        }
    std::ranges::sort(walls, {}, &WallSegment::first);
    return walls;
}

}  // namespace d2b::outline
