#include <cmath>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

/// A brook from one side of a park to the other.
Creek brook(const Site& site, double x) {
    Creek creek;
    for (int k = 0; k <= 8; ++k)
        creek.line.push_back(
            site.frame.to_scene(Position{x + site.random.between(-7, 7), 16 + (site.depth - 32) * k / 8}));
    return creek;
}

/// A deck from bank to bank.
void build_bridge(const Site& site, double x, double y) {
    const double from = x - 32;
    const double to = x + 32;
    const double start = site.scene.ground.at(site.frame.to_scene(Position{from, y}));
    const double end = site.scene.ground.at(site.frame.to_scene(Position{to, y}));
    site.scene.blocks.push_back({site.frame, {from, y - 3.5, to, y + 3.5}, start + 0.4, end + 0.4});
}

/// Woods where a noise is high, single trees elsewhere; none in the brook or on the bridge.
void plant_woods(const Site& site, double brook_x, double bridge_y, std::size_t first_building) {
    constexpr double spacing = 5.5;
    for (double y = 4; y < site.depth - 4; y += spacing) {
        for (double x = 4; x < site.width - 4; x += spacing) {
            const Position p{x + site.random.between(0, spacing), y + site.random.between(0, spacing)};
            const bool wood = value_noise(site.scene.seed + 9, 75, site.frame.to_scene(p)) > 0.58;
            const bool clear = std::abs(p.x - brook_x) > 28 && std::abs(p.y - bridge_y) > 9;
            if (site.random.chance(wood ? 0.92 : 0.04) && clear)
                site.plant(p, site.random.between(8, 19), site.random.chance(0.3), first_building);
        }
    }
}

}  // namespace

void build_park(const Site& site) {
    const std::size_t first = site.scene.buildings.size();
    double brook_x = -100;
    const double bridge_y = site.depth * 0.45;
    if (site.width > 140 && site.depth > 90) {
        brook_x = site.width * 0.4;
        build_bridge(site, brook_x, bridge_y);
        site.scene.ground.creeks.push_back(brook(site, brook_x));
    }
    const Position corner{site.width - 16, 16};
    if (site.width > 60)
        site.scene.add(round_house("pavilion", corner, 7, {Roof::cone, 4, 0}, 3), site.frame);
    plant_woods(site, brook_x, bridge_y, first);
}

}  // namespace d2b::sample
