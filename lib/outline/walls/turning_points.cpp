#include "outline/walls/turning_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace d2b {
namespace {

constexpr double nearness = 0.8;           // cells
constexpr std::size_t longest_look = 512;  // steps; bounds the time spent on a long chain

void divide(const WallSamples& samples, std::size_t begin, std::size_t end,
            std::vector<std::size_t>& points) {
    std::vector<std::pair<std::size_t, std::size_t>> open;
    open.reserve(16);
    open.emplace_back(begin, end);
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        double largest = nearness * nearness;
        std::size_t farthest = first;
        const Vec from = samples.at(first);
        const Vec to = samples.at(last);
        samples.for_corners(first + 1, last - 1, [&](std::size_t i, Vec corner) {
            const double off = square_distance(corner, from, to);
            if (off > largest) {
                largest = off;
                farthest = i;
            }
            return true;
        });
        if (farthest == first)
            continue;
        points.push_back(farthest);
        open.emplace_back(first, farthest);
        open.emplace_back(farthest, last);
    }
}

}  // namespace

std::vector<std::size_t> turning_points(const WallSamples& samples) {
    const std::size_t n = samples.steps();
    std::vector<std::size_t> points;
    points.reserve(32);
    points.push_back(0);
    std::size_t begin = 0;
    while (begin < n) {
        std::size_t end = n;
        // A closed chain begins and ends at the same point, so it is first divided at the point farthest from
        // it.
        if (samples.closed() && begin == 0) {
            double largest = 0;
            samples.for_corners(1, n - 1, [&](std::size_t i, Vec corner) {
                if (dot(corner, corner) > largest) {
                    largest = dot(corner, corner);
                    end = i;
                }
                return true;
            });
        }
        end = std::min(end, begin + longest_look);
        if (end < n || !samples.closed())
            points.push_back(end);
        divide(samples, begin, end, points);
        begin = end;
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

double dominant_direction(const WallSamples& samples, const std::vector<std::size_t>& points) {
    Vec sum;
    for (std::size_t i = 0; i + (samples.closed() ? 0 : 1) < points.size(); ++i) {
        const std::size_t first = points[i];
        const std::size_t last = i + 1 < points.size() ? points[i + 1] : samples.steps();
        const WallSamples::Sums sums = samples.sums(first, last);
        if (sums.n < 3)
            continue;
        const Vec along = sums.direction();
        const auto doubled = [](Vec v) { return Vec{v.x * v.x - v.y * v.y, 2 * v.x * v.y}; };
        // The certainty of the direction of a stretch grows with the cube of its length.
        const double weight = sums.xx + sums.yy;
        sum = sum + weight * doubled(doubled(along));  // four times its angle
    }
    return sum == Vec{} ? 0 : std::atan2(sum.y, sum.x) / 4;
}

}  // namespace d2b
