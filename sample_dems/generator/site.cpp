#include "site.hpp"

#include <string>

#include "draft.hpp"

namespace d2b::sample {

void Site::build(std::span<Draft> drafts) const {
    join_shared_walls(drafts);
    for (const Draft& draft : drafts)
        scene.add(draft, frame);
}

void Site::add_plot(const WorldPolygon& local) const {
    scene.parcels.push_back({"P" + std::to_string(scene.parcels.size() + 1), frame.to_scene(local)});
}

void Site::plant(const Position& local, double height, bool conifer, std::size_t first_building) const {
    const double radius = height * (conifer ? 0.24 : 0.36);
    scene.plant({frame.to_scene(local), 0, height, radius, conifer, 0}, first_building);
}

void Site::plant_garden(const Rect& garden, int count, std::size_t first_building) const {
    for (int k = 0; k < count; ++k) {
        const Position p{random.between(garden.x0, garden.x1), random.between(garden.y0, garden.y1)};
        plant(p, random.between(2.5, 10), random.chance(0.25), first_building);
    }
}

void furnish_street(const Site& site) {
    Random& random = site.random;
    const Frame left{site.frame.to_scene(Position{0, 0}),
                     {-site.frame.x_axis.sine, site.frame.x_axis.cosine}};
    const auto along = [&](const Frame& frame, double length, double side) {
        for (double x = 2; x + 5 < length; x += random.between(5.5, 9)) {
            if (random.chance(0.4))
                site.scene.add_block(frame, {x, side - 0.9, x + 4.4, side + 0.9}, random.between(1.4, 1.8));
        }
    };
    along(site.frame, site.width, -2.5);
    along(left, site.depth, 2.5);
    if (random.chance(0.35)) {
        for (double x = 4; x < site.width - 4; x += 9)
            site.plant({x, -1}, random.between(5, 8), false, site.scene.buildings.size());
    }
}

}  // namespace d2b::sample
