#include "outline/walls/wall_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr float infinite = std::numeric_limits<float>::infinity();

// Prices of a wall, relative to that of one along the main direction.
constexpr double other_frame_price = 1.15;
constexpr double diagonal_price = 1.7;
constexpr double single_price = 2.0;
constexpr double oblique_price = 0.8;  // of a corner that is not right, in addition

constexpr double soft_distance = 0.75;  // cells below which a distance counts by its square
constexpr double tie = 0.04;            // per cell that runs across its wall, times the root of the price
constexpr double slack =
    0.5;  // cells between the tolerance and midpoints of steps, because corners lie farther
constexpr double min_turn = 12 * degree;  // flatter corners are not corners
constexpr double sharpest_turn = 122 * degree;
constexpr double sharp_turn = 165 * degree;  // where the trace itself has such a corner

/// Lines cross far from the trace if their angle is small, so they change only near it: shares of the reach
/// by the angle at which they cross.
constexpr std::size_t zones = 3;
constexpr std::array<double, zones> zone_shares{0.67, 0.5, 0.2};
constexpr double wide_angle = 59 * degree;
constexpr double narrow_angle = 29 * degree;

/// A direction of walls, in which the trace is followed.
struct Heading {
    Vec2 along;
    int family;
    double price;
};

/// Line of a step: a heading and an offset, in intervals from the first point of the chain.
struct WallLine {
    std::size_t heading = 0;
    std::int64_t offset = 0;

    friend bool operator==(const WallLine&, const WallLine&) = default;
};

std::vector<Heading> headings_of(const WallDirections& directions, Walls walls) {
    std::vector<Heading> headings;
    int family = 0;
    const auto add = [&](double direction, double price) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            const double angle = direction + quarter * std::numbers::pi / 2;
            headings.push_back({{std::cos(angle), std::sin(angle)}, family, price});
        }
        ++family;
    };
    const bool free = walls == Walls::free;
    for (const double frame : directions.frames)
        add(frame, free || family == 0 ? 1 : other_frame_price);
    for (const double single : directions.single)
        add(single, free ? 1 : single_price);
    const double diagonal = directions.frames.front() + std::numbers::pi / 4;
    const auto explains = [&](double direction) {
        return std::abs(angle_between(direction, diagonal)) < 8 * degree;
    };
    if (walls != Walls::right && std::ranges::none_of(directions.frames, explains) &&
        std::ranges::none_of(directions.single, explains))
        add(diagonal, free ? 1 : diagonal_price);
    return headings;
}

/// Shortest path over the lines of consecutive steps.
class PathFinder {
  public:
    PathFinder(const TraceSums& samples, const WallParameters& parameters, std::vector<Heading> headings,
               std::vector<std::uint8_t> sharp, const StopToken& stop);

    /// @param first, last steps @param ends lines of the first and the last step, if they are given
    /// @return line of each step; empty if there is no path
    [[nodiscard]] std::vector<WallLine> find(std::size_t first, std::size_t last,
                                             const std::optional<std::pair<WallLine, WallLine>>& ends);
    [[nodiscard]] const std::vector<Heading>& headings() const { return headings_; }
    [[nodiscard]] double interval() const { return interval_; }

  private:
    static constexpr std::size_t fractions = 16;
    static constexpr std::size_t block = 1024;  // steps whose costs are kept; those of others are found again

    void set_jumps();
    void set_costs();
    /// Offset of the middle of the window of a heading at a step.
    [[nodiscard]] std::int64_t base(std::size_t step, std::size_t heading) const {
        return std::llround(cross(headings_[heading].along, midpoint(step)) / interval_);
    }
    [[nodiscard]] Vec2 midpoint(std::size_t step) const {
        return 0.5 * (samples_.at(step) + samples_.at(step + 1));
    }
    [[nodiscard]] float* row(std::vector<float>& costs, std::size_t step, std::size_t heading) const {
        return costs.data() + (step * headings_.size() + heading) * stride_ + padding_;
    }
    void begin(std::size_t step, const std::optional<WallLine>& line, float* costs) const;
    /// @param beginnings set to the costs of beginning a wall of each heading at the step, by zone
    void advance(std::size_t step, const float* before, float* costs, float* beginnings);
    void add_cost_of(std::size_t step, std::size_t heading, float* row) const;
    void find_endings(const float* costs);
    /// Line of the step before on the best path to a line of a step.
    /// @param costs of the step before @param beginnings of a wall at the step
    [[nodiscard]] WallLine before(std::size_t step, WallLine line, const float* costs,
                                  const float* beginnings);
    [[nodiscard]] const std::vector<float>& jumps(std::size_t step) const {
        return sharp_[step % sharp_.size()] != 0 ? sharp_jumps_ : jumps_;
    }

