#include "outline/walls/wall_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "core/grid.hpp"
#include "outline/walls/backward_walls.hpp"
#include "outline/walls/wall_adjustment.hpp"

namespace d2b::outline {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

// Prices of a wall, relative to that of one along the main direction.
constexpr double other_frame_price = 1.15;
constexpr double diagonal_price = 1.7;
constexpr double single_price = 2.0;
constexpr double oblique_price = 0.8;  // of a corner that is not right, in addition

constexpr double soft_distance = 0.75;  // cells below which a distance counts by its square
constexpr double outside_cost = 1.5;    // of a cell of lower ground, beyond the soft distance
constexpr double tie = 0.04;            // per cell that runs across its wall, times the root of the price
constexpr double sharp_turn = 165 * degree;  // where the trace itself has such a corner

/// Lines cross far from the trace if their angle is small, so they change only near it: shares of the reach
/// by the angle at which they cross.
constexpr std::size_t zone_count = 3;
constexpr std::array<double, zone_count> zone_shares{0.67, 0.5, 0.2};
const double wide_cosine = std::cos(59 * degree);
const double narrow_cosine = std::cos(29 * degree);
const double right_cosine = std::sin(degree);
const double flat_cosine = std::cos(min_turn);
const double sharpest_cosine = std::cos(sharpest_turn);
const double sharp_cosine = std::cos(sharp_turn);

/// Largest distance of a line from the midpoint of a step; the corners of the trace lie farther away, see
/// wall_distance().
double reach(double tolerance) {
    return tolerance - std::min(0.5, tolerance / 3);
}

/// A direction of walls, in which the trace is followed.
struct Heading {
    Vec2 along;
    int family;
    double price;
};

/// Change from one family of headings to another, by a number of quarters of a turn.
struct Turn {
    std::size_t zone;
    float cost;  ///< infinite if it is forbidden
};

/// A turn for all headings of a family.
struct FamilyTurn {
    std::size_t ending;     ///< index of the first heading that ends
    std::size_t beginning;  ///< index of the first heading that begins
    float cost;
};

/// Turns that are allowed at a step.
struct Turns {
    double sharpest;  ///< cosine of the sharpest turn
    std::vector<FamilyTurn> allowed;
};

/// Line of a step: a heading and an offset, in intervals from the first point of the chain.
struct WallLine {
    std::size_t heading = 0;
    std::int64_t offset = 0;

    friend bool operator==(const WallLine&, const WallLine&) = default;
};

std::vector<Heading> headings_of(const WallDirections& directions, Walls walls, bool diagonals) {
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
    if (diagonals && walls != Walls::right && std::ranges::none_of(directions.frames, explains) &&
        std::ranges::none_of(directions.single, explains))
        add(diagonal, free ? 1 : diagonal_price);
    return headings;
}

/// Returns the nearest integer. Faster than std::round(), which is a call on old processors.
double nearest_integer(double value) {
    constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52: doubles of this size have no fraction
    return value + shift - shift;
}

/// Costs of the lines of one heading at a step, as intervals from the lines of the same heading before.
struct HeadingStep {
    std::int64_t moved;  ///< offset of the window of lines, relative to that of the step before
    const float* costs;  ///< of the distances of the lines from the step
    float factor;        ///< of these costs
    float fixed;         ///< cost of each line
};

/// Layout of the costs of a step: for each heading, a window of lines between paddings of infinite costs.
struct Windows {
    std::size_t width;         ///< a multiple of `lanes`
    std::size_t padding;       ///< before and after each window
    std::vector<float> zones;  ///< [zone][line]: 0 if the line belongs to the zone, otherwise infinite

