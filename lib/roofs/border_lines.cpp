#include "roofs/border_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>

#include "core/disjoint_sets.hpp"

namespace d2b::roofs {
namespace {

/// Distance in cells from the building up to which borders are followed.
constexpr float border_reach = 3.5F;

/// Border between two labels along the sides of cells, from junction to junction or closed.
struct Chain {
    std::vector<std::uint32_t> corners;  ///< of the grid's lattice
    std::int32_t low = 0;                ///< label
    std::int32_t high = 0;
};

/// Borders between labels as a graph over the corners of cells.
class BorderGraph {
  public:
    BorderGraph(const BuildingGrid& grid, const NearestLabels& labels)
        : grid_(grid),
          labels_(labels),
          width_(static_cast<std::uint32_t>(grid.cols) + 1),
          sides_(static_cast<std::size_t>(width_) * (static_cast<std::size_t>(grid.rows) + 1)),
          offsets_{1, -1, static_cast<std::int32_t>(width_), -static_cast<std::int32_t>(width_)} {
        for (std::int32_t row = 1; row < grid.rows; ++row)
            for (std::int32_t col = 1; col < grid.cols; ++col)
                add_sides(row, col);
    }

    [[nodiscard]] std::vector<Chain> chains() {
        std::vector<Chain> chains;
        for (std::uint32_t corner = 0; corner < sides_.size(); ++corner)
            if (sides_[corner] != 0 && is_junction(corner))
                take_chains(corner, chains);
        for (std::uint32_t corner = 0; corner < sides_.size(); ++corner)
            take_chains(corner, chains);  // closed ones
        return chains;
    }
    [[nodiscard]] bool is_junction(std::uint32_t corner) const { return degree_[corner] != 2; }
    /// True if no cell at a corner belongs to the building.
    [[nodiscard]] bool is_outside(std::uint32_t corner) const {
        const auto row = static_cast<std::int32_t>(corner / width_);
        const auto col = static_cast<std::int32_t>(corner % width_);
        const std::array cells{grid_.index(row - 1, col - 1), grid_.index(row - 1, col),
                               grid_.index(row, col - 1), grid_.index(row, col)};
        return std::ranges::all_of(cells, [&](std::size_t cell) { return labels_.distances[cell] > 0; });
    }
    [[nodiscard]] Vec2 point(std::uint32_t corner) const {
        const std::uint32_t row = corner / width_;
        return {grid_.x(corner % width_), grid_.y(row)};
    }
    /// Computes the numbers of sides before chains() removes them.
    void count_degrees() {
        degree_.resize(sides_.size());
        for (std::size_t i = 0; i < sides_.size(); ++i)
            degree_[i] = static_cast<std::uint8_t>(__builtin_popcount(sides_[i]));
    }

  private:
    enum Direction : std::uint8_t { right, left, down, up };

    /// Adds the sides to the right of and below a corner.
    void add_sides(std::int32_t row, std::int32_t col) {
        const std::size_t below = grid_.index(row, col);
        const std::size_t above = grid_.index(row - 1, col);
        const std::size_t beside = grid_.index(row, col - 1);
        const auto corner = static_cast<std::uint32_t>(row) * width_ + static_cast<std::uint32_t>(col);
        const auto is_border = [&](std::size_t a, std::size_t b) {
            return labels_.labels[a] != labels_.labels[b] &&
                   std::min(labels_.distances[a], labels_.distances[b]) <= border_reach;
        };
        if (is_border(above, below))
            add(corner, right);
        if (is_border(beside, below))
            add(corner, down);
    }
    [[nodiscard]] static Direction opposite(Direction direction) {
        return static_cast<Direction>(direction ^ 1U);
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner, Direction direction) const {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(corner) + offsets_[direction]);
    }
    void add(std::uint32_t corner, Direction direction) {
        sides_[corner] |= static_cast<std::uint8_t>(1U << direction);
        sides_[next(corner, direction)] |= static_cast<std::uint8_t>(1U << opposite(direction));
    }
    void remove(std::uint32_t corner, Direction direction) {
        sides_[corner] &= static_cast<std::uint8_t>(~(1U << direction));
        sides_[next(corner, direction)] &= static_cast<std::uint8_t>(~(1U << opposite(direction)));
    }
    /// Labels on both sides of the first side of a chain.
    void set_labels(std::uint32_t corner, Direction direction, Chain& chain) const {
        const std::uint32_t from = std::min(corner, next(corner, direction));
        const auto row = static_cast<std::int32_t>(from / width_);
        const auto col = static_cast<std::int32_t>(from % width_);
        const bool is_row = direction == right || direction == left;
        const std::int32_t one = labels_.labels[grid_.index(row, col)];
        const std::int32_t other =
            labels_.labels[is_row ? grid_.index(row - 1, col) : grid_.index(row, col - 1)];
        std::tie(chain.low, chain.high) = std::minmax(one, other);
    }
    void take_chains(std::uint32_t corner, std::vector<Chain>& chains) {
        for (const Direction direction : {right, left, down, up})
            if ((sides_[corner] >> direction & 1U) != 0)
                chains.push_back(take_chain(corner, direction));
    }
    [[nodiscard]] Chain take_chain(std::uint32_t corner, Direction direction) {
        Chain chain;
        set_labels(corner, direction, chain);
        chain.corners.push_back(corner);
        const std::uint32_t first = corner;
        for (;;) {
            remove(corner, direction);
            corner = next(corner, direction);
            chain.corners.push_back(corner);
            if (is_junction(corner) || corner == first || sides_[corner] == 0)
                return chain;
            direction = static_cast<Direction>(__builtin_ctz(sides_[corner]));
        }
    }

