#include "garden.hpp"

#include <algorithm>
#include <cmath>

#include "draft.hpp"

namespace d2b::sample {

namespace {

/// Draws a house of the country; common forms are drawn more often.
Draft home(const Rect& house, double eave, Random& random) {
    const RoofStyle gabled{Roof::gabled, eave, random.between(0.4, 1.0)};
    const int form = random.below(12);
    if (form < 7)
        return box_house("house", house, gabled);
    if (form < 9)
        return box_house("house", house, {Roof::hipped, eave, random.between(0.4, 0.8)});
    if (form == 9)
        return box_house("house", house, {Roof::flat, eave + 0.5, 0});
    return l_house("house", house, std::floor(house.depth() * 4) / 8, gabled);
}

/// A chimney on the roof of a building.
void add_chimney(const Site& lot, const Rect& house, const Building& building) {
    const Position foot{lot.random.between(house.x0 + 1, house.x1 - 2), house.centre().y + 0.3};
    const Frame frame = lot.frame.moved(foot);
    const auto roof = building.elevation_at(frame.to_scene(Position{0.4, 0.4}));
    if (roof)
        lot.scene.blocks.push_back({frame, {0, 0, 0.8, 0.8}, *roof + 1, *roof + 1});
}

}  // namespace

void build_home(const Site& lot) {
    Random& random = lot.random;
    const double depth = random.eighths(7, 10.5);
    const double width = std::min(random.eighths(8.5, 14.5), std::floor((lot.width - 7) * 8) / 8);
    const double x0 = 2.5 + random.eighths(0, std::max(0.0, lot.width - width - 6));
    const double y0 = pavement + random.eighths(0, std::max(0.5, std::min(9.0, lot.depth - depth - 10)));
    const Rect house{x0, y0, x0 + width, y0 + depth};
    std::vector<Draft> drafts{home(house, random.eighths(2.5, 5.75), random)};
    if (house.x1 + 4 < lot.width - 1 && random.chance(0.3))
        drafts.push_back(
            box_house("garage", {house.x1, y0 + 1, house.x1 + 3.5, y0 + 7}, {Roof::flat, 2.5, 0}));
    const std::size_t first = lot.scene.buildings.size();
    lot.build(drafts);
    if (random.chance(0.6))
        add_chimney(lot, house, lot.scene.buildings[first]);
}

void build_shed(const Site& lot) {
    Random& random = lot.random;
    const double width = random.eighths(2.5, 5);
    const double depth = random.eighths(2.5, 4);
    const double x0 = random.chance(0.5) ? 1.5 : std::floor((lot.width - width - 1.5) * 8) / 8;
    const double y0 = std::floor((lot.depth - depth - 1.5) * 8) / 8;
    lot.scene.add(box_house("shed", {x0, y0, x0 + width, y0 + depth}, {Roof::shed, 2.125, 0.15}), lot.frame);
}

void plant_hedge(const Site& site, const Position& from, const Position& to, double height) {
    const double length = distance(from, to);
    const double radius = site.random.between(0.6, 1.1);
    for (double along = 0; along < length; along += 0.7) {
        const double t = along / length;
        site.scene.plant(
            {site.frame.to_scene(Position{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}), 0,
             height * site.random.between(0.9, 1.1), radius, false, 0},
            site.scene.buildings.size());
    }
}

void plant_hedges(const Site& lot) {
    Random& random = lot.random;
    const auto side = [&](const Position& from, const Position& to) {
        if (random.chance(0.6))
            plant_hedge(lot, from, to, random.between(1.2, 3));
    };
    side({0.5, 3}, {0.5, lot.depth - 1});
    side({lot.width - 0.5, 3}, {lot.width - 0.5, lot.depth - 1});
    side({1, lot.depth - 0.5}, {lot.width - 1, lot.depth - 0.5});
}

void plant_at_walls(const Site& site, std::size_t first, double probability) {
    Random& random = site.random;
    // Planting adds no building.
    for (std::size_t i = first; i < site.scene.buildings.size(); ++i) {
        const Building& building = site.scene.buildings[i];
        while (random.chance(probability)) {
            const WorldRing& ring = building.footprint.exterior;
            const auto side = static_cast<std::size_t>(random.below(static_cast<int>(ring.size())));
            const Position& a = ring[side];
            const Position& b = ring[(side + 1) % ring.size()];
            const double t = random.uniform();
            const double off = random.between(0.8, 3) / distance(a, b);
            // Rings run counter-clockwise: outside is on the right.
            const Position trunk{a.x + t * (b.x - a.x) + off * (b.y - a.y),
                                 a.y + t * (b.y - a.y) - off * (b.x - a.x)};
            const double height = random.between(4.5, 12);
            const bool conifer = random.chance(0.2);
            site.scene.plant({trunk, 0, height, height * (conifer ? 0.25 : 0.36), conifer, 0}, 0);
        }
    }
}

void plant_wood(const Site& site, double spacing, double low, double high, double conifers) {
    for (double y = 0; y < site.depth; y += spacing)
        for (double x = 0; x < site.width; x += spacing)
            site.plant({x + site.random.between(0, spacing), y + site.random.between(0, spacing)},
                       site.random.between(low, high), site.random.chance(conifers), 0);
}

void plant_orchard(const Site& site, const Rect& rect, std::size_t first) {
    for (double y = rect.y0 + 3; y < rect.y1; y += 6)
        for (double x = rect.x0 + 3; x < rect.x1; x += 6)
            if (site.random.chance(0.9))
                site.plant({x, y}, site.random.between(3.5, 5.5), false, first);
}

}  // namespace d2b::sample
