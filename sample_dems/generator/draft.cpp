#include "draft.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b::sample {

WorldPolygon rectangle(const Rect& r) {
    return {{{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}, {}};
}

WorldPolygon circle(const Position& centre, double radius) {
    WorldRing unit{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    while (unit.size() < 64) {
        WorldRing finer;
        for (std::size_t i = 0; i < unit.size(); ++i) {
            const Position half = middle(unit[i], unit[(i + 1) % unit.size()]);
            const double length = distance({0, 0}, half);
            finer.push_back(unit[i]);
            finer.push_back({half.x / length, half.y / length});
        }
        unit = std::move(finer);
    }
    for (Position& p : unit)
        p = {centre.x + radius * p.x, centre.y + radius * p.y};
    return {std::move(unit), {}};
}

RoofPart wing(const Rect& rect, const RoofStyle& style) {
    const double span = std::min(rect.width(), rect.depth());
    double rise = 0;
    if (style.roof == Roof::shed)
        rise = style.pitch * span;
    else if (style.roof != Roof::flat)
        rise = style.pitch * span / 2;
    return {rect, style.roof, style.eave, style.eave + rise, rect.width() >= rect.depth()};
}

Draft box_house(std::string kind, const Rect& rect, const RoofStyle& style) {
    return {std::move(kind), rectangle(rect), {wing(rect, style)}};
}

Draft l_house(std::string kind, const Rect& b, double w, const RoofStyle& style) {
    const WorldRing corners{{b.x0, b.y0},         {b.x1, b.y0},     {b.x1, b.y0 + w},
                            {b.x0 + w, b.y0 + w}, {b.x0 + w, b.y1}, {b.x0, b.y1}};
    return {std::move(kind),
            {corners, {}},
            {wing({b.x0, b.y0, b.x1, b.y0 + w}, style), wing({b.x0, b.y0, b.x0 + w, b.y1}, style)}};
}

Draft u_house(std::string kind, const Rect& b, double w, const RoofStyle& style) {
    const WorldRing corners{{b.x0, b.y0},         {b.x1, b.y0},         {b.x1, b.y1},     {b.x1 - w, b.y1},
                            {b.x1 - w, b.y0 + w}, {b.x0 + w, b.y0 + w}, {b.x0 + w, b.y1}, {b.x0, b.y1}};
    return {std::move(kind),
            {corners, {}},
            {wing({b.x0, b.y0, b.x1, b.y0 + w}, style), wing({b.x0, b.y0, b.x0 + w, b.y1}, style),
             wing({b.x1 - w, b.y0, b.x1, b.y1}, style)}};
}

Draft h_house(std::string kind, const Rect& b, double w, const RoofStyle& style) {
    const double low = b.centre().y - w / 2;
    const double high = b.centre().y + w / 2;
    const WorldRing corners{{b.x0, b.y0},     {b.x0 + w, b.y0}, {b.x0 + w, low},  {b.x1 - w, low},
                            {b.x1 - w, b.y0}, {b.x1, b.y0},     {b.x1, b.y1},     {b.x1 - w, b.y1},
                            {b.x1 - w, high}, {b.x0 + w, high}, {b.x0 + w, b.y1}, {b.x0, b.y1}};
    // The bar's roof runs on to the ridges of the wings.
    return {std::move(kind),
            {corners, {}},
            {wing({b.x0, b.y0, b.x0 + w, b.y1}, style), wing({b.x1 - w, b.y0, b.x1, b.y1}, style),
             wing({b.x0 + w / 2, low, b.x1 - w / 2, high}, style)}};
}

Draft court_house(std::string kind, const Rect& b, double w, const RoofStyle& style) {
    WorldPolygon outline = rectangle(b);
    WorldRing court = rectangle(b.grown(-w)).exterior;
    std::reverse(court.begin(), court.end());
    outline.interiors.push_back(std::move(court));
    return {std::move(kind),
            std::move(outline),
            {wing({b.x0, b.y0, b.x1, b.y0 + w}, style), wing({b.x0, b.y1 - w, b.x1, b.y1}, style),
             wing({b.x0, b.y0, b.x0 + w, b.y1}, style), wing({b.x1 - w, b.y0, b.x1, b.y1}, style)}};
}

Draft round_house(std::string kind, const Position& centre, double radius, const RoofStyle& style,
                  double rise) {
    const Rect box{centre.x - radius, centre.y - radius, centre.x + radius, centre.y + radius};
    return {
        std::move(kind), circle(centre, radius), {{box, style.roof, style.eave, style.eave + rise, true}}};
}

namespace {

bool strictly_between(const Position& p, const Position& a, const Position& b) {
    const bool upright = a.x == b.x && p.x == a.x && p.y > std::min(a.y, b.y) && p.y < std::max(a.y, b.y);
    const bool level = a.y == b.y && p.y == a.y && p.x > std::min(a.x, b.x) && p.x < std::max(a.x, b.x);
    return upright || level;
}

void add_corners(WorldRing& ring, std::span<const Position> candidates) {
    WorldRing joined;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        WorldRing found;
        for (const Position& p : candidates) {
            if (strictly_between(p, a, b) && std::find(found.begin(), found.end(), p) == found.end())
                found.push_back(p);
        }
        std::sort(found.begin(), found.end(),
                  [&a](const Position& p, const Position& q) { return distance(a, p) < distance(a, q); });
        joined.push_back(a);
        joined.insert(joined.end(), found.begin(), found.end());
    }
    ring = std::move(joined);
}

}  // namespace

void join_shared_walls(std::span<Draft> drafts) {
    WorldRing corners;
    for (const Draft& draft : drafts)
        corners.insert(corners.end(), draft.outline.exterior.begin(), draft.outline.exterior.end());
    for (Draft& draft : drafts)
        add_corners(draft.outline.exterior, corners);
}

}  // namespace d2b::sample