    const BuildingGrid& grid_;
    const NearestLabels& labels_;
    std::uint32_t width_;
    std::vector<std::uint8_t> sides_;   ///< by corner: bits of the directions that are left
    std::vector<std::uint8_t> degree_;  ///< by corner: number of sides
    std::array<std::int32_t, 4> offsets_;
};

/// Line through a point with a unit normal.
struct FittedLine {
    Vec2 through;
    Vec2 normal;
    double weight = 1;
};

Vec2 middle(Vec2 a, Vec2 b) {
    return 0.5 * (a + b);
}

/// Total least squares through points.
FittedLine fit_line(std::span<const Vec2> points) {
    Vec2 mean;
    for (const Vec2& p : points) {
        mean = mean + p;
    }
    mean.x /= static_cast<double>(points.size());
    mean.y /= static_cast<double>(points.size());
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Vec2& p : points) {
        const Vec2 d = p - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double angle = std::atan2(2 * xy, xx - yy) / 2;  // of the line
    return {mean, {-std::sin(angle), std::cos(angle)}};
}

/// Sums of the middles of the sides of a chain, from which the error of a line along any stretch follows.
class StretchSums {
  public:
    explicit StretchSums(std::span<const Vec2> points) : origin_(points.front()), sums_(points.size()) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec2 m = middle(points[i], points[i + 1]) - origin_;
            const Sums& s = sums_[i];
            sums_[i + 1] = {s.x + m.x, s.y + m.y, s.xx + m.x * m.x, s.xy + m.x * m.y, s.yy + m.y * m.y};
        }
    }
    /// Squared distances in cells of the middles of the sides from `first` to `end` from their best line.
    [[nodiscard]] double error(std::size_t first, std::size_t end) const {
        const auto n = static_cast<double>(end - first);
        const Sums& a = sums_[first];
        const Sums& b = sums_[end];
        const double x = b.x - a.x;
        const double y = b.y - a.y;
        const double xx = b.xx - a.xx - x * x / n;
        const double xy = b.xy - a.xy - x * y / n;
        const double yy = b.yy - a.yy - y * y / n;
        return std::max(0.0, (xx + yy - std::hypot(xx - yy, 2 * xy)) / 2);
    }

  private:
    struct Sums {
        double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    };
    Vec2 origin_;
    std::vector<Sums> sums_;
};

