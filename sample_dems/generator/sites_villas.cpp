#include <algorithm>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

/// A house of its own on a lot; `front` is the y of the street side, `towards` the direction of the garden.
void build_villa(const Site& site, const Rect& lot, bool street_below) {
    Random& random = site.random;
    const double width = random.eighths(9, std::min(13.0, lot.width() - 5));
    const double depth = random.eighths(8, 10.5);
    const double x0 = lot.x0 + 2 + random.eighths(0, lot.width() - width - 4);
    const double setback = pavement + random.eighths(0, 3);
    const double y0 = street_below ? lot.y0 + setback : lot.y1 - setback - depth;
    const Rect house{x0, y0, x0 + width, y0 + depth};
    const double eave = random.eighths(3.25, 6.5);
    const int form = random.below(10);
    const RoofStyle gabled{Roof::gabled, eave, random.between(0.6, 1.0)};
    std::vector<Draft> drafts;
    if (form < 5)
        drafts.push_back(box_house("house", house, gabled));
    else if (form < 7)
        drafts.push_back(box_house("house", house, {Roof::hipped, eave, random.between(0.5, 0.8)}));
    else if (form == 7)
        drafts.push_back(box_house("house", house, {Roof::flat, eave + 1.5, 0}));
    else if (form == 8)
        drafts.push_back(box_house("house", house, {Roof::shed, eave, 0.25}));
    else
        drafts.push_back(l_house("house", {x0, y0, x0 + width, y0 + depth + 2}, 6, gabled));
    if (house.x1 + 3.5 < lot.x1 && random.chance(0.5))
        drafts.push_back(
            box_house("garage", {house.x1, y0 + 1, house.x1 + 3.25, y0 + 7}, {Roof::flat, 2.75, 0}));
    const std::size_t first = site.scene.buildings.size();
    site.build(drafts);
    site.plant_garden(lot, 2 + random.below(4), first);
}

}  // namespace

void build_villas(const Site& site) {
    const bool two_rows = site.depth > 44;
    const double back = two_rows ? site.depth / 2 : site.depth;
    for (double x = 0; x + 15 <= site.width;) {
        const double width = std::min(site.random.eighths(16, 23), site.width - x);
        const Rect lower{x, 0, x + width, back};
        if (lower.depth() > 18 && width >= 15 && site.random.chance(0.93))
            build_villa(site, lower, true);
        if (two_rows && width >= 15 && site.random.chance(0.93))
            build_villa(site, {x, back, x + width, site.depth}, false);
        // A hedge between the lots.
        if (x > 0 && site.random.chance(0.5))
            site.scene.add_block(site.part({x, 0, x + width, site.depth}).frame, {-0.5, 8, 0.5, back - 2},
                                 1.5);
        x += width;
    }
    if (two_rows)
        site.scene.add_block(site.frame, {2, back - 0.5, site.width - 2, back + 0.5}, 1.75);
}

}  // namespace d2b::sample
