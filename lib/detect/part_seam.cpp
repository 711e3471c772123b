#include "detect/part_seam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace d2b {
namespace {

constexpr double straight = 1.3;         // RMS in cells
constexpr std::size_t fewest_edges = 4;  // minimum per line at a corner
constexpr double sharpest = 0.8;         // cosine of the angle between two walls
constexpr int rounds_of_halving = 8;

double distance_along(const SeamLine& line, const MetrePlace& place) {
    return (place.x - line.middle.x) * line.along.x + (place.y - line.middle.y) * line.along.y;
}

double distance_from(const SeamLine& line, const MetrePlace& place) {
    return std::abs((place.x - line.middle.x) * line.inward.x + (place.y - line.middle.y) * line.inward.y);
}

}  // namespace

void PartSeam::add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell) {
    edges_.push_back({{(col + 0.5 + 0.5 * across) * cell.across, (row + 0.5 + 0.5 * down) * cell.down},
                      {across * cell.down, down * cell.across}});
}

double PartSeam::free_share() const {
    const auto free = static_cast<double>(free_);
    return edges_.empty() ? 1 : free / (free + static_cast<double>(edges_.size()));
}

std::optional<SeamLine> PartSeam::straight_line(const CellSize& cell) const {
    return fitted_line(straight * straight * cell.area());
}

std::optional<SeamLine> PartSeam::fitted_line(double most_squared) const {
    if (edges_.empty())
        return std::nullopt;
    const auto n = static_cast<double>(edges_.size());
    SeamLine line;
    MetrePlace to_rest;
    for (const auto& [p, way] : edges_) {
        line.middle.x += p.x / n;
        line.middle.y += p.y / n;
        to_rest.x += way.x;
        to_rest.y += way.y;
    }
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const auto& [p, way] : edges_) {
        const double x = p.x - line.middle.x;
        const double y = p.y - line.middle.y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    const double spread = std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
    if ((xx + yy - spread) / 2 > n * most_squared)
        return std::nullopt;
    // Half the angle of (xx - yy, 2 xy).
    const double turned = spread > 0 ? (xx - yy) / spread : 1;
    line.along = {std::sqrt((1 + turned) / 2), std::copysign(std::sqrt((1 - turned) / 2), xy)};
    line.inward = {-line.along.y, line.along.x};
    if (line.inward.x * to_rest.x + line.inward.y * to_rest.y < 0)
        line.inward = {line.along.y, -line.along.x};
    for (const auto& [p, way] : edges_) {
        const double t = distance_along(line, p);
        line.first = std::min(line.first, t);
        line.last = std::max(line.last, t);
    }
    return line;
}

PartSeam PartSeam::half(const std::vector<std::uint8_t>& is_second, std::uint8_t which) const {
    PartSeam some;
    for (std::size_t i = 0; i < edges_.size(); ++i)
        if (is_second[i] == which)
            some.edges_.push_back(edges_[i]);
    return some;
}

std::optional<CornerSeam> PartSeam::corner(const CellSize& cell) const {
    constexpr double any = std::numeric_limits<double>::infinity();
    const std::optional<SeamLine> whole = fitted_line(any);
    if (!whole)
        return std::nullopt;
    // Fits two lines by k-means, starting from a division in the middle: each edge is assigned to the nearer
    // line, then the lines are fitted again.
    std::vector<std::uint8_t> is_second(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i)
        is_second[i] = distance_along(*whole, edges_[i].middle) > 0 ? 1 : 0;
    for (int round = 0; round < rounds_of_halving; ++round) {
        const std::optional<SeamLine> one = half(is_second, 0).fitted_line(any);
        const std::optional<SeamLine> other = half(is_second, 1).fitted_line(any);
        if (!one || !other)
            return std::nullopt;
        for (std::size_t i = 0; i < edges_.size(); ++i)
            is_second[i] =
                distance_from(*other, edges_[i].middle) < distance_from(*one, edges_[i].middle) ? 1 : 0;
    }
    const PartSeam first = half(is_second, 0);
    const PartSeam second = half(is_second, 1);
    const std::optional<SeamLine> one = first.straight_line(cell);
    const std::optional<SeamLine> other = second.straight_line(cell);
    if (!one || !other || std::min(first.edges_.size(), second.edges_.size()) < fewest_edges ||
        std::abs(one->along.x * other->along.x + one->along.y * other->along.y) > sharpest)
        return std::nullopt;
    return CornerSeam{*one, *other};
}

std::vector<PartSeam> seams_of(const DetectedObjects& parts, const Mask& rest, const CellSize& cell,
                               Executor& threads) {
    std::vector<PartSeam> seams(parts.regions.count());
    for_runs_by_label(threads, parts.regions, [&](std::int32_t r, const RegionRun& run) {
        PartSeam& seam = seams[run.label - 1];
        const auto look = [&](std::int32_t c, int down, int across) {
            const std::int32_t y = r + down;
            const std::int32_t x = c + across;
            if (y < 0 || x < 0 || y >= rest.rows || x >= rest.cols)
                return;
            if (rest.at(y, x) != 0)
                seam.add(r, c, down, across, cell);
            else if (parts.cells.at(y, x) == 0)
                seam.add_free();
        };
        look(run.begin, 0, -1);
        look(run.end - 1, 0, 1);
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            look(c, -1, 0);
            look(c, 1, 0);
        }
    });
    return seams;
}

}  // namespace d2b
