#include "features/rounded_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dem2buildings/error.hpp"
#include "features/reprojection.hpp"
#include "geometry/box_tree.hpp"

namespace d2b::features {
namespace {

constexpr int finest = 17;  // digits, the precision of a double

/// True if rounding moves vertices by more than a few nanometres, whatever the unit.
bool is_coarse(const CoordinateRounding& rounding) {
    return rounding.digits < (rounding.to == CoordinateRounding::To::decimals ? 13 : 15);
}

/// Returns the number of decimals of a coordinate; may be negative.
int decimals_of(double coordinate, const CoordinateRounding& rounding) {
    if (rounding.to == CoordinateRounding::To::decimals || coordinate == 0)
        return rounding.digits;
    return rounding.digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(coordinate))));
}

double to_decimals(double coordinate, int decimals) {
    constexpr double whole = 9007199254740992.0;  // 2^53; from here on every double is an integer
    const double power = std::pow(10.0, std::abs(decimals));
    if (decimals < 0)
        return std::round(coordinate / power) * power;
    // Divides instead of multiplying, because a quotient of integers is the double nearest to the decimal
    // fraction, the same that a parser returns.
    return decimals > 22 || std::abs(coordinate) * power >= whole ? coordinate
                                                                  : std::round(coordinate * power) / power;
}

WorldRing rounded_ring(const WorldRing& ring, const CoordinateRounding& rounding) {
    WorldRing result;
    for (const Position& p : ring)
        if (const Position q{rounded(p.x, rounding), rounded(p.y, rounding)};
            result.empty() || !(result.back() == q))
            result.push_back(q);
    while (result.size() > 1 && result.back() == result.front())
        result.pop_back();
    return result;
}

bool is_flat(const WorldRing& ring) {
    return twice_area(ring) == 0;
}

/// Returns the rounding step of the largest coordinate, a multiple of all others.
double step_of(const std::vector<WorldPolygon>& parts, const CoordinateRounding& rounding) {
    int decimals = std::numeric_limits<int>::max();
    for (const WorldPolygon& part : parts)
        for (const Position& p : part.exterior)
            decimals = std::min({decimals, decimals_of(p.x, rounding), decimals_of(p.y, rounding)});
    return std::pow(10.0, -decimals);
}

}  // namespace

double rounded(double coordinate, const CoordinateRounding& rounding) {
    return rounding.to == CoordinateRounding::To::nothing
               ? coordinate
               : to_decimals(coordinate, decimals_of(coordinate, rounding));
}

RoundedPolygons::RoundedPolygons(CoordinateRounding rounding, bool is_stacked, StopToken stop)
    : rounding_(std::move(rounding)),
      is_stacked_(is_stacked),
      is_coarse_(is_coarse(rounding_)),
      stop_(stop),
      geos_(std::move(stop)) {}

/// @return no parts if a polygon collapses
RoundedPolygons::Parts RoundedPolygons::round_parts(const Parts& exact, const CoordinateRounding& rounding,
                                                    bool& was_repaired) {
    was_repaired = false;
    Parts result;
    for (const WorldPolygon& part : exact) {
        WorldPolygon& made = result.emplace_back();
        made.exterior = rounded_ring(part.exterior, rounding);
        if (is_flat(made.exterior))
            return {};
        for (const WorldRing& hole : part.interiors)
            if (WorldRing ring = rounded_ring(hole, rounding); !is_flat(ring))
                made.interiors.push_back(std::move(ring));
        if (part.exterior == made.exterior && part.interiors == made.interiors)
            made.arcs = part.arcs;
    }
    if (geos_.invalidity(result).empty())
        return result;
    was_repaired = true;
    try {
        return geos_.snap_to_grid(exact, step_of(exact, rounding));
    } catch (const GeometryError&) {
        return {};
    }
}

bool RoundedPolygons::round(LayerRole layer, std::int64_t parent_id, std::string name,
                            std::vector<WorldPolygon>& parts) {
    bool was_repaired = false;
    bool moved = false;
    const auto moves = [&](const WorldRing& ring) {
        return std::ranges::any_of(ring, [&](const Position& p) {
            return rounded(p.x, rounding_) != p.x || rounded(p.y, rounding_) != p.y;
        });
    };
    for (const WorldPolygon& part : parts)
        moved = moved || moves(part.exterior) || std::ranges::any_of(part.interiors, moves);
    Parts exact = parts;
    if (moved) {
        Parts made = round_parts(parts, rounding_, was_repaired);
        if (!made.empty())
            parts = std::move(made);
    }
    any_moved_ = any_moved_ || moved;
    if (is_coarse_)
        items_.push_back({layer, parent_id, std::move(name), std::move(exact)});
    return was_repaired;
}

void RoundedPolygons::find_overlaps(const std::vector<Parts>& shapes, LayerRole layer, Damage& harm) {
    std::vector<std::size_t> members;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (items_[i].layer == layer && !shapes[i].empty()) {
            members.push_back(i);
            boxes.push_back(box_of(shapes[i]));
        }
    const BoxTree tree(boxes);
    const bool siblings_alone = layer == LayerRole::contours && is_stacked_;
    for (std::size_t k = 0; k < members.size(); ++k) {
        stop_.check();
        const std::size_t i = members[k];
        bool harmed = false;
        tree.query(boxes[k], [&](std::size_t other) {
            const std::size_t j = members[other];
            if (harmed || j <= i || (siblings_alone && items_[i].parent_id != items_[j].parent_id))
                return;
            harmed = geos_.overlap(shapes[i], shapes[j]) && !geos_.overlap(items_[i].exact, items_[j].exact);
        });
        if (harmed)
            harm.add(items_[i].name);
    }
}

RoundedPolygons::Damage RoundedPolygons::damage_of(const CoordinateRounding& rounding) {
    Damage harm;
    std::vector<Parts> shapes;
    for (const Item& item : items_) {
        bool was_repaired = false;
        shapes.push_back(round_parts(item.exact, rounding, was_repaired));
        if (shapes.back().empty())
            harm.add(item.name);
    }
    find_overlaps(shapes, LayerRole::buildings, harm);
    find_overlaps(shapes, LayerRole::contours, harm);
    return harm;
}

void RoundedPolygons::finish() {
    if (!any_moved_ || items_.empty())
        return;
    const Damage harm = damage_of(rounding_);
    if (harm.count == 0)
        return;
    CoordinateRounding finer = rounding_;
    while (++finer.digits < finest && damage_of(finer).count > 0) {
    }
    const bool decimals = rounding_.to == CoordinateRounding::To::decimals;
    throw OptionError(
        rounding_.cause + " rounds coordinates so much that " +
        (harm.count == 1
             ? "a polygon is lost or runs into another: "
             : std::to_string(harm.count) + " polygons are lost or run into others, the first of them ") +
        harm.first +
        (finer.digits < finest
             ? "; the coarsest precision that keeps all is " + std::to_string(finer.digits) +
                   (decimals ? finer.digits == 1 ? " decimal." : " decimals." : " significant digits.")
             : "; write another format, such as GeoPackage."));
}

}  // namespace d2b::features
