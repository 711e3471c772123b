#include "street_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "draft.hpp"

namespace d2b::sample {

namespace {

constexpr double avenue = 11;  // metres from an avenue's middle line to the buildings
constexpr double street = 12;  // metres from site to site; twice the bank of a terrace

bool inside(const Quad& quad, const Position& p) {
    for (std::size_t i = 0; i < 4; ++i) {
        if (left_of(quad[i], quad[(i + 1) % 4], p) < avenue)
            return false;
    }
    return true;
}

/// The largest part of a rectangle inside the quarter, by cutting eighths off its sides; empty where less
/// than 20 m x 20 m is left.
Rect fit(const Quad& quad, const Frame& frame, const Rect& rect) {
    Rect best;
    for (int cuts = 0; cuts < 6 * 6 * 6 * 6; ++cuts) {
        const auto eighths = [cuts](int place) { return cuts / place % 6 / 8.0; };
        const Rect cut{rect.x0 + eighths(1) * rect.width(), rect.y0 + eighths(6) * rect.depth(),
                       rect.x1 - eighths(36) * rect.width(), rect.y1 - eighths(216) * rect.depth()};
        if (cut.width() < 20 || cut.depth() < 20 || cut.width() * cut.depth() <= best.width() * best.depth())
            continue;
        const WorldRing corners = frame.to_scene(rectangle(cut)).exterior;
        if (std::all_of(corners.begin(), corners.end(),
                        [&quad](const Position& p) { return inside(quad, p); }))
            best = cut;
    }
    return best;
}

struct SiteSize {
    double width_low, width_high, depth_low, depth_high;
};

SiteSize site_size(Quarter quarter) {
    switch (quarter) {
        case Quarter::old_town:
            return {58, 88, 50, 70};
        case Quarter::row_houses:
            return {80, 120, 46, 54};
        case Quarter::villas:
            return {80, 120, 54, 62};
        case Quarter::slabs:
            return {80, 110, 80, 100};
        default:
            return {130, 140, 72, 80};
    }
}

/// Consecutive intervals with streets between them, wide enough for any quarter.
std::vector<std::pair<double, double>> intervals(double reach, double low, double high, Random& random) {
    std::vector<std::pair<double, double>> found;
    for (double start = -reach; start < reach;) {
        const double end = start + random.eighths(low, high);
        found.emplace_back(start, end);
        start = end + street;
    }
    return found;
}

}  // namespace

Frame street_frame(const Quad& quad, Random& random) {
    Frame frame{middle(middle(quad[0], quad[1]), middle(quad[2], quad[3])),
                Direction::from_half_tangent(random.between(-0.35, 0.35))};
    const double length = distance(quad[0], quad[1]);
    if (random.chance(0.4))
        frame.x_axis = {(quad[1].x - quad[0].x) / length, (quad[1].y - quad[0].y) / length};
    return frame;
}

std::vector<Rect> lay_out(Quarter quarter, const Quad& quad, const Frame& frame, double pitch,
                          Random& random) {
    if (quarter == Quarter::park)
        return {fit(quad, frame, {-pitch / 2, -pitch / 2, pitch / 2, pitch / 2})};
    const SiteSize size = site_size(quarter);
    const auto columns = intervals(pitch, size.width_low, size.width_high, random);
    const auto lines = intervals(pitch, size.depth_low, size.depth_high, random);
    std::vector<Rect> found;
    for (const auto& [y0, y1] : lines) {
        for (const auto& [x0, x1] : columns) {
            const Rect rect = fit(quad, frame, {x0, y0, x1, y1});
            if (rect.width() > 0)
                found.push_back(rect);
        }
    }
    return found;
}

const Rect* central(const std::vector<Rect>& rects) {
    const auto nearest = std::min_element(rects.begin(), rects.end(), [](const Rect& a, const Rect& b) {
        return distance({0, 0}, a.centre()) < distance({0, 0}, b.centre());
    });
    return nearest == rects.end() ? nullptr : &*nearest;
}

}  // namespace d2b::sample