    [[nodiscard]] std::size_t begin(std::size_t heading) const {
        return padding + heading * (width + padding);
    }
};
constexpr std::size_t lanes = 4;
constexpr std::size_t quarter_turns = 4;  // headings of a family

/// Costs that are computed at a time. A vector of the compiler, because it keeps an array in memory.
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;

Lanes load(const float* costs) {
    Lanes values;
    std::memcpy(&values, costs, sizeof values);
    return values;
}

void store(Lanes values, float* costs) {
    std::memcpy(costs, &values, sizeof values);
}

Lanes smaller(Lanes a, Lanes b) {
    return b < a ? b : a;
}

float least_of(Lanes values) {
    return std::min(std::min(values[0], values[2]), std::min(values[1], values[3]));
}

/// Adds infinite costs before or after a window.
void pad(std::size_t padding, float* costs) {
    for (std::size_t block = 0; block < padding; block += lanes)
        store(Lanes{} + infinite, costs + block);
}

/// Advances all headings by a step, and finds the least cost of each in each zone.
/// @param beginnings costs of beginning a wall, [zone][heading]
/// @param endings [zone][family][twice the quarter turns]
void advance_headings(const Windows& windows, const std::vector<HeadingStep>& steps, const float* before,
                      const float* beginnings, float* costs, float* endings) {
    const std::size_t n = steps.size();
    const std::size_t width = windows.width;
    const std::size_t padding = windows.padding;
    const float* wide = windows.zones.data();
    const float* middle = wide + width;
    const float* narrow = middle + width;
    pad(padding, costs);
    float* own = costs + padding;
    before += padding;
    for (std::size_t h = 0; h < n; ++h, own += width + padding, before += width + padding) {
        const HeadingStep step = steps[h];
        const float* same = before + step.moved;
        const float from_wide = beginnings[h];
        const float from_middle = beginnings[n + h];
        const float from_narrow = beginnings[2 * n + h];
        Lanes least_wide = Lanes{} + infinite;
        Lanes least_middle = least_wide;
        Lanes least_narrow = least_wide;
        for (std::size_t w = 0; w < width; w += lanes) {
            const Lanes in_wide = load(wide + w);
            const Lanes in_middle = load(middle + w);
            const Lanes in_narrow = load(narrow + w);
            const Lanes turned =
                smaller(smaller(from_wide + in_wide, from_middle + in_middle), from_narrow + in_narrow);
            const Lanes cost =
                smaller(load(same + w), turned) + (step.factor * load(step.costs + w) + step.fixed);
            store(cost, own + w);
            least_wide = smaller(least_wide, cost + in_wide);
            least_middle = smaller(least_middle, cost + in_middle);
            least_narrow = smaller(least_narrow, cost + in_narrow);
        }
        pad(padding, own + width);
        float* ending = endings + 2 * (h - h % quarter_turns) + h % quarter_turns;
        for (const Lanes least : {least_wide, least_middle, least_narrow}) {
            ending[0] = ending[quarter_turns] = least_of(least);
            ending += 2 * n;
        }
    }
}

struct ChainCosts {
    CellValues<float> lines;
    CellValues<float> beginnings;
};

/// Returns the costs of the chain that the thread is at. They are kept for the next one, because most chains
/// are so short that allocating them takes as long as the search.
ChainCosts& costs_of_thread() {
    static thread_local ChainCosts costs;
    return costs;
}

/// Shortest path over the lines of consecutive steps.
class PathFinder {
  public:
    /// @param longest largest number of steps of a path
    PathFinder(const TraceSums& samples, const WallParameters& parameters, std::vector<Heading> headings,
               std::vector<std::uint8_t> sharp, std::size_t longest, const StopToken& stop);

    /// @param first, last steps @param ends lines of the first and the last step, if they are given
    /// @return line of each step; empty if there is no path
    [[nodiscard]] std::vector<WallLine> find(std::size_t first, std::size_t last,
                                             const std::optional<std::pair<WallLine, WallLine>>& ends);
    [[nodiscard]] const std::vector<Heading>& headings() const { return headings_; }
    [[nodiscard]] double interval() const { return interval_; }

  private:
    static constexpr std::size_t fractions = 16;
    static constexpr std::size_t block = 1024;  // steps whose costs are kept; those of others are found again

