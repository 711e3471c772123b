#include <algorithm>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

/// Lift housings and the like.
void add_plant_room(Draft& draft, const Rect& on, Random& random) {
    const double width = std::min(5.0, on.width() - 2);
    const double depth = std::min(4.0, on.depth() - 2);
    const double x = on.x0 + 1 + random.eighths(0, on.width() - width - 2);
    const double y = on.y0 + 1 + random.eighths(0, on.depth() - depth - 2);
    draft.parts.push_back(wing({x, y, x + width, y + depth}, {Roof::flat, draft.parts[0].top + 2.75, 0}));
}

Draft slab_draft(const Rect& box, Random& random) {
    const RoofStyle flat{Roof::flat, 3 * (3 + random.below(6)) + 1.0, 0};
    switch (random.below(6)) {
        case 0:
            return h_house("H-shaped slab", box, 12, flat);
        case 1:
            return l_house("L-shaped slab", box, 12, flat);
        case 2:
            return u_house("U-shaped slab", box, 12, flat);
        case 3: {
            const Position c = box.centre();
            return box_house("tower block", {c.x - 11, c.y - 11, c.x + 11, c.y + 11},
                             {Roof::flat, 3 * (12 + random.below(8)) + 1.0, 0});
        }
        case 4: {
            const double radius = std::min(box.width(), box.depth()) / 3;
            return round_house("round tower", box.centre(), radius, {Roof::flat, 31, 0}, 0);
        }
        default:
            return box_house("slab", {box.x0, box.y0, box.x1, box.y0 + 13}, flat);
    }
}

}  // namespace

void build_slabs(const Site& site) {
    const std::size_t first = site.scene.buildings.size();
    const Rect box = site.rect().grown(-9);
    if (box.width() >= 34 && box.depth() >= 34) {
        site.scene.ground.level(site.frame, box.grown(2));
        Draft draft = slab_draft(box, site.random);
        // Puts it on the first wing of a box; a drum has no flat rectangle to spare at its rim.
        if (draft.kind != "round tower")
            add_plant_room(draft, draft.parts[0].rect, site.random);
        site.scene.add(draft, site.frame);
    } else if (box.width() >= 12 && box.depth() >= 10) {
        site.scene.add(box_house("kiosk", {box.x0, box.y0, box.x0 + 12, box.y0 + 10}, {Roof::flat, 4, 0}),
                       site.frame);
    }
    for (int k = static_cast<int>(site.width * site.depth / 260); k > 0; --k) {
        const Position p{site.random.between(3, site.width - 3), site.random.between(3, site.depth - 3)};
        site.plant(p, site.random.between(5, 15), site.random.chance(0.2), first);
    }
}

}  // namespace d2b::sample
