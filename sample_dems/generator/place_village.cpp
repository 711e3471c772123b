#include "draft.hpp"
#include "garden.hpp"
#include "lots.hpp"
#include "place.hpp"
#include "random.hpp"

namespace d2b::sample {

namespace {

constexpr double block_width = 200;  // metres
constexpr double block_depth = 100;

/// A house, barns around a yard, a silo, trees.
void build_farm(const Site& site) {
    Random& random = site.random;
    const std::size_t first = site.scene.buildings.size();
    const double long_side = random.eighths(24, 42);
    const double wide = random.eighths(11, 18);
    site.scene.add(
        box_house("barn", {4, 6, 4 + wide, 6 + long_side}, {Roof::gabled, random.eighths(3.5, 6), 0.35}),
        site.frame);
    site.scene.add(box_house("barn", {4 + wide + 6, 36, 4 + wide + 6 + random.eighths(18, 28), 48},
                             {Roof::gabled, random.eighths(3, 5), random.between(0.3, 0.8)}),
                   site.frame);
    site.scene.add(box_house("house", {4 + wide + 10, 6, 4 + wide + 10 + random.eighths(11, 16), 16},
                             {random.chance(0.7) ? Roof::gabled : Roof::hipped, random.eighths(3, 5.5), 0.8}),
                   site.frame);
    if (random.chance(0.5))
        site.scene.add(round_house("silo", {1, 0}, 2.75, {Roof::dome, 9, 0}, 2), site.frame);
    plant_at_walls(site, first, 0.4);
    plant_orchard(site, {36, 10, 58, 30}, first);
}

void build_lot(const Site& lot, double leaning) {
    Random& random = lot.random;
    const std::size_t first = lot.scene.buildings.size();
    if (random.chance(0.9))
        build_home(lot);
    if (random.chance(0.5) && lot.width > 12)
        build_shed(lot);
    plant_hedges(lot);
    plant_at_walls(lot, first, leaning);
    lot.plant_garden({2, lot.depth * 0.45, lot.width - 2, lot.depth - 2}, random.below(5), first);
}

void build_street(Scene& scene, Random& random, const Position& centre) {
    const Direction turn = Direction::from_half_tangent(random.between(-0.06, 0.06));
    const Site block = site_around(scene, random, centre, turn, 176, random.between(66, 78));
    for (const Site& lot : lots_along(block, 17, 28))
        build_lot(lot, 0.3);
}

/// Around a church: rows of old houses of several heights.
void build_centre(Scene& scene, Random& random, const Position& centre) {
    const Direction turn = Direction::from_half_tangent(random.between(-0.15, 0.15));
    build_church(site_around(scene, random, {centre.x - 52, centre.y}, turn, 60, 60));
    build_rows(site_around(scene, random, {centre.x + 42, centre.y}, turn, 84, 50));
}

Scene country(std::uint64_t seed, double base, double relief) {
    Scene scene;
    scene.seed = seed;
    scene.ground.seed = hash(seed, 1, 1);
    scene.ground.base = base;
    scene.ground.relief = relief;
    return scene;
}

/// Trees of a hedgerow between fields.
void plant_hedgerow(const Site& site, const Position& from, const Position& to) {
    plant_hedge(site, from, to, site.random.between(1.5, 3.5));
    const double length = distance(from, to);
    for (double along = 4; along < length; along += site.random.between(6, 30)) {
        const double t = along / length;
        site.plant({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}, site.random.between(5, 14),
                   false, site.scene.buildings.size());
    }
}

}  // namespace

Scene village(std::uint64_t seed) {
    Scene scene = country(seed, 40, 14);
    for (int row = 0; row < 6; ++row)
        for (int col = 0; col < 3; ++col) {
            Random random(hash(seed, col, row));
            const Position centre{(col + 0.5) * block_width, (row + 0.5) * block_depth};
            if (row == 3 && col == 1)
                build_centre(scene, random, centre);
            else if ((row == 0 && col == 0) || (row == 5 && col == 2))
                for (const double side : {-45.0, 45.0})
                    build_farm(site_around(scene, random, {centre.x + side, centre.y},
                                           Direction::from_half_tangent(random.between(-0.2, 0.2)), 60, 60));
            else
                build_street(scene, random, centre);
        }
    Random random(hash(seed, 9, 9));
    plant_wood({scene, random, {}, 600, 600}, 15, 2, 9, 0.25);
    return scene;
}

Scene hamlet(std::uint64_t seed) {
    Scene scene = country(seed, 120, 30);
    scene.ground.furrow = 0.12;
    for (int row = 0; row < 3; ++row)
        for (int col = 0; col < 3; ++col) {
            Random random(hash(seed, col, row));
            const Position centre{(col + 0.5) * 500 / 3, (row + 0.5) * 500 / 3};
            const Direction turn = Direction::from_half_tangent(random.between(-0.3, 0.3));
            if (row == 1 || random.chance(0.35))
                build_farm(site_around(scene, random, centre, turn, 60, 60));
            else if (random.chance(0.6))
                for (const Site& lot : lots_along(site_around(scene, random, centre, turn, 90, 70), 24, 34))
                    build_lot(lot, 0.45);
            const Site land = site_around(scene, random, centre, {}, 160, 160);
            plant_hedgerow(land, {0, 0}, {160, 0});
            if (random.chance(0.7))
                plant_hedgerow(land, {0, 3}, {0, 157});
        }
    return scene;
}

}  // namespace d2b::sample
