#include <algorithm>

#include "draft.hpp"
#include "site.hpp"

namespace d2b::sample {

namespace {

RoofStyle town_roof(Random& random, double low, double high) {
    const Roof roof = random.chance(0.15) ? Roof::flat : Roof::gabled;
    return {roof, random.eighths(low, high), random.between(0.55, 0.9)};
}

/// A house that fills its plot.
void add_plots(const Site& site, const std::vector<Draft>& houses) {
    for (const Draft& house : houses)
        site.add_plot(house.outline);
}

/// Splits a side of a block into houses, each with its own height; the ridges run along the street.
/// @param strip from corner to corner @param along_x whether the street does
void build_side(const Rect& strip, bool along_x, Random& random, std::vector<Draft>& drafts) {
    const double end = along_x ? strip.x1 : strip.y1;
    double from = along_x ? strip.x0 : strip.y0;
    const double span = along_x ? strip.depth() : strip.width();
    while (from < end) {
        double to = from + random.eighths(span, span + 7);
        if (end - to < 9)
            to = end;
        const Rect rect = along_x ? Rect{from, strip.y0, to, strip.y1} : Rect{strip.x0, from, strip.x1, to};
        const RoofStyle style = town_roof(random, 10, 18);
        RoofPart part = wing(rect, style);
        part.ridge_along_x = along_x;
        if (style.roof != Roof::flat)
            part.top = style.eave + style.pitch * span / 2;
        drafts.push_back({"perimeter house", rectangle(rect), {part}});
        from = to;
    }
}

/// Houses on all sides of a courtyard, walls shared.
void build_ring(const Site& site, double span) {
    std::vector<Draft> drafts;
    const Rect b = site.rect();
    build_side({b.x0, b.y0, b.x1, b.y0 + span}, true, site.random, drafts);
    build_side({b.x0, b.y1 - span, b.x1, b.y1}, true, site.random, drafts);
    build_side({b.x0, b.y0 + span, b.x0 + span, b.y1 - span}, false, site.random, drafts);
    // Some blocks are open: one house was never built.
    const std::size_t before = drafts.size();
    build_side({b.x1 - span, b.y0 + span, b.x1, b.y1 - span}, false, site.random, drafts);
    add_plots(site, drafts);
    if (drafts.size() > before + 1 && site.random.chance(0.3))
        drafts.pop_back();
    const Rect court = b.grown(-span);
    if (court.width() > 26 && court.depth() > 14 && site.random.chance(0.5)) {
        const double x = court.x0 + site.random.eighths(6, court.width() - 16);
        drafts.push_back(box_house("rear house", {x, court.y0, x + 9, court.y0 + 8}, {Roof::shed, 5, 0.25}));
    }
    const std::size_t first = site.scene.buildings.size();
    site.build(drafts);
    for (int k = site.random.below(6); k > 0; --k) {
        const Position p{site.random.between(court.x0 + 2, court.x1 - 2),
                         site.random.between(court.y0 + 2, court.y1 - 2)};
        site.plant(p, site.random.between(5, 14), false, first);
    }
}

/// A town hall or a school.
void build_hall_on_square(const Site& site) {
    site.scene.ground.level(site.frame, site.rect());
    const Rect box{10, 8, site.width - 10, site.depth - 8};
    const std::size_t first = site.scene.buildings.size();
    site.scene.add(u_house("town hall", box, 13, {Roof::hipped, 15, 0.8}), site.frame);
    for (double x = 28; x < site.width - 27; x += 8)
        site.plant({x, site.depth - 6}, site.random.between(6, 9), false, first);
}

}  // namespace

void build_perimeter(const Site& site) {
    if (site.width > 60 && site.depth > 44 && site.random.chance(0.12))
        return build_hall_on_square(site);
    const double span = site.random.eighths(10.5, 13);
    if (site.width >= 2 * span + 9 && site.depth >= 2 * span + 9)
        return build_ring(site, span);
    // Too small for a courtyard: one row.
    std::vector<Draft> drafts;
    build_side({0, 0, site.width, span}, true, site.random, drafts);
    add_plots(site, drafts);
    site.build(drafts);
}

void build_church(const Site& site) {
    site.scene.ground.level(site.frame, site.rect());
    const Position c = site.rect().centre();
    // Nave, transept, choir and, on the west side, the tower with its spire.
    Draft church = box_house("church", {c.x - 18, c.y - 7, c.x + 14, c.y + 7}, {Roof::gabled, 14, 1.2});
    church.parts.push_back({{c.x, c.y - 12, c.x + 9, c.y + 12}, Roof::gabled, 14, 22, false});
    church.parts.push_back({{c.x + 14, c.y - 4, c.x + 21, c.y + 4}, Roof::hipped, 11, 17, true});
    church.parts.push_back({{c.x - 27, c.y - 4.5, c.x - 18, c.y + 4.5}, Roof::hipped, 32, 54, true});
    church.outline.exterior = {
        {c.x - 27, c.y - 4.5}, {c.x - 18, c.y - 4.5}, {c.x - 18, c.y - 7},   {c.x, c.y - 7},
        {c.x, c.y - 12},       {c.x + 9, c.y - 12},   {c.x + 9, c.y - 7},    {c.x + 14, c.y - 7},
        {c.x + 14, c.y - 4},   {c.x + 21, c.y - 4},   {c.x + 21, c.y + 4},   {c.x + 14, c.y + 4},
        {c.x + 14, c.y + 7},   {c.x + 9, c.y + 7},    {c.x + 9, c.y + 12},   {c.x, c.y + 12},
        {c.x, c.y + 7},        {c.x - 18, c.y + 7},   {c.x - 18, c.y + 4.5}, {c.x - 27, c.y + 4.5}};
    const std::size_t first = site.scene.buildings.size();
    site.scene.add(church, site.frame);
    // Limes around the square.
    for (double x = 5; x < site.width - 4; x += 8) {
        site.plant({x, 5}, site.random.between(9, 12), false, first);
        site.plant({x, site.depth - 5}, site.random.between(9, 12), false, first);
    }
}

}  // namespace d2b::sample
