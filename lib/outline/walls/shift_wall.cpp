#include "outline/walls/shift_wall.hpp"

#include "outline/walls/drawn_chain.hpp"

namespace d2b {

void shift_wall(WallPiece& piece, const WallSamples& samples, double cells) {
    const Vec run = samples.at(piece.last) - samples.at(piece.first);
    if (piece.circle) {
        const Vec middle = samples.at((piece.first + piece.last) / 2) - piece.circle->centre;
        const bool whole = piece.last - piece.first == samples.steps();
        const bool counter_clockwise = whole ? twice_area(samples) > 0 : cross(middle, run) > 0;
        piece.circle->radius += counter_clockwise != samples.mirrored() ? -cells : cells;
        return;
    }
    const double sign = dot(run, piece.line.along) > 0 ? 1 : -1;
    piece.line.through = piece.line.through + sign * cells * samples.left_of(piece.line.along);
}

void move_inward(const WallSamples& samples, int higher, double cells, double limit,
                 std::vector<WallPiece>& pieces) {
    for (WallPiece& piece : pieces)
        for (int quarters = 4; quarters > 0; --quarters) {
            WallPiece moved = piece;
            shift_wall(moved, samples, higher * quarters * cells / 4);
            if (!piece.circle && !samples.near(piece.first, piece.last, moved.line, limit))
                continue;
            piece = moved;
            break;
        }
}

}  // namespace d2b