/// Divides a stretch of a chain into lines with the least sum of squared distances and of a price per line,
/// by dynamic programming (Perez and Vidal 1994). Appends the ends of the lines but the last.
/// @param price squared cells
void divide_into_lines(std::span<const Vec2> points, std::size_t first, std::size_t last, double price,
                       std::vector<std::size_t>& ends) {
    constexpr std::size_t longest = 400;  // sides
    // Square cells per side that a slanted straight line is off its staircase; without it, high steps would
    // follow each stair.
    constexpr double staircase = 0.06;
    const StretchSums sums(points.subspan(first, last - first + 1));
    const std::size_t sides = last - first;
    std::vector<double> costs(sides + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(sides + 1, 0);
    costs[0] = 0;
    for (std::size_t end = 1; end <= sides; ++end)
        for (std::size_t begin = end > longest ? end - longest : 0; begin < end; ++begin) {
            const double off = sums.error(begin, end) - staircase * static_cast<double>(end - begin);
            const double cost = costs[begin] + std::max(off, 0.0) + price;
            if (cost < costs[end]) {
                costs[end] = cost;
                from[end] = begin;
            }
        }
    const std::size_t before = ends.size();
    for (std::size_t end = sides; end > 0; end = from[end])
        ends.push_back(first + from[end]);
    std::reverse(ends.begin() + static_cast<std::ptrdiff_t>(before), ends.end());
}

/// Stretch of a chain that is a crease or a step.
struct Run {
    std::size_t first;  ///< side
    std::size_t end;
    bool crease;
};

/// Difference of the planes beside a chain.
struct PlaneDifference {
    Vec2 slope;
    double z0 = 0;
    double steepness = 0;  ///< metres per cell

    PlaneDifference(const Plane& a, const Plane& b)
        : slope{a.slope_x - b.slope_x, a.slope_y - b.slope_y},
          z0(a.z0 - b.z0),
          steepness(std::hypot(slope.x, slope.y)) {}
    [[nodiscard]] double at(const Vec2& p) const { return dot(slope, p) + z0; }
    /// Line in which the planes meet.
    [[nodiscard]] FittedLine line() const {
        const double scale = -z0 / (steepness * steepness);
        return {scale * slope, {slope.x / steepness, slope.y / steepness}};
    }
};

/// Lines of chains with common ends.
class LineDrawing {
  public:
    LineDrawing(const BuildingGrid& grid, const BorderGraph& graph, const std::vector<Plane>& planes,
                const BorderOptions& options)
        : grid_(grid), graph_(graph), planes_(planes), options_(options) {}

    void add(const Chain& chain);
    [[nodiscard]] std::vector<BorderLine> lines();

  private:
    /// Node of a junction; a corner has one node.
    [[nodiscard]] std::uint32_t node(std::uint32_t corner);
    void add_line(std::uint32_t from, std::uint32_t to, const std::optional<FittedLine>& line);
    void add_step(const Chain& chain, std::span<const Vec2> points, const Run& run,
                  const PlaneDifference& difference);
    [[nodiscard]] std::vector<bool> crease_sides(std::span<const Vec2> points,
                                                 const PlaneDifference& difference) const;
    [[nodiscard]] std::vector<Run> runs(std::span<const Vec2> points,
                                        const PlaneDifference& difference) const;
    [[nodiscard]] static bool spans(std::span<const Vec2> points, const Run& run,
                                    const PlaneDifference& difference);
    [[nodiscard]] static Vec2 place(const Vec2& mean, const std::vector<FittedLine>& lines, double max_move);

    struct Line {
        std::uint32_t from;
        std::uint32_t to;
    };
    const BuildingGrid& grid_;
    const BorderGraph& graph_;
    const std::vector<Plane>& planes_;
    const BorderOptions& options_;
    std::unordered_map<std::uint32_t, std::uint32_t> nodes_;  ///< by corner
    std::vector<Vec2> corners_;                               ///< by node
    std::vector<bool> is_outside_;                            ///< by node
    std::vector<std::vector<FittedLine>> through_;            ///< by node: lines that should pass it
    DisjointSets merged_;                                     ///< nodes of collapsed chains
    std::vector<Line> lines_;
};

std::uint32_t LineDrawing::node(std::uint32_t corner) {
    const auto [known, is_new] = nodes_.try_emplace(corner, merged_.size());
    if (!is_new)
        return known->second;
    const std::uint32_t added = merged_.add();
    corners_.push_back(graph_.point(corner));
    is_outside_.push_back(graph_.is_outside(corner));
    through_.emplace_back();
    return added;
}

void LineDrawing::add_line(std::uint32_t from, std::uint32_t to, const std::optional<FittedLine>& line) {
    if (line) {
        through_[from].push_back(*line);
        through_[to].push_back(*line);
    }
    lines_.push_back({from, to});
}

/// True if a crease runs along the line in which the planes meet and not across it.
bool LineDrawing::spans(std::span<const Vec2> points, const Run& run, const PlaneDifference& difference) {
    constexpr double least_share = 0.6;
    const Vec2 along{-difference.slope.y / difference.steepness, difference.slope.x / difference.steepness};
    Vec2 low = points[run.first];
    Vec2 high = low;
    double from = dot(along, low);
    double to = from;
    for (std::size_t i = run.first; i <= run.end; ++i) {
        low = {std::min(low.x, points[i].x), std::min(low.y, points[i].y)};
        high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
        from = std::min(from, dot(along, points[i]));
        to = std::max(to, dot(along, points[i]));
    }
    return to - from >= least_share * std::hypot(high.x - low.x, high.y - low.y);
}

/// Finds the sides of a chain that lie near the line in which the planes meet; the majority of five decides.
std::vector<bool> LineDrawing::crease_sides(std::span<const Vec2> points,
                                            const PlaneDifference& difference) const {
    constexpr double least_bend = 0.08;      // difference of slopes
    constexpr double crease_distance = 1.5;  // cells from the line in which the planes meet
    constexpr double crease_step_m = 1.0;
    constexpr std::size_t smoothed = 2;  // sides to both sides
    const std::size_t sides = points.size() - 1;
    std::vector<bool> crease(sides, false);
    if (difference.steepness <= least_bend * grid_.cell_m)
        return crease;
    std::vector<int> near(sides);
    for (std::size_t i = 0; i < sides; ++i) {
        const double step = std::abs(difference.at(middle(points[i], points[i + 1])));
        near[i] = step / difference.steepness <= crease_distance && step < crease_step_m ? 1 : 0;
    }
    for (std::size_t i = 0; i < sides; ++i) {
        if (sides < 2 * smoothed + 1) {
            crease[i] = near[i] != 0;
            continue;
        }
        int votes = 0;
        for (std::size_t k = 0; k <= 2 * smoothed; ++k)
            votes += near[std::clamp<std::size_t>(i + k, smoothed, sides - 1 + smoothed) - smoothed];
        crease[i] = votes > static_cast<int>(smoothed);
    }
    return crease;
}

/// Divides a chain into creases and steps. Short runs join their neighbours.
std::vector<Run> LineDrawing::runs(std::span<const Vec2> points, const PlaneDifference& difference) const {
    constexpr std::size_t shortest = 4;  // sides
    const std::vector<bool> crease = crease_sides(points, difference);
    std::vector<Run> runs;
    for (std::size_t i = 0; i < crease.size(); ++i)
        if (runs.empty() || runs.back().crease != crease[i])
            runs.push_back({i, i + 1, crease[i]});
        else
            runs.back().end = i + 1;
    const auto is_short = [](const Run& run) { return run.end - run.first < shortest; };
    for (std::size_t k = 0; runs.size() > 1 && k < runs.size();) {
        if (is_short(runs[k])) {
            Run& into = k > 0 ? runs[k - 1] : runs[k + 1];
            into.first = std::min(into.first, runs[k].first);
            into.end = std::max(into.end, runs[k].end);
            runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
            k = 0;
        } else if (k > 0 && runs[k].crease == runs[k - 1].crease) {
            runs[k - 1].end = runs[k].end;
            runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
            ++k;
        }
    }
    return runs;
}

/// Mean square of the step between two planes along a stretch.
double squared_height(std::span<const Vec2> points, const Run& run, const PlaneDifference& difference) {
    double sum = 0;
    for (std::size_t i = run.first; i < run.end; ++i) {
        const double step = difference.at(middle(points[i], points[i + 1]));
        sum += step * step;
    }
    return sum / static_cast<double>(run.end - run.first);
}

void LineDrawing::add_step(const Chain& chain, std::span<const Vec2> points, const Run& run,
                           const PlaneDifference& difference) {
    constexpr double weight = 0.3;       // of a step line beside creases
    constexpr std::size_t shortest = 4;  // sides of a line that is fitted
    constexpr double line_price = 2;     // m2 times the square of a step in m
    constexpr double least_step = 0.5;   // m
    constexpr double most_step = 5;
    // A line that cuts off an area loses the square of the step there.
    const double squared_step =
        std::clamp(squared_height(points, run, difference), least_step * least_step, most_step * most_step);
    const double price = line_price / (squared_step * grid_.cell_m * grid_.cell_m);
    std::vector<std::size_t> kept;
    std::size_t far = run.first;
    if (chain.corners[run.first] == chain.corners[run.end]) {
        // A closed chain has two ends that are far from each other.
        double most = -1;
        for (std::size_t i = run.first; i < run.end; ++i) {
            const Vec2 d = points[i] - points[run.first];
            if (const double distance = std::hypot(d.x, d.y); distance > most) {
                most = distance;
                far = i;
            }
        }
    }
    if (far != run.first)
        divide_into_lines(points, run.first, far, price, kept);
    divide_into_lines(points, far, run.end, price, kept);
    kept.push_back(run.end);
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        std::optional<FittedLine> line;
        if (kept[k + 1] - kept[k] >= shortest) {
            std::vector<Vec2> middles;
            for (std::size_t i = kept[k]; i < kept[k + 1]; ++i)
                middles.push_back(middle(points[i], points[i + 1]));
            line = fit_line(middles);
            line->weight = weight;
        }
        const std::uint32_t from = node(chain.corners[kept[k]]);
        add_line(from, node(chain.corners[kept[k + 1]]), line);
    }
}

