#include "lots.hpp"

#include <algorithm>
#include <cmath>

#include "draft.hpp"

namespace d2b::sample {

namespace {

constexpr double half_street = 3;  // metres

double eighth(double metres) {
    return std::floor(metres * 8) / 8;
}

}  // namespace

Site site_around(Scene& scene, Random& random, const Position& centre, const Direction& x_axis, double width,
                 double depth) {
    const Frame middle{centre, x_axis};
    return {scene, random, middle.moved({-width / 2, -depth / 2}), width, depth};
}

std::vector<Site> lots_along(const Site& site, double narrowest, double widest) {
    const double deep = eighth(site.depth / 2 - half_street);
    const double street = site.depth / 2;
    std::vector<Site> lots;
    for (const bool above : {true, false})
        for (double x = 0; x + narrowest <= site.width;) {
            const double width = std::min(site.random.eighths(narrowest, widest), eighth(site.width - x));
            const Position corner =
                above ? Position{x, street + half_street} : Position{x + width, street - half_street};
            Frame frame = site.frame.moved(corner);
            if (!above)
                frame.x_axis = {-frame.x_axis.cosine, -frame.x_axis.sine};
            lots.push_back({site.scene, site.random, frame, width, deep});
            x += width;
        }
    return lots;
}

void build_parcelled_row(const Site& site) {
    Random& random = site.random;
    const double width = random.eighths(5.25, 8);
    const double depth = random.eighths(8.5, 11.5);
    const bool flat = random.chance(0.25);
    const double eave = random.eighths(3, 7);
    const double rise = flat ? 0 : random.between(0.5, 0.9) * depth / 2;
    const double deep = eighth(site.depth);
    std::vector<Draft> drafts;
    for (double x = 0; x + width <= site.width; x += width) {
        const Rect house{x, pavement, x + width, pavement + depth};
        drafts.push_back({"row house",
                          rectangle(house),
                          {{house, flat ? Roof::flat : Roof::gabled, eave, eave + rise, true}}});
        site.add_plot(rectangle({x, 0, x + width, deep}));
    }
    site.build(drafts);
    // All stand as high as the first: the row is one roof.
    const std::size_t first = site.scene.buildings.size() - drafts.size();
    for (std::size_t i = first; i < site.scene.buildings.size(); ++i)
        site.scene.buildings[i].ground = site.scene.buildings[first].ground;
}

}  // namespace d2b::sample