    const TraceSums& samples_;
    const StopToken& stop_;
    std::vector<Heading> headings_;
    std::vector<std::uint8_t> sharp_;  // per step
    double price_;
    double interval_;  // cells between offsets
    int higher_;       // sign of the offset of a step from a line on the lower ground; 0 if both sides count
    double outside_cost_;
    std::size_t half_;  // offsets on either side
    std::size_t width_;
    std::size_t padding_;
    std::size_t stride_;
    std::array<std::size_t, zones> zone_half_{};
    std::vector<float> jumps_;  // [zone][from][to]
    std::vector<float> sharp_jumps_;
    std::vector<float> distance_costs_;              // [fraction][offset]
    std::array<std::vector<float>, zones> endings_;  // least costs of a wall of each heading that ends
};

PathFinder::PathFinder(const TraceSums& samples, const WallParameters& parameters,
                       std::vector<Heading> headings, std::vector<std::uint8_t> sharp, const StopToken& stop)
    : samples_(samples),
      stop_(stop),
      headings_(std::move(headings)),
      sharp_(std::move(sharp)),
      price_(parameters.price),
      interval_(std::max(0.25, parameters.tolerance / 20)),
      higher_(samples.mirrored() ? -parameters.higher : parameters.higher),
      outside_cost_(parameters.outside_cost),
      half_(static_cast<std::size_t>((parameters.tolerance - slack) / interval_)),
      width_(2 * half_ + 1),
      padding_(std::min(width_, static_cast<std::size_t>(2 * parameters.side / interval_) + 2)),
      stride_(width_ + 2 * padding_) {
    for (std::size_t z = 0; z < zones; ++z) {
        zone_half_[z] = static_cast<std::size_t>(zone_shares[z] * static_cast<double>(half_));
        endings_[z].resize(headings_.size());
    }
    set_jumps();
    set_costs();
}

void PathFinder::set_jumps() {
    const std::size_t n = headings_.size();
    jumps_.assign(zones * n * n, infinite);
    sharp_jumps_ = jumps_;
    for (std::size_t from = 0; from < n; ++from)
        for (std::size_t to = 0; to < n; ++to) {
            const Vec2 a = headings_[from].along;
            const Vec2 b = headings_[to].along;
            const double turn = std::atan2(std::abs(cross(a, b)), dot(a, b));
            const double crossing = std::min(turn, std::numbers::pi - turn);
            const std::size_t zone = crossing > wide_angle ? 0 : crossing > narrow_angle ? 1 : 2;
            const bool right = std::abs(turn - std::numbers::pi / 2) < degree;
            const auto cost =
                static_cast<float>(price_ * (headings_[to].price + (right ? 0 : oblique_price)));
            const std::size_t place = (zone * n + from) * n + to;
            if (turn > min_turn && turn < sharpest_turn)
                jumps_[place] = cost;
            if (turn > min_turn && turn < sharp_turn)
                sharp_jumps_[place] = cost;
        }
}

/// Distances beyond the soft one count as areas; those of lower ground more, because a cell of it in a
/// building is wrong by the height of the wall.
void PathFinder::set_costs() {
    distance_costs_.resize((fractions + 1) * width_);
    for (std::size_t f = 0; f <= fractions; ++f)
        for (std::size_t w = 0; w < width_; ++w) {
            const double shift = static_cast<double>(f) / fractions - 0.5;  // of the window from the step
            const double offset = -(shift + static_cast<double>(w) - static_cast<double>(half_)) * interval_;
            const double away = std::abs(offset);
            const double factor = higher_ * offset > 0 ? outside_cost_ : 1;
            distance_costs_[f * width_ + w] = static_cast<float>(
                away < soft_distance ? away * away / (2 * soft_distance)
                                     : factor * (away - soft_distance) + soft_distance / 2);
        }
}