void LineDrawing::add(const Chain& chain) {
    constexpr std::size_t collapsed = 2;  // sides between two junctions that become one
    const std::size_t sides = chain.corners.size() - 1;
    const std::uint32_t first = chain.corners.front();
    const std::uint32_t last = chain.corners.back();
    if (sides <= collapsed && first != last && graph_.is_junction(first) && graph_.is_junction(last)) {
        const std::uint32_t from = node(first);
        merged_.join(from, node(last));
        return;
    }
    std::vector<Vec2> points;
    for (const std::uint32_t corner : chain.corners)
        points.push_back(graph_.point(corner));
    const PlaneDifference difference(planes_[static_cast<std::size_t>(chain.low)],
                                     planes_[static_cast<std::size_t>(chain.high)]);
    for (Run run : runs(points, difference)) {
        const bool whole_ring = first == last && run.end - run.first == sides;
        run.crease = run.crease && !whole_ring && spans(points, run, difference);
        if (run.crease) {
            const std::uint32_t from = node(chain.corners[run.first]);
            add_line(from, node(chain.corners[run.end]), difference.line());
        } else {
            add_step(chain, points, run, difference);
        }
    }
}

/// Moves a node to the lines that should pass it.
Vec2 LineDrawing::place(const Vec2& mean, const std::vector<FittedLine>& lines, double max_move) {
    constexpr double stay = 0.02;  // weight of not moving
    double xx = stay;
    double xy = 0;
    double yy = stay;
    Vec2 pull;
    for (const FittedLine& line : lines) {
        const Vec2& n = line.normal;
        const double distance = dot(n, line.through - mean);
        xx += line.weight * n.x * n.x;
        xy += line.weight * n.x * n.y;
        yy += line.weight * n.y * n.y;
        pull.x += line.weight * n.x * distance;
        pull.y += line.weight * n.y * distance;
    }
    const double determinant = xx * yy - xy * xy;
    const Vec2 move{(pull.x * yy - pull.y * xy) / determinant, (pull.y * xx - pull.x * xy) / determinant};
    const double length = std::hypot(move.x, move.y);
    const double share = length > max_move ? max_move / length : 1;
    return mean + share * move;
}

