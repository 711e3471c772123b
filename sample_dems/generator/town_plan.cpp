#include "town_plan.hpp"

#include <algorithm>
#include <cmath>

#include "draft.hpp"
#include "random.hpp"
#include "site.hpp"
#include "street_grid.hpp"

namespace d2b::sample {

namespace {

void build_site(Quarter quarter, const Site& site) {
    switch (quarter) {
        case Quarter::old_town:
            return build_perimeter(site);
        case Quarter::row_houses:
            return build_rows(site);
        case Quarter::villas:
            return build_villas(site);
        case Quarter::slabs:
            return build_slabs(site);
        case Quarter::works:
            return build_works(site);
        case Quarter::park:
            return build_park(site);
    }
}

/// Trees on both sides of the avenues, as far as they belong to this quarter.
void plant_avenues(const Quad& quad, Scene& scene, Random& random) {
    for (std::size_t i = 0; i < 4; ++i) {
        const Position& a = quad[i];
        const Position& b = quad[(i + 1) % 4];
        const double length = distance(a, b);
        const Frame along{a, {(b.x - a.x) / length, (b.y - a.y) / length}};
        const double height = random.between(7, 13);
        for (double x = 16; x < length - 16; x += 11) {
            if (random.chance(0.75))
                scene.plant({along.to_scene(Position{x, 6.5}), 0, height * random.between(0.85, 1.15),
                             height / 4, false, 0},
                            scene.buildings.size());
        }
    }
}

}  // namespace

Quarter TownPlan::quarter(std::int32_t col, std::int32_t row) const {
    if (!quarters.empty())
        return quarters[static_cast<std::size_t>(row * cols + col)];
    return static_cast<Quarter>(hash(seed + 1, col, row) % 6);
}

Quad TownPlan::corners(std::int32_t col, std::int32_t row) const {
    const auto crossing = [this](std::int32_t i, std::int32_t j) -> Position {
        const double dx = i == 0 || i == cols ? 0 : jitter * (2 * uniform_at(seed + 2, i, j) - 1);
        const double dy = j == 0 || j == rows ? 0 : jitter * (2 * uniform_at(seed + 3, i, j) - 1);
        return {i * pitch + dx, j * pitch + dy};
    };
    return {crossing(col, row), crossing(col + 1, row), crossing(col + 1, row + 1), crossing(col, row + 1)};
}

void build_quarter(const TownPlan& plan, std::int32_t col, std::int32_t row, Scene& scene) {
    const Quad quad = plan.corners(col, row);
    const Quarter quarter = plan.quarter(col, row);
    Random random(hash(plan.seed, col, row));
    const Frame frame = street_frame(quad, random);
    const std::vector<Rect> rects = lay_out(quarter, quad, frame, plan.pitch, random);
    for (const Rect& rect : rects) {
        // Multiples of an eighth of a metre, as all that is built on it.
        const Site site{scene, random, frame.moved({rect.x0, rect.y0}), std::floor(rect.width() * 8) / 8,
                        std::floor(rect.depth() * 8) / 8};
        if (quarter == Quarter::old_town && &rect == central(rects))
            build_church(site);
        else
            build_site(quarter, site);
        furnish_street(site);
    }
    plant_avenues(quad, scene, random);
}

void build_strip(const TownPlan& plan, double y0, double y1, Scene& scene) {
    const auto row_at = [&plan](double y) {
        return static_cast<std::int32_t>(std::clamp(std::floor(y / plan.pitch), 0.0, plan.rows - 1.0));
    };
    // Crossings move by less than `jitter`, so quarters and the trees at their rims stay that near to their
    // rows.
    for (std::int32_t row = row_at(y0 - plan.jitter); row <= row_at(y1 + plan.jitter); ++row) {
        for (std::int32_t col = 0; col < plan.cols; ++col)
            build_quarter(plan, col, row, scene);
    }
}

}  // namespace d2b::sample