void PathFinder::add_cost_of(std::size_t step, std::size_t heading, float* row) const {
    const Vec2 along = samples_.at(step + 1) - samples_.at(step);
    const double size = length(along);
    const double facing = dot(along, headings_[heading].along);
    const double at = cross(headings_[heading].along, midpoint(step)) / interval_;
    const double shift = std::round(at) - at;
    const auto f = static_cast<std::size_t>(std::lround((shift + 0.5) * fractions));
    const float* costs = distance_costs_.data() + f * width_;
    const auto factor = static_cast<float>(std::abs(facing));
    const auto fixed = static_cast<float>(tie * std::sqrt(price_) * (size - facing));
    for (std::size_t w = 0; w < width_; ++w)
        row[w] += factor * costs[w] + fixed;
}

void PathFinder::begin(std::size_t step, const std::optional<WallLine>& line, float* costs) const {
    const std::size_t n = headings_.size();
    std::fill(costs, costs + n * stride_, infinite);
    for (std::size_t h = 0; h < n; ++h) {
        float* own = costs + h * stride_ + padding_;
        if (!line) {
            std::fill(own, own + width_, 0.0F);
            add_cost_of(step, h, own);
        } else if (line->heading == h) {
            const std::int64_t w = line->offset - base(step, h) + static_cast<std::int64_t>(half_);
            if (w >= 0 && w < static_cast<std::int64_t>(width_))
                own[w] = 0;
        }
    }
}

void PathFinder::find_endings(const float* costs) {
    for (std::size_t h = 0; h < headings_.size(); ++h) {
        const float* own = costs + h * stride_ + padding_;
        float least = infinite;
        std::size_t low = half_;
        std::size_t high = half_;
        for (std::size_t z = zones; z-- > 0;) {
            for (std::size_t w = half_ - zone_half_[z]; w < low; ++w)
                least = std::min(least, own[w]);
            for (std::size_t w = high; w <= half_ + zone_half_[z]; ++w)
                least = std::min(least, own[w]);
            low = half_ - zone_half_[z];
            high = half_ + zone_half_[z] + 1;
            endings_[z][h] = least;
        }
    }
}

void PathFinder::advance(std::size_t step, const float* before, float* costs, float* beginnings) {
    const std::size_t n = headings_.size();
    find_endings(before);
    std::fill(beginnings, beginnings + zones * n, infinite);
    const float* jump = jumps(step).data();
    for (std::size_t z = 0; z < zones; ++z)
        for (std::size_t from = 0; from < n; ++from, jump += n)
            for (std::size_t h = 0; h < n; ++h)
                beginnings[z * n + h] = std::min(beginnings[z * n + h], endings_[z][from] + jump[h]);
    for (std::size_t h = 0; h < n; ++h) {
        float* own = costs + h * stride_;
        std::fill(own, own + padding_, infinite);
        std::fill(own + padding_ + width_, own + stride_, infinite);
        own += padding_;
        const std::int64_t moved = base(step, h) - base(step - 1, h);
        if (std::abs(moved) <= static_cast<std::int64_t>(padding_))
            std::copy_n(before + h * stride_ + padding_ + moved, width_, own);
        else
            std::fill(own, own + width_, infinite);
        for (std::size_t z = 0; z < zones; ++z) {
            const float from = beginnings[z * n + h];
            for (std::size_t w = half_ - zone_half_[z]; w <= half_ + zone_half_[z]; ++w)
                own[w] = std::min(own[w], from);
        }
        add_cost_of(step, h, own);
    }
    // Costs stay small, because sums of floats are exact to a share of their size.
    if (step % 64 == 0) {
        float least = infinite;
        for (std::size_t i = 0; i < n * stride_; ++i)
            least = std::min(least, costs[i]);
        if (least < infinite)
            for (std::size_t i = 0; i < n * stride_; ++i)
                costs[i] -= least;
    }
}

