#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diagnose/parcel_shift.hpp"

namespace d2b {
namespace {

// A move stands out if this many times more borders lie on walls than after an ordinary move, and no other
// move comes close. Cadastres of the right place have a ratio of 2.5 and more, and other moves are half as
// good; plots of another place have 1.3, and 0.8.
constexpr double least_ratio = 1.5;
constexpr double least_on_walls_m = 200;
constexpr double summit = 0.5;  // share of the best score: moves around it that belong to it
constexpr double rival = 0.75;
constexpr double as_good = 0.95;

/// Scores of moves in excess of that of an ordinary one.
class Moves {
  public:
    Moves(const ShiftCounts& counts, const CellSize& cell)
        : down_(shift_steps(cell.down)), right_(shift_steps(cell.across)), counts_(counts) {
        std::vector<std::int64_t> all;
        for_all([&](std::int32_t d, std::int32_t r) { all.push_back(on_walls(d, r)); });
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::ranges::nth_element(all, middle);
        ordinary_ = *middle;
    }

    [[nodiscard]] std::int64_t on_walls(std::int32_t down, std::int32_t right) const {
        return counts_.on_walls[ShiftCounts::index(down, right)];
    }
    [[nodiscard]] std::int64_t ordinary() const { return ordinary_; }
    [[nodiscard]] double more(std::pair<std::int32_t, std::int32_t> move) const {
        return static_cast<double>(on_walls(move.first, move.second) - ordinary_);
    }
    [[nodiscard]] const ShiftSteps& down() const { return down_; }
    [[nodiscard]] const ShiftSteps& right() const { return right_; }
    [[nodiscard]] bool reaches(std::int32_t down, std::int32_t right) const {
        return std::abs(down) <= down_.reach && std::abs(right) <= right_.reach;
    }
    template <typename Use>
    void for_all(const Use& use) const {
        for (std::int32_t d = -down_.reach; d <= down_.reach; ++d)
            for (std::int32_t r = -right_.reach; r <= right_.reach; ++r)
                use(d, r);
    }

  private:
    ShiftSteps down_;
    ShiftSteps right_;
    const ShiftCounts& counts_;
    std::int64_t ordinary_ = 0;
};

using Move = std::pair<std::int32_t, std::int32_t>;  // steps down and right

Move best_of(const Moves& moves) {
    Move best{0, 0};
    moves.for_all([&](std::int32_t d, std::int32_t r) {
        if (moves.on_walls(d, r) > moves.on_walls(best.first, best.second))
            best = {d, r};
    });
    return best;
}

/// Returns the connected moves around the best one with at least half of its score.
std::vector<Move> belonging_to(const Moves& moves, Move best) {
    std::vector<Move> found{best};
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::int32_t d = found[i].first - 1; d <= found[i].first + 1; ++d)
            for (std::int32_t r = found[i].second - 1; r <= found[i].second + 1; ++r)
                if (moves.reaches(d, r) && moves.more({d, r}) >= summit * moves.more(best) &&
                    std::ranges::find(found, Move{d, r}) == found.end())
                    found.emplace_back(d, r);
    return found;
}

}  // namespace

std::optional<ParcelMove> fitting_move(const ShiftCounts& counts, const CellSize& cell) {
    const Moves moves(counts, cell);
    const Move best = best_of(moves);
    const auto on_walls = static_cast<double>(moves.on_walls(best.first, best.second));
    if (on_walls / 2 * std::sqrt(cell.area()) < least_on_walls_m ||
        on_walls < least_ratio * static_cast<double>(moves.ordinary()))
        return std::nullopt;
    const std::vector<Move> belonging = belonging_to(moves, best);
    bool stands_out = true;
    moves.for_all([&](std::int32_t d, std::int32_t r) {
        if (moves.more({d, r}) > rival * moves.more(best) &&
            std::ranges::find(belonging, Move{d, r}) == belonging.end())
            stands_out = false;
    });
    if (!stands_out)
        return std::nullopt;
    const auto in_metres = [&](Move move) {
        return ParcelMove{move.second * moves.right().cells * cell.across,
                          move.first * moves.down().cells * cell.down};
    };
    ParcelMove least = in_metres(best);
    for (const Move& move : belonging)
        if (const ParcelMove other = in_metres(move);
            moves.more(move) >= as_good * moves.more(best) &&
            std::hypot(other.right_m, other.down_m) < std::hypot(least.right_m, least.down_m))
            least = other;
    return least;
}

}  // namespace d2b
