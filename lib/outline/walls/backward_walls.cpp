#include "outline/walls/backward_walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace d2b::outline {
namespace {

std::optional<Vec2> corner(const WallSegment& a, const WallSegment& b) {
    return crossing(a.line, b.line, std::sin(min_turn) / 2);
}

class BackwardWalls {
  public:
    BackwardWalls(std::vector<WallSegment>& walls, bool closed, std::size_t end)
        : walls_(walls), closed_(closed), end_(end) {}
    void remove();

  private:
    [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < walls_.size() ? i + 1 : 0; }
    [[nodiscard]] std::size_t previous(std::size_t i) const { return (i > 0 ? i : walls_.size()) - 1; }
    [[nodiscard]] bool runs_backwards(std::size_t i) const;
    /// Number of steps, from the beginnings of walls alone, because their ends are not kept up to date.
    [[nodiscard]] std::size_t steps(std::size_t i) const {
        if (!closed_)
            return (i + 1 < walls_.size() ? walls_[i + 1].first : end_) - walls_[i].first;
        const std::size_t size = (walls_[next(i)].first + end_ - walls_[i].first) % end_;
        return size > 0 ? size : end_;
    }
    void unite_neighbours(std::size_t i);
    void remove_wall(std::size_t i);

    std::vector<WallSegment>& walls_;
    bool closed_;
    std::size_t end_;
};

bool BackwardWalls::runs_backwards(std::size_t i) const {
    if (!closed_ && (i == 0 || i + 1 == walls_.size()))
        return false;
    const auto from = corner(walls_[previous(i)], walls_[i]);
    const auto to = corner(walls_[i], walls_[next(i)]);
    return from && to && dot(*to - *from, walls_[i].line.along) < 0;
}

/// Moves the wall before to the mean of both, weighted by their lengths, and removes the other one.
void BackwardWalls::unite_neighbours(std::size_t i) {
    WallSegment& before = walls_[previous(i)];
    const WallSegment& after = walls_[next(i)];
    const auto a = static_cast<double>(steps(previous(i)));
    const auto b = static_cast<double>(steps(next(i)));
    before.line.through = before.line.through + b / (a + b) * before.line.offset(after.line.through) *
                                                    Vec2{-before.line.along.y, before.line.along.x};
    const std::size_t high = std::max(i, next(i));
    const std::size_t low = std::min(i, next(i));
    walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(high));
    walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(low));
}

/// Removes a wall; each neighbour takes half of its steps.
void BackwardWalls::remove_wall(std::size_t i) {
    if (closed_ || (i > 0 && i + 1 < walls_.size()))
        walls_[next(i)].first = walls_[i].first + steps(i) / 2;
    else if (i == 0)
        walls_[1].first = walls_[0].first;
    if (closed_)
        walls_[next(i)].first %= end_;
    walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(i));
}

void BackwardWalls::remove() {
    const std::size_t least = closed_ ? 4 : 3;
    if (closed_)
        for (WallSegment& wall : walls_)
            wall.first %= end_;
    std::size_t i = 0;
    for (std::size_t sound = 0; walls_.size() >= least && sound < walls_.size();) {
        if (i >= walls_.size())
            i = 0;
        const Vec2 a = walls_[previous(i)].line.along;
        const Vec2 b = walls_[next(i)].line.along;
        const double turn = std::atan2(std::abs(cross(a, b)), dot(a, b));
        const bool parallel = turn < min_turn / 2;
        if (!runs_backwards(i) || (parallel && walls_.size() == least)) {
            ++i;
            ++sound;
            continue;
        }
        sound = 0;
        if (parallel) {
            unite_neighbours(i);
        } else if (turn > sharpest_turn) {
            // The neighbours cannot meet, so that the shorter one goes.
            const bool last = steps(next(i)) < steps(previous(i));
            remove_wall(last ? next(i) : previous(i));
        } else {
            remove_wall(i);
        }
        i = i > 1 ? i - 2 : 0;
    }
    if (closed_)
        std::rotate(walls_.begin(), std::ranges::min_element(walls_, {}, &WallSegment::first), walls_.end());
    for (std::size_t k = 0; k < walls_.size(); ++k)
        walls_[k].last = walls_[k].first + steps(k);
}

}  // namespace

void remove_backward_walls(bool closed, std::size_t end, std::vector<WallSegment>& walls) {
    BackwardWalls(walls, closed, end).remove();
}

}  // namespace d2b::outline