WallLine PathFinder::before(std::size_t step, WallLine line, const float* costs, const float* beginnings) {
    const std::size_t n = headings_.size();
    const auto half = static_cast<std::int64_t>(half_);
    const std::int64_t own = line.offset - base(step, line.heading);
    const std::int64_t same = line.offset - base(step - 1, line.heading);
    float least = std::abs(same) <= half
                      ? costs[line.heading * stride_ + padding_ + static_cast<std::size_t>(same + half)]
                      : infinite;
    std::optional<std::size_t> turned;
    for (std::size_t z = 0; z < zones; ++z)
        if (std::abs(own) <= static_cast<std::int64_t>(zone_half_[z]) &&
            beginnings[z * n + line.heading] < least) {
            least = beginnings[z * n + line.heading];
            turned = z;
        }
    if (!turned)
        return line;
    find_endings(costs);
    const float* jump = jumps(step).data() + *turned * n * n;
    std::size_t from = 0;
    while (endings_[*turned][from] + jump[from * n + line.heading] != least)
        ++from;
    const float* ended = costs + from * stride_ + padding_;
    std::size_t offset = half_ - zone_half_[*turned];
    while (ended[offset] != endings_[*turned][from])
        ++offset;
    return {from, base(step - 1, from) + static_cast<std::int64_t>(offset) - half};
}

std::vector<WallLine> PathFinder::find(std::size_t first, std::size_t last,
                                       const std::optional<std::pair<WallLine, WallLine>>& ends) {
    const std::size_t n = last - first;
    const std::size_t size = headings_.size() * stride_;
    const std::size_t blocks = (n + block - 1) / block;
    std::vector<float> starts(blocks * size);  // costs of the first step of each block
    std::vector<float> costs(std::min(n, block) * size);
    const std::size_t turns = zones * headings_.size();
    std::vector<float> beginnings(std::min(n, block + 1) * turns);  // of the block's steps and the next one
    const auto fill = [&](std::size_t b) {
        std::copy_n(starts.begin() + static_cast<std::ptrdiff_t>(b * size), size, costs.begin());
        const std::size_t end = std::min(n, (b + 1) * block);
        for (std::size_t k = b * block + 1; k < end; ++k) {
            if (k % 64 == 0)
                stop_.check();
            float* own = costs.data() + (k - b * block) * size;
            advance(first + k, own - size, own, beginnings.data() + (k - b * block) * turns);
        }
        return costs.data() + (end - 1 - b * block) * size;
    };
    begin(first, ends ? std::optional(ends->first) : std::nullopt, starts.data());
    const float* reached = nullptr;
    for (std::size_t b = 0; b < blocks; ++b) {
        reached = fill(b);
        if (b + 1 < blocks)
            advance(first + (b + 1) * block, reached, starts.data() + (b + 1) * size,
                    beginnings.data() + block * turns);
    }
    WallLine line;
    if (ends) {
        line = ends->second;
        const std::int64_t w = line.offset - base(last - 1, line.heading) + static_cast<std::int64_t>(half_);
        if (w < 0 || w >= static_cast<std::int64_t>(width_) ||
            reached[line.heading * stride_ + padding_ + static_cast<std::size_t>(w)] == infinite)
            return {};
    } else {
        const auto least = static_cast<std::size_t>(std::min_element(reached, reached + size) - reached);
        if (reached[least] == infinite)
            return {};
        line.heading = least / stride_;
        line.offset = base(last - 1, line.heading) + static_cast<std::int64_t>(least % stride_) -
                      static_cast<std::int64_t>(padding_ + half_);
    }
    std::vector<WallLine> lines(n);
    for (std::size_t b = blocks; b-- > 0;) {
        if (b + 1 < blocks) {
            // The costs of beginning a wall at the next block are found anew with those of this one.
            const float* end = fill(b);
            std::vector<float> next(size);
            advance(first + (b + 1) * block, end, next.data(), beginnings.data() + block * turns);
            line = before(first + (b + 1) * block, line, end, beginnings.data() + block * turns);
        }
        for (std::size_t k = std::min(n, (b + 1) * block); k-- > b * block;) {
            lines[k] = line;
            if (k > b * block)
                line = before(first + k, line, costs.data() + (k - b * block - 1) * size,
                              beginnings.data() + (k - b * block) * turns);
        }
    }
    return lines;
}

