#include "outline/walls/chain_walls.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "outline/walls/circular_arcs.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/plan_walls.hpp"
#include "outline/walls/separate_cells.hpp"
#include "outline/walls/shift_wall.hpp"

namespace d2b {

WallPiece ChainWalls::piece(std::size_t i) const {
    WallPiece piece = pieces_[i];
    if (shifts_[i].cells != 0)
        shift_wall(piece, samples_, shifts_[i].cells);
    return piece;
}

std::vector<WallPiece> ChainWalls::pieces() const {
    std::vector<WallPiece> result;
    result.reserve(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        result.push_back(piece(i));
    return result;
}

bool ChainWalls::plan(const std::vector<std::size_t>& points, const WallStyle& style, double& direction,
                      const StopRequest& stop) {
    std::optional<std::vector<WallPiece>> pieces = plan_walls(samples_, points, style, direction, stop);
    if (!pieces)
        return false;
    find_circular_arcs(samples_, style, *pieces, stop);
    settle_ends(samples_, *pieces);
    const double limit = style.tolerance - wall_clearance;
    separate_cells(samples_, higher_, limit, *pieces);
    if (style.inset > 0)
        move_inward(samples_, higher_, style.inset, limit, *pieces);
    pieces_ = std::move(*pieces);
    shifts_.assign(pieces_.size(), {});
    return true;
}

std::vector<std::size_t> ChainWalls::along(std::size_t begin, std::size_t end,
                                           const StopRequest& stop) const {
    constexpr int most_shifts = 10;
    constexpr double most = 0.7;
    const bool closed = samples_.closed();
    const std::size_t round = samples_.steps();
    std::vector<std::size_t> walls;
    const auto add = [&](std::size_t i) {
        stop.check();
        const WallPiece& piece = pieces_[i];
        const auto common = [&](std::size_t arc_round, std::size_t piece_round) {
            const std::size_t first = std::max(begin + arc_round, piece.first + piece_round);
            const std::size_t last = std::min(end + arc_round, piece.last + piece_round);
            return last > first ? last - first : 0;
        };
        const std::size_t within = common(0, 0) + (closed ? common(round, 0) + common(0, round) : 0);
        if (shifts_[i].times < most_shifts && static_cast<double>(within) >= most * length(i))
            walls.push_back(i);
    };
    // Both ranges of a closed chain may wrap around. Walls are in order along the chain.
    std::size_t next = 0;
    for (std::size_t lap = closed ? 0 : 1; lap < (closed ? 3 : 2); ++lap) {
        const auto ends_after = [&](const WallPiece& piece) {
            return piece.last + round > begin + lap * round;
        };
        const auto begins_before = [&](const WallPiece& piece) {
            return piece.first + round < end + lap * round;
        };
        const auto low = std::ranges::partition_point(pieces_, std::not_fn(ends_after));
        const auto high = std::ranges::partition_point(pieces_, begins_before);
        next = std::max(next, static_cast<std::size_t>(low - pieces_.begin()));
        for (; next < static_cast<std::size_t>(high - pieces_.begin()); ++next)
            add(next);
    }
    return walls;
}

}  // namespace d2b
