#include <algorithm>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

void build_silos(const Site& site) {
    const double radius = 5;
    for (double x = 8; x + 8 < std::min(site.width, 50.0); x += 13)
        site.scene.add(round_house("silo", {x, 8}, radius, {Roof::cone, 21, 0}, 3), site.frame);
    if (site.depth > 42 && site.width > 30)
        site.scene.add(round_house("tank", {16, site.depth - 16}, 12, {Roof::dome, 8, 0}, 4), site.frame);
    if (site.depth > 50 && site.width > 75)
        site.scene.add(box_house("works", {46, 26, site.width - 6, site.depth - 8}, {Roof::gabled, 7, 0.2}),
                       site.frame);
}

/// A hall whose roof is a row of sheds.
Draft saw_tooth_hall(const Rect& rect) {
    Draft hall{"hall", rectangle(rect), {}};
    const double tooth = rect.width() / 8;
    for (int k = 0; k < 8; ++k) {
        const double x = rect.x0 + k * tooth;
        hall.parts.push_back({{x, rect.y0, x + tooth, rect.y1}, Roof::shed, 7, 10, false});
    }
    return hall;
}

}  // namespace

void build_works(const Site& site) {
    const std::size_t first = site.scene.buildings.size();
    site.scene.ground.level(site.frame, site.rect());
    const Position c = site.rect().centre();
    const bool large = site.width >= 128 && site.depth >= 68;
    const int form = site.random.below(3);
    if (large && form != 2)
        site.scene.add(box_house("hall", {c.x - 60, c.y - 30, c.x + 60, c.y + 30}, {Roof::flat, 12, 0}),
                       site.frame);
    else if (site.width > 60 && site.depth > 36 && form != 0)
        site.scene.add(saw_tooth_hall({c.x - 24, c.y - 14, c.x + 24, c.y + 14}), site.frame);
    else
        build_silos(site);
    for (double x = 4; x < site.width - 4; x += 8)
        site.plant({x, 2}, site.random.between(4, 7), false, first);
}

}  // namespace d2b::sample
