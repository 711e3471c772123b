#include <algorithm>

#include "draft.hpp"
#include "garden.hpp"
#include "lots.hpp"
#include "place.hpp"
#include "random.hpp"

namespace d2b::sample {

namespace {

Scene land(std::uint64_t seed, double base, double relief) {
    Scene scene;
    scene.seed = seed;
    scene.ground.seed = hash(seed, 7, 1);
    scene.ground.base = base;
    scene.ground.relief = relief;
    return scene;
}

/// A mall with a raised middle and machines on its roof, cars around it.
void build_mall(const Site& site) {
    site.scene.ground.level(site.frame, site.rect());
    Draft mall = box_house("mall", {0, 0, 260, 125}, {Roof::flat, 9, 0});
    mall.parts.push_back({{100, 0, 150, 125}, Roof::flat, 12, 12, true});
    for (int k = 0; k < 12; ++k) {
        const double x = site.random.between(5, 240);
        const double y = site.random.between(5, 110);
        mall.parts.push_back({{x, y, x + 6, y + 4}, Roof::flat, 14, 14, true});
    }
    site.scene.add(mall, site.frame);
    for (double y = -12; y > -60; y -= 12)
        for (double x = 0; x < 260; x += 2.7)
            if (site.random.chance(0.6))
                site.scene.add_block(site.frame, {x, y - 4.4, x + 1.8, y}, site.random.between(1.4, 1.9));
}

bool is_free(const Scene& scene, const Rect& rect) {
    const Rect around = rect.grown(1);
    const auto meets = [&](const Building& building) {
        const Rect box = bounds(building.footprint.exterior);
        return box.x0 < around.x1 && around.x0 < box.x1 && box.y0 < around.y1 && around.y0 < box.y1;
    };
    return std::none_of(scene.trees.begin(), scene.trees.end(),
                        [&](const Tree& tree) { return around.contains(tree.trunk); }) &&
           std::none_of(scene.buildings.begin(), scene.buildings.end(), meets);
}

/// Kiosks, a cafe, greenhouses between the trees, away from the brook.
void build_kiosks(Scene& scene, Random& random) {
    for (int k = 0; k < 200 && scene.buildings.size() < 16; ++k) {
        const double x = random.eighths(230, 460);
        const double y = random.eighths(30, 460);
        const double width = random.eighths(5.5, 14);
        const Rect rect{x, y, x + width, y + random.eighths(5.5, 9)};
        const Roof roof = random.chance(0.4) ? Roof::hipped : random.chance(0.5) ? Roof::gabled : Roof::flat;
        if (is_free(scene, rect))
            scene.add(box_house("kiosk", rect, {roof, random.eighths(2.75, 4), 0.5}), {});
    }
}

}  // namespace

Scene outskirts(std::uint64_t seed) {
    Scene scene = land(seed, 20, 22);
    Random random(hash(seed, 8, 8));
    const Direction turn = Direction::from_half_tangent(random.between(-0.1, 0.1));
    build_mall(site_around(scene, random, {300, 430}, turn, 260, 125));
    for (int k = 0; k < 3; ++k)
        build_works(site_around(scene, random, {110 + k * 190.0, 230}, turn, 138, 78));
    build_slabs(site_around(scene, random, {120, 90}, turn, 110, 100));
    build_villas(site_around(scene, random, {300, 90}, turn, 118, 60));
    build_slabs(site_around(scene, random, {480, 90}, turn, 110, 100));
    return scene;
}

Scene park(std::uint64_t seed) {
    Scene scene = land(seed, 30, 12);
    Random random(hash(seed, 9, 9));
    build_park({scene, random, {{20, 20}, {}}, 460, 460});
    build_kiosks(scene, random);
    return scene;
}

Scene forest(std::uint64_t seed) {
    Scene scene = land(seed, 100, 55);
    Random random(hash(seed, 10, 10));
    constexpr double side = 1000;
    for (int k = 0; k < static_cast<int>(side * side / 45); ++k) {
        const Position trunk{side * random.uniform(), side * random.uniform()};
        const double height = random.between(8, 28);
        const bool conifer = random.chance(0.3);
        scene.plant({trunk, 0, height, random.between(3, 7), conifer, 0}, 0);
    }
    return scene;
}

Scene fields(std::uint64_t seed) {
    Scene scene = land(seed, 3, 3);
    scene.ground.furrow = 0.12;
    Random random(hash(seed, 11, 11));
    for (double x = 90; x < 1000; x += 180)
        scene.ground.creeks.push_back({{{x, 0}, {x, 1000}}, 1.2, 3});
    scene.ground.creeks.push_back({{{0, 700}, {1000, 700}}, -3.5, 14});  // a dike
    for (int k = 0; k < 400; ++k) {
        const Position trunk{1000 * random.uniform(), 1000 * random.uniform()};
        const double height = random.between(1, 14);
        scene.plant({trunk, 0, height, random.between(1, 5), random.chance(0.2), 0}, 0);
    }
    return scene;
}

}  // namespace d2b::sample