    /// Turn from one heading to another. @param sharpest cosine of the sharpest turn
    [[nodiscard]] Turn turn(std::size_t from, std::size_t to, double sharpest) const;
    [[nodiscard]] Turns turns_up_to(double sharpest) const;
    void set_costs();
    /// Offset of the midpoint of a step from the first point of the chain, in intervals.
    [[nodiscard]] double offset(std::size_t step, std::size_t heading) const {
        return cross(headings_[heading].along, samples_.midpoint(step)) * per_interval_;
    }
    /// Offset of the middle of the window of a heading at a step.
    [[nodiscard]] std::int64_t base(std::size_t step, std::size_t heading) const {
        return static_cast<std::int64_t>(nearest_integer(offset(step, heading)));
    }

    /// Sets the costs of the first step. @param line the only one, if it is given
    void begin(std::size_t step, const std::optional<WallLine>& line, float* costs);
    /// @param before costs of the step before @param beginnings see advance_headings(); they are set
    void advance(std::size_t step, const float* before, float* costs, float* beginnings);
    /// Sets the costs of distances of a step.
    void set_steps(std::size_t step);
    void find_endings(const float* costs);
    /// Line of the step before on the best path to a line of a step.
    /// @param costs of the step before @param beginnings of a wall at the step
    [[nodiscard]] WallLine before(std::size_t step, WallLine line, const float* costs,
                                  const float* beginnings);
    /// Line of a step with the least cost, or the only one that may be taken. @return nullopt if there is no
    /// path
    [[nodiscard]] std::optional<WallLine> cheapest_line(std::size_t step, const float* costs,
                                                        const std::optional<WallLine>& only) const;
    [[nodiscard]] const Turns& turns(std::size_t step) const {
        return sharp_[step % sharp_.size()] != 0 ? sharp_turns_ : turns_;
    }
    /// Least cost of a heading in a zone.
    [[nodiscard]] float& ending(std::size_t zone, std::size_t heading) {
        return endings_[2 * (zone * headings_.size() + heading - heading % quarter_turns) +
                        heading % quarter_turns];
    }

