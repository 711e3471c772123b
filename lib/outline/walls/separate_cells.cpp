#include "outline/walls/separate_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outline/walls/shift_wall.hpp"

namespace d2b {
namespace {

constexpr double beyond = std::numeric_limits<double>::infinity();
constexpr double longest_move = 0.5;     // cells
constexpr double clearance = 1.0 / 256;  // cells between a wall and the center of a cell

/// Cost of a cell of lower ground on the side of a building or tier, relative to a cost of 1 for a cell that
/// it loses. The costs differ because outlines from elevations tend to be too wide. In a synthetic scene,
/// walls are 0.01 cells too far out if both costs are 1, and as much too far in if this one is 3.
constexpr double low_cell = 2.25;

/// Offset at which a wall moving to the left passes the center of a cell.
struct Passing {
    double at = 0;
    double cost = 0;  ///< negative if the cell moves to its correct side
};

class Separator {
  public:
    Separator(const WallSamples& samples, int higher)
        : samples_(samples), left_cost_(higher < 0 ? low_cell : 1), right_cost_(higher > 0 ? low_cell : 1) {}
    /// @return cells to the left of the direction of the chain
    double move(const WallPiece& piece) {
        find_passings(piece);
        return cheapest();
    }

  private:
    void find_passings(const WallPiece& piece);
    [[nodiscard]] double cheapest() const;

    const WallSamples& samples_;
    double left_cost_;
    double right_cost_;
    std::vector<Passing> passings_;
};

/// Counts a cell shared by consecutive steps once.
void Separator::find_passings(const WallPiece& piece) {
    passings_.clear();
    const Vec run = samples_.at(piece.last) - samples_.at(piece.first);
    const Vec left = (dot(run, piece.line.along) > 0 ? 1 : -1) * samples_.left_of(piece.line.along);
    WallSamples::Cells before{{beyond, beyond}, {beyond, beyond}};
    const auto add = [&](Vec cell, Vec cell_before, double cost) {
        if (!(length(cell - cell_before) < 0.1))
            passings_.push_back({dot(left, cell - piece.line.through), cost});
    };
    for (std::size_t step = piece.first; step < piece.last; ++step) {
        const WallSamples::Cells cells = samples_.beside(step);
        add(cells.left, before.left, left_cost_);
        add(cells.right, before.right, -right_cost_);
        before = cells;
    }
    std::ranges::sort(passings_, {}, &Passing::at);
}

double Separator::cheapest() const {
    double cost = 0;
    double least = beyond;
    double best = 0;
    const auto consider = [&](double from, double to) {
        const double low = std::max(from + clearance, -longest_move);
        const double high = std::min(to - clearance, longest_move);
        if (low > high)
            return;
        const double move = std::clamp(0.0, low, high);
        if (cost < least || (cost == least && std::abs(move) < std::abs(best))) {
            least = cost;
            best = move;
        }
    };
    double from = -beyond;
    for (const Passing& passing : passings_) {
        consider(from, passing.at);
        cost += passing.cost;
        from = passing.at;
    }
    consider(from, beyond);
    return best;
}

}  // namespace

void separate_cells(const WallSamples& samples, int higher, double limit, std::vector<WallPiece>& pieces) {
    Separator separator(samples, higher);
    for (WallPiece& piece : pieces) {
        if (piece.circle)
            continue;
        WallPiece moved = piece;
        shift_wall(moved, samples, separator.move(piece));
        if (samples.near(piece.first, piece.last, moved.line, limit))
            piece.line = moved.line;
    }
}

}  // namespace d2b