/// Steps beside corners at which two stretches of five cells or more enclose less than 58 degrees.
std::vector<std::uint8_t> sharp_steps(const TraceSums& samples, const std::vector<std::size_t>& points) {
    constexpr double min_length = 5;
    constexpr std::size_t around = 3;
    const std::size_t steps = samples.steps();
    std::vector<std::uint8_t> sharp(steps);
    const std::size_t n = points.size();
    for (std::size_t i = samples.closed() ? 0 : 1; i + (samples.closed() ? 0 : 1) < n; ++i) {
        const Vec2 from = samples.at(points[i]) - samples.at(points[i > 0 ? i - 1 : n - 1]);
        const Vec2 to = samples.at(points[i + 1 < n ? i + 1 : 0]) - samples.at(points[i]);
        if (length(from) < min_length || length(to) < min_length ||
            std::atan2(std::abs(cross(from, to)), dot(from, to)) < sharpest_turn)
            continue;
        for (std::size_t k = 0; k <= 2 * around; ++k)
            if (samples.closed() || (points[i] + k >= around && points[i] + k - around < steps))
                sharp[(points[i] + k + steps - around) % steps] = 1;
    }
    return sharp;
}

/// Moves the line of a wall to the mean of the midpoints that lie near it.
void fit_offset(const TraceSums& samples, WallSegment& wall) {
    constexpr double near = 0.9;  // cells
    constexpr double min_weight = 0.35;
    double sum = 0;
    double weights = 0;
    for (std::size_t step = wall.first; step < wall.last; ++step) {
        const Vec2 along = samples.at(step + 1) - samples.at(step);
        const double weight = dot(along, wall.line.along);
        const double offset = wall.line.offset(samples.at(step) + 0.5 * along);
        if (weight <= 0 || std::abs(offset) > near)
            continue;
        sum += weight * offset;
        weights += weight;
    }
    if (weights > min_weight)
        wall.line.through = wall.line.through + sum / weights * Vec2{-wall.line.along.y, wall.line.along.x};
}

std::optional<Vec2> corner(const WallSegment& a, const WallSegment& b) {
    const double sine = cross(a.line.along, b.line.along);
    if (std::abs(sine) < std::sin(min_turn) / 2)
        return {};
    return a.line.through + cross(b.line.through - a.line.through, b.line.along) / sine * a.line.along;
}

/// Removes walls that run backwards between their corners, because lines cross far from where the trace
/// turns; their neighbours meet, or become one wall if they are parallel.
class BackwardWalls {
  public:
    /// @param end last step of an open chain; of a closed one, the number of its steps
    BackwardWalls(std::vector<WallSegment>& walls, bool closed, std::size_t end)
        : walls_(walls), closed_(closed), end_(end) {}
    void remove();

  private:
    [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < walls_.size() ? i + 1 : 0; }
    [[nodiscard]] std::size_t previous(std::size_t i) const { return (i > 0 ? i : walls_.size()) - 1; }
    [[nodiscard]] bool runs_backwards(std::size_t i) const;
    /// Number of steps, from the beginnings of walls alone, which are what is kept up to date.
    [[nodiscard]] std::size_t steps(std::size_t i) const {
        if (!closed_)
            return (i + 1 < walls_.size() ? walls_[i + 1].first : end_) - walls_[i].first;
        const std::size_t size = (walls_[next(i)].first + end_ - walls_[i].first) % end_;
        return size > 0 ? size : end_;
    }
    void unite_neighbours(std::size_t i);

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
        if (!runs_backwards(i) || (parallel && walls_.size() == least) || turn > sharpest_turn) {
            ++i;
            ++sound;
            continue;
        }
        sound = 0;
        if (parallel) {
            unite_neighbours(i);
        } else {
            WallSegment& after = walls_[next(i)];
            after.first = walls_[i].first + steps(i) / 2;
            if (closed_)
                after.first %= end_;
            walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(i));
        }
        i = i > 1 ? i - 2 : 0;
    }
    if (closed_)
        std::ranges::rotate(walls_, std::ranges::min_element(walls_, {}, &WallSegment::first));
    for (std::size_t k = 0; k < walls_.size(); ++k)
        walls_[k].last = walls_[k].first + steps(k);
}

/// Middle of the longest stretch, at which a closed chain is cut.
std::size_t middle_of_longest(const TraceSums& samples, const std::vector<std::size_t>& points) {
    std::size_t best = 0;
    double longest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t last = i + 1 < points.size() ? points[i + 1] : samples.steps();
        const double size = length(samples.at(last) - samples.at(points[i]));
        if (size > longest) {
            longest = size;
            best = (points[i] + last) / 2;
        }
    }
    return best % samples.steps();
}

}  // namespace

