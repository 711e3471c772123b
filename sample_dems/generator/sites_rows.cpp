#include <algorithm>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

/// Metres that plots reach from the line of the fronts to their gardens.
constexpr double plot_depth = 16;

/// Houses that share walls, from x0 to x1, their fronts near y.
void build_terrace(const Site& site, double x0, double x1, double y, bool street_below) {
    Random& random = site.random;
    const double width = random.eighths(5.5, 7.5);
    const double depth = random.eighths(9.5, 11.5);
    const double pitch = random.between(0.6, 0.95);
    const Roof roof = random.chance(0.2) ? Roof::flat : Roof::gabled;
    const bool steps = random.chance(0.4);
    std::vector<Draft> drafts;
    for (double x = x0; x + width <= x1; x += width) {
        const double back_set = steps ? random.below(3) * 0.75 : 0;
        const double front = street_below ? y + back_set : y - back_set - depth;
        const RoofStyle style{roof, (random.chance(0.3) ? 8.5 : 5.75) + random.below(3) * 0.25, pitch};
        Draft draft = box_house("row house", {x, front, x + width, front + depth}, style);
        draft.parts[0] = wing(draft.parts[0].rect, style);
        draft.parts[0].ridge_along_x = true;
        if (roof == Roof::gabled)
            draft.parts[0].top = style.eave + pitch * depth / 2;
        drafts.push_back(std::move(draft));
        const double back = street_below ? y + plot_depth : y - plot_depth;
        const double street = street_below ? y - pavement : y + pavement;
        site.add_plot(rectangle({x, std::min(street, back), x + width, std::max(street, back)}));
    }
    site.build(drafts);
}

}  // namespace

void build_rows(const Site& site) {
    const std::size_t first = site.scene.buildings.size();
    const bool two_rows = site.depth > 40;
    for (double x = 3; x + 16 < site.width;) {
        const double length = std::min(site.random.eighths(34, 58), site.width - 3 - x);
        build_terrace(site, x, x + length, pavement, true);
        if (two_rows)
            build_terrace(site, x, x + length, site.depth - pavement, false);
        x += length + 5;
    }
    site.plant_garden({4, 18, site.width - 4, two_rows ? site.depth - 18 : site.depth},
                      static_cast<int>(site.width / 8), first);
    if (two_rows)
        site.scene.add_block(site.frame, {4, site.depth / 2 - 0.5, site.width - 4, site.depth / 2 + 0.5},
                             1.75);
}

}  // namespace d2b::sample