std::vector<BorderLine> LineDrawing::lines() {
    struct Group {
        Vec2 sum;
        double count = 0;
        std::vector<FittedLine> lines;
        Vec2 at;
        bool outside = false;
    };
    std::vector<Group> groups(corners_.size());
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
        Group& group = groups[merged_.find(i)];
        group.sum = group.sum + corners_[i];
        ++group.count;
        group.outside = group.outside || is_outside_[i];
        group.lines.insert(group.lines.end(), through_[i].begin(), through_[i].end());
    }
    for (Group& group : groups)
        if (group.count > 0)
            // Beyond the building the labels say nothing about where a line goes on.
            group.at = place({group.sum.x / group.count, group.sum.y / group.count}, group.lines,
                             group.outside ? std::numeric_limits<double>::infinity() : options_.max_move);
    std::vector<BorderLine> result;
    for (const Line& line : lines_)
        if (const std::uint32_t from = merged_.find(line.from), to = merged_.find(line.to); from != to)
            result.push_back({groups[from].at, groups[to].at});
    return result;
}

}  // namespace

std::vector<BorderLine> border_lines(const BuildingGrid& grid, const NearestLabels& labels,
                                     const std::vector<Plane>& planes, const BorderOptions& options) {
    BorderGraph graph(grid, labels);
    graph.count_degrees();
    LineDrawing drawing(grid, graph, planes, options);
    for (const Chain& chain : graph.chains())
        drawing.add(chain);
    return drawing.lines();
}

}  // namespace d2b::roofs