std::optional<std::vector<WallSegment>> find_walls(const TraceSums& samples, std::size_t first,
                                                   std::size_t last, const std::vector<std::size_t>& points,
                                                   const WallParameters& parameters,
                                                   const WallDirections& directions, const StopToken& stop) {
    const std::size_t steps = samples.steps();
    const bool around = samples.closed() && last - first == steps;
    PathFinder finder(samples, parameters, headings_of(directions, parameters.walls),
                      sharp_steps(samples, points), stop);
    std::vector<WallLine> lines;
    if (around) {
        // The line at the cut is found first, among the steps around it.
        constexpr std::size_t reach = 48;
        first = middle_of_longest(samples, points);
        const std::size_t behind = std::min(reach, steps / 2);
        const std::size_t from = first + steps - behind;
        const std::vector<WallLine> nearby = finder.find(from, from + std::min(2 * reach + 1, steps), {});
        if (nearby.empty())
            return {};
        lines = finder.find(first, first + steps + 1, std::pair(nearby[behind], nearby[behind]));
        if (!lines.empty())
            lines.pop_back();
    } else {
        lines = finder.find(first, last, {});
    }
    if (lines.empty())
        return {};
    std::vector<WallSegment> walls;
    const auto add = [&](std::size_t begin, std::size_t end, WallLine line) {
        const Heading& heading = finder.headings()[line.heading];
        const double offset = static_cast<double>(line.offset) * finder.interval();
        walls.push_back({begin,
                         end,
                         heading.family,
                         {offset * Vec2{-heading.along.y, heading.along.x}, heading.along},
                         {}});
    };
    std::size_t begin = 0;
    if (around)
        while (begin < steps && lines[begin] == lines[(begin + steps - 1) % steps])
            ++begin;
    if (begin == steps)
        return {};
    for (std::size_t k = begin, end = begin; k < begin + lines.size(); k = end) {
        while (end < begin + lines.size() && lines[end % lines.size()] == lines[k % lines.size()])
            ++end;
        add(first + k, first + end, lines[k % lines.size()]);
    }
    for (WallSegment& wall : walls)
        fit_offset(samples, wall);
    BackwardWalls(walls, around, around ? steps : last).remove();
    if (around && walls.size() < 3)
        return {};
    return walls;
}

double align_frames(const TraceSums& samples, const std::vector<WallSegment>& walls,
                    WallDirections& directions) {
    constexpr double near = 1;        // cells
    constexpr double min_length = 5;  // cells
    constexpr double most = 4 * degree;
    const std::size_t n = directions.frames.size() + directions.single.size();
    std::vector<double> turns(n + 1);
    std::vector<double> weights(n + 1);
    for (const WallSegment& wall : walls) {
        if (wall.circle || wall.family > static_cast<int>(n))
            continue;
        double w = 0;
        double x = 0;
        double y = 0;
        double xx = 0;
        double xy = 0;
        for (std::size_t step = wall.first; step < wall.last; ++step) {
            const Vec2 along = samples.at(step + 1) - samples.at(step);
            const Vec2 middle = samples.at(step) + 0.5 * along;
            const double weight = std::abs(dot(along, wall.line.along));
            const double offset = wall.line.offset(middle);
            if (std::abs(offset) > near)
                continue;
            const double at = dot(middle, wall.line.along);
            w += weight;
            x += weight * at;
            y += weight * offset;
            xx += weight * at * at;
            xy += weight * at * offset;
        }
        if (w < min_length)
            continue;
        const double variance = xx - x * x / w;
        // The walls at 45 degrees follow the main direction.
        const std::size_t slot =
            static_cast<std::size_t>(wall.family) == n ? 0 : static_cast<std::size_t>(wall.family);
        turns[slot] += xy - x * y / w;
        weights[slot] += variance;
    }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(weights[i] > 0))
            continue;
        const double turn = std::clamp(turns[i] / weights[i], -most, most);
        double& direction = i < directions.frames.size() ? directions.frames[i]
                                                         : directions.single[i - directions.frames.size()];
        direction += turn;
        largest = std::max(largest, std::abs(turn));
    }
    return largest;
}

}  // namespace d2b