    const TraceSums& samples_;
    const StopToken& stop_;
    std::vector<Heading> headings_;
    std::vector<std::uint8_t> sharp_;  // per step
    double price_;
    double tie_price_;
    double interval_;  // cells between offsets
    int higher_;       // sign of the offset of a step from a line on the lower ground; 0 if both sides count
    double per_interval_;
    std::size_t half_;  // offsets on either side of the middle of a window
    Windows windows_;
    std::array<std::size_t, zone_count> zone_half_{};
    Turns turns_{};
    Turns sharp_turns_{};
    std::vector<float> distance_costs_;  // [fraction][offset]
    std::vector<HeadingStep> steps_;     // of the step that is advanced to
    std::vector<std::int64_t> bases_;    // of that step
    std::vector<float> endings_;  // least costs of a wall that ends, [zone][family][twice the quarter turns]
    std::size_t row_;             // size of the costs of a step
    CellValues<float>& costs_;    // of the steps of a block
    CellValues<float>& beginnings_;  // of the block's steps and the next one, [step][zone][heading]
};

PathFinder::PathFinder(const TraceSums& samples, const WallParameters& parameters,
                       std::vector<Heading> headings, std::vector<std::uint8_t> sharp, std::size_t longest,
                       const StopToken& stop)
    : samples_(samples),
      stop_(stop),
      headings_(std::move(headings)),
      sharp_(std::move(sharp)),
      price_(parameters.price),
      tie_price_(tie * std::sqrt(price_)),
      interval_(std::max(0.25, parameters.tolerance / 20)),
      higher_(samples.mirrored() ? -parameters.higher : parameters.higher),
      per_interval_(1 / interval_),
      half_(static_cast<std::size_t>(reach(parameters.tolerance) / interval_)),
      steps_(headings_.size()),
      bases_(headings_.size()),
      endings_(2 * zone_count * headings_.size()),
      costs_(costs_of_thread().lines),
      beginnings_(costs_of_thread().beginnings) {
    windows_.width = (2 * half_ + lanes) / lanes * lanes;
    // A window moves by the length of a step at most, and one line by rounding. Beyond its width all is
    // alike.
    const auto farthest = static_cast<std::size_t>(samples.longest_step() / interval_) + 2;
    windows_.padding = std::min(windows_.width, (farthest + lanes - 1) / lanes * lanes);
    windows_.zones.assign(zone_count * windows_.width, infinite);
    for (std::size_t z = 0; z < zone_count; ++z) {
        zone_half_[z] = static_cast<std::size_t>(zone_shares[z] * static_cast<double>(half_));
        std::fill_n(
            windows_.zones.begin() + static_cast<std::ptrdiff_t>(z * windows_.width + half_ - zone_half_[z]),
            2 * zone_half_[z] + 1, 0.0F);
    }
    row_ = windows_.begin(headings_.size());
    const std::size_t most = std::min(longest, block);
    costs_.resize(std::max(costs_.size(), most * row_));
    beginnings_.resize(std::max(beginnings_.size(), (most + 1) * zone_count * headings_.size()));
    turns_ = turns_up_to(sharpest_cosine);
    if (std::ranges::find(sharp_, 1) != sharp_.end())
        sharp_turns_ = turns_up_to(sharp_cosine);
    set_costs();
}

/// Depends on the families and the quarter turns between the headings alone, to the bit.
Turn PathFinder::turn(std::size_t from, std::size_t to, double sharpest) const {
    const std::size_t quarters = (to + quarter_turns - from % quarter_turns) % quarter_turns;
    const Heading& first = headings_[from - from % quarter_turns];
    const Heading& second = headings_[to - to % quarter_turns + quarters];
    const double cosine = dot(first.along, second.along);  // of the turn
    const double size = std::abs(cosine);
    const std::size_t zone = size < wide_cosine ? 0 : size < narrow_cosine ? 1 : 2;
    const bool allowed = cosine < flat_cosine && cosine > sharpest;
    const double price = price_ * (second.price + (size < right_cosine ? 0 : oblique_price));
    return {zone, allowed ? static_cast<float>(price) : infinite};
}

Turns PathFinder::turns_up_to(double sharpest) const {
    const std::size_t n = headings_.size();
    Turns found{sharpest, {}};
    for (std::size_t from = 0; from < n; from += quarter_turns)
        for (std::size_t to = 0; to < n; ++to)
            if (const Turn change = turn(from, to, sharpest); change.cost < infinite) {
                const std::size_t q = to % quarter_turns;
                found.allowed.push_back({2 * (change.zone * n + from) + (quarter_turns - q) % quarter_turns,
                                         change.zone * n + to - q, change.cost});
            }
    return found;
}

void PathFinder::set_costs() {
    const std::size_t width = windows_.width;
    distance_costs_.resize((fractions + 1) * width);
    for (std::size_t f = 0; f <= fractions; ++f)
        for (std::size_t w = 0; w < width; ++w) {
            const double shift = static_cast<double>(f) / fractions - 0.5;  // of the window from the step
            const double offset = -(shift + static_cast<double>(w) - static_cast<double>(half_)) * interval_;
            distance_costs_[f * width + w] =
                w > 2 * half_ ? infinite : static_cast<float>(distance_cost(offset, higher_));
        }
}

/// Each step pays for its distance, whichever way it runs: if those that run across their wall were free, a
/// porch would vanish behind a wall of no length.
void PathFinder::set_steps(std::size_t step) {
    const Vec2 along = samples_.at(step + 1) - samples_.at(step);
    const Vec2 middle = samples_.midpoint(step);
    const double size = length(along);
    const auto farthest = static_cast<std::int64_t>(windows_.padding);
    for (std::size_t h = 0; h < headings_.size(); ++h) {
        const double facing = dot(along, headings_[h].along);
        const double at = cross(headings_[h].along, middle) * per_interval_;
        const double whole = nearest_integer(at);
        const auto base = static_cast<std::int64_t>(whole);
        const auto fraction = static_cast<std::size_t>(nearest_integer((whole - at + 0.5) * fractions));
        steps_[h] = {std::clamp(base - bases_[h], -farthest, farthest),
                     distance_costs_.data() + fraction * windows_.width, static_cast<float>(size),
                     static_cast<float>(tie_price_ * (size - facing))};
        bases_[h] = base;
    }
}

void PathFinder::begin(std::size_t step, const std::optional<WallLine>& line, float* costs) {
    std::fill_n(costs, row_, infinite);
    set_steps(step);
    for (std::size_t h = 0; h < headings_.size(); ++h) {
        float* own = costs + windows_.begin(h);
        if (!line) {
            for (std::size_t w = 0; w <= 2 * half_; ++w)
                own[w] = steps_[h].factor * steps_[h].costs[w] + steps_[h].fixed;
        } else if (line->heading == h) {
            const std::int64_t w = line->offset - bases_[h] + static_cast<std::int64_t>(half_);
            if (w >= 0 && w <= static_cast<std::int64_t>(2 * half_))
                own[w] = 0;
        }
    }
    find_endings(costs);
}

void PathFinder::find_endings(const float* costs) {
    for (std::size_t z = 0; z < zone_count; ++z)
        for (std::size_t h = 0; h < headings_.size(); ++h) {
            const float* middle = costs + windows_.begin(h) + half_;
            float* least = &ending(z, h);
            least[0] = least[quarter_turns] =
                *std::min_element(middle - zone_half_[z], middle + zone_half_[z] + 1);
        }
}

void PathFinder::advance(std::size_t step, const float* before, float* costs, float* beginnings) {
    std::fill_n(beginnings, zone_count * headings_.size(), infinite);
    for (const FamilyTurn& turn : turns(step).allowed) {
        const float* ended = endings_.data() + turn.ending;
        float* begun = beginnings + turn.beginning;
        store(smaller(load(begun), load(ended) + turn.cost), begun);
    }
    set_steps(step);
    advance_headings(windows_, steps_, before, beginnings, costs, endings_.data());
    // Costs stay small, because sums of floats are exact to a share of their size.
    if (step % 64 == 0) {
        const float least = *std::ranges::min_element(endings_);
        if (least < infinite) {
            for (std::size_t i = 0; i < row_; ++i)
                costs[i] -= least;
            for (float& ending : endings_)
                ending -= least;
        }
    }
}

WallLine PathFinder::before(std::size_t step, WallLine line, const float* costs, const float* beginnings) {
    const std::size_t n = headings_.size();
    const auto half = static_cast<std::int64_t>(half_);
    const std::int64_t own = line.offset - base(step, line.heading);
    const std::int64_t same = line.offset - base(step - 1, line.heading);
    float least = std::abs(same) <= half
                      ? costs[windows_.begin(line.heading) + static_cast<std::size_t>(same + half)]
                      : infinite;
    std::optional<std::size_t> turned;
    for (std::size_t z = 0; z < zone_count; ++z)
        if (std::abs(own) <= static_cast<std::int64_t>(zone_half_[z]) &&
            beginnings[z * n + line.heading] < least) {
            least = beginnings[z * n + line.heading];
            turned = z;
        }
    if (!turned)
        return line;
    find_endings(costs);
    std::size_t from = 0;
    const auto is_best = [&] {
        const Turn there = turn(from, line.heading, turns(step).sharpest);
        return there.zone == *turned && ending(*turned, from) + there.cost == least;
    };
    while (!is_best())
        ++from;
    const float* ended = costs + windows_.begin(from);
    std::size_t offset = half_ - zone_half_[*turned];
    while (ended[offset] != ending(*turned, from))
        ++offset;
    return {from, base(step - 1, from) + static_cast<std::int64_t>(offset) - half};
}

std::optional<WallLine> PathFinder::cheapest_line(std::size_t step, const float* costs,
                                                  const std::optional<WallLine>& only) const {
    const auto half = static_cast<std::int64_t>(half_);
    if (only) {
        const std::int64_t w = only->offset - base(step, only->heading);
        if (std::abs(w) > half ||
            costs[windows_.begin(only->heading) + static_cast<std::size_t>(w + half)] == infinite)
            return {};
        return only;
    }
    const auto least = static_cast<std::size_t>(std::min_element(costs, costs + row_) - costs);
    if (costs[least] == infinite)
        return {};
    const std::size_t heading = (least - windows_.padding) / (windows_.width + windows_.padding);
    return WallLine{heading, base(step, heading) + static_cast<std::int64_t>(least) -
                                 static_cast<std::int64_t>(windows_.begin(heading)) - half};
}

std::vector<WallLine> PathFinder::find(std::size_t first, std::size_t last,
                                       const std::optional<std::pair<WallLine, WallLine>>& ends) {
    const std::size_t n = last - first;
    const std::size_t blocks = (n + block - 1) / block;
    std::vector<float> starts(blocks * row_);  // costs of the first step of each block
    const auto beginnings = [&](std::size_t k) {
        return beginnings_.data() + k * zone_count * headings_.size();
    };
    const auto fill = [&](std::size_t b) {
        std::copy_n(starts.data() + b * row_, row_, costs_.data());
        for (std::size_t h = 0; h < headings_.size(); ++h)
            bases_[h] = base(first + b * block, h);
        find_endings(costs_.data());
        const std::size_t end = std::min(n, (b + 1) * block);
        for (std::size_t k = b * block + 1; k < end; ++k) {
            if (k % 64 == 0)
                stop_.check();
            float* own = costs_.data() + (k - b * block) * row_;
            advance(first + k, own - row_, own, beginnings(k - b * block));
        }
        return costs_.data() + (end - 1 - b * block) * row_;
    };
    begin(first, ends ? std::optional(ends->first) : std::nullopt, starts.data());
    const float* reached = nullptr;
    for (std::size_t b = 0; b < blocks; ++b) {
        reached = fill(b);
        if (b + 1 < blocks)
            advance(first + (b + 1) * block, reached, starts.data() + (b + 1) * row_, beginnings(block));
    }
    const std::optional<WallLine> reached_line =
        cheapest_line(last - 1, reached, ends ? std::optional(ends->second) : std::nullopt);
    if (!reached_line)
        return {};
    WallLine line = *reached_line;
    std::vector<WallLine> lines(n);
    std::vector<float> next;
    for (std::size_t b = blocks; b-- > 0;) {
        if (b + 1 < blocks) {
            // The costs of beginning a wall at the next block are found anew with those of this one.
            const float* end = fill(b);
            next.resize(row_);
            advance(first + (b + 1) * block, end, next.data(), beginnings(block));
            line = before(first + (b + 1) * block, line, end, beginnings(block));
        }
        for (std::size_t k = std::min(n, (b + 1) * block); k-- > b * block;) {
            lines[k] = line;
            if (k > b * block)
                line = before(first + k, line, costs_.data() + (k - b * block - 1) * row_,
                              beginnings(k - b * block));
        }
    }
    return lines;
}

/// Steps beside corners at which two stretches of eight cells or more enclose less than 58 degrees.
std::vector<std::uint8_t> sharp_steps(const TraceSums& samples, const std::vector<std::size_t>& points) {
    constexpr double min_length = 8;  // cells
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

double distance_cost(double offset, int higher) {
    const double away = std::abs(offset);
    const double factor = higher * offset > 0 ? outside_cost : 1;
    return away < soft_distance ? away * away / (2 * soft_distance)
                                : factor * (away - soft_distance) + soft_distance / 2;
}

std::optional<std::vector<WallSegment>> find_walls(const TraceSums& samples, std::size_t first,
                                                   std::size_t last, const std::vector<std::size_t>& points,
                                                   const WallParameters& parameters,
                                                   const WallDirections& directions, const StopToken& stop) {
    constexpr std::size_t least_diagonal = 16;  // steps; a ring of a few cells would become a diamond
    const std::size_t steps = samples.steps();
    const bool around = samples.closed() && last - first == steps;
    PathFinder finder(samples, parameters, headings_of(directions, parameters.walls, steps >= least_diagonal),
                      sharp_steps(samples, points), last - first + 1, stop);
    std::vector<WallLine> lines;
    if (around) {
        // The line at the cut is found first, among the steps around it.
        constexpr std::size_t reach = 24;
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
    remove_backward_walls(around, around ? steps : last, walls);
    if (around && walls.size() < 3)
        return {};
    return walls;
}

}  // namespace d2b::outline
