#include "draft.hpp"
#include "garden.hpp"
#include "lots.hpp"
#include "place.hpp"
#include "random.hpp"

namespace d2b::sample {

namespace {

Scene sloping(std::uint64_t seed, double slope_y, double relief) {
    Scene scene;
    scene.seed = seed;
    scene.ground.seed = hash(seed, 2, 1);
    scene.ground.base = 60;
    scene.ground.slope_y = slope_y;
    scene.ground.relief = relief;
    return scene;
}

/// Builds one walled level of a slope and the buildings on it.
void build_level(Scene& scene, Random& random, const Position& centre, const Direction& turn) {
    const Site level = site_around(scene, random, centre, turn, random.eighths(60, 110), 21);
    scene.ground.level(level.frame, level.rect());
    scene.ground.terraces.back().bank = 0.5;
    const std::size_t first = scene.buildings.size();
    if (random.chance(0.4)) {
        build_parcelled_row(level);
    } else {
        for (double x = 0; x + 18 <= level.width; x += 20) {
            const Site lot = level.part({x, 0, x + 18, level.depth});
            build_home(lot);
            lot.plant_garden({2, 15, 16, 20}, random.below(3), first);
        }
    }
    plant_at_walls(level, first, 0.2);
}

}  // namespace

Scene pines(std::uint64_t seed) {
    Scene scene = sloping(seed, 0.02, 10);
    Random random(hash(seed, 3, 3));
    const Direction turn = Direction::from_half_tangent(random.between(-0.25, 0.25));
    for (int row = 0; row < 6; ++row)
        for (int col = 0; col < 5; ++col) {
            const Site lot = site_around(scene, random, {(col + 0.5) * 60, (row + 0.5) * 50}, turn, 42, 36);
            if ((row + col) % 3 == 0) {
                const double length = random.eighths(24, 40);
                scene.add(box_house("slab", {1, 6, 1 + length, 18}, {Roof::flat, random.eighths(6, 13), 0}),
                          lot.frame);
            } else {
                build_home(lot);
                build_shed(lot);
            }
        }
    Random trees(hash(seed, 4, 4));
    plant_wood({scene, trees, {}, 300, 300}, 9.5, 7, 17, 0.15);
    return scene;
}

Scene hillside(std::uint64_t seed) {
    Scene scene = sloping(seed, 0.22, 16);
    for (int row = 0; row < 11; ++row)
        for (int col = 0; col < 3; ++col) {
            Random random(hash(seed, col, row));
            build_level(scene, random, {70 + col * 130.0 + random.between(-8, 8), 30 + row * 34.0},
                        Direction::from_half_tangent(random.between(-0.03, 0.03)));
        }
    Random random(hash(seed, 5, 5));
    plant_wood({scene, random, {}, 400, 400}, 13, 2, 11, 0.3);
    return scene;
}

Scene rows(std::uint64_t seed) {
    Scene scene = sloping(seed, 0.01, 4);
    Random random(hash(seed, 6, 6));
    const Direction turn = Direction::from_half_tangent(random.between(-0.2, 0.2));
    const Site quarter = site_around(scene, random, {150, 150}, turn, 210, 200);
    for (double y = 0; y + 25 <= quarter.depth; y += 50)
        for (double x = 0; x + 50 <= quarter.width; x += 72) {
            const Site below = quarter.part({x, y, x + 62, y + 21});
            Site above = quarter.part({x + 62, y + 42, x + 124, y + 63});
            above.frame.x_axis = {-above.frame.x_axis.cosine, -above.frame.x_axis.sine};
            for (const Site& row : {below, above}) {
                const std::size_t first = scene.buildings.size();
                build_parcelled_row(row);
                row.plant_garden({0, 17, row.width, 20.5}, 4, first);
                if (random.chance(0.5))
                    plant_hedge(row, {0, 20.5}, {row.width, 20.5}, random.between(1.4, 2.2));
            }
        }
    return scene;
}

}  // namespace d2b::sample
