#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "draft.hpp"
#include "random.hpp"

namespace d2b::sample {

std::optional<double> Tree::elevation_at(const Position& p) const {
    const double r = distance(trunk, p) / radius;
    if (r >= 1)
        return std::nullopt;
    const double twig = 0.75;  // metres: leaves that hide each other
    const double random = uniform_at(seed, std::llround(p.x / twig), std::llround(p.y / twig));
    if (random < 0.25 * r)
        return std::nullopt;  // a gap: the laser reaches the things below
    const double shape = conifer ? 1 - 0.8 * r : 1 - 0.5 * r * r * r;
    return ground + height * shape * (0.86 + 0.28 * (random - 0.5));
}

std::optional<double> Tree::first_return(const Position& p, std::uint64_t draw) const {
    const double r = distance(trunk, p) / radius;
    if (r >= 1)
        return std::nullopt;
    // Boughs of a crown lie at heights of their own; between them and through their leaves some pulses pass.
    const double bough = 0.9;  // metres
    const std::uint64_t bits = hash(seed, std::llround(p.x / bough), std::llround(p.y / bough));
    if (unit_interval(mix(draw)) < 0.03 + 0.3 * r * unit_interval(mix(bits)))
        return std::nullopt;
    const double shape = conifer ? 1 - 0.8 * r : 1 - 0.5 * r * r * r;
    const double hull = height * shape * (0.86 + 0.28 * (unit_interval(bits) - 0.5));
    const double u = unit_interval(mix(draw + 1));
    return ground + hull - std::min(2.5, 0.3 * height) * u * u * u;
}

std::optional<double> Block::elevation_at(const Position& p) const {
    const Position local = frame.to_local(p);
    if (!rect.contains(local))
        return std::nullopt;
    return elevation_start + (elevation_end - elevation_start) * (local.x - rect.x0) / rect.width();
}

Building& Scene::add(const Draft& draft, const Frame& frame) {
    const Rect box = bounds(draft.outline.exterior);
    Building building;
    building.kind = draft.kind;
    building.frame = frame;
    building.footprint = frame.to_scene(draft.outline);
    building.parts = draft.parts;
    building.ground = ground.at(frame.to_scene(box.centre()));
    building.width = box.width();
    building.length = box.depth();
    return buildings.emplace_back(std::move(building));
}

void Scene::plant(Tree tree, std::size_t first_building) {
    for (std::size_t i = first_building; i < buildings.size(); ++i) {
        if (contains(buildings[i].footprint, tree.trunk))
            return;
    }
    tree.ground = ground.at(tree.trunk);
    tree.seed = hash(seed, std::llround(tree.trunk.x * 64), std::llround(tree.trunk.y * 64));
    trees.push_back(tree);
}

void Scene::add_block(const Frame& frame, const Rect& rect, double height) {
    const double y = rect.centre().y;
    blocks.push_back({frame, rect, ground.at(frame.to_scene(Position{rect.x0, y})) + height,
                      ground.at(frame.to_scene(Position{rect.x1, y})) + height});
}

void Scene::number_buildings() {
    for (std::size_t i = 0; i < buildings.size(); ++i)
        buildings[i].id = static_cast<std::int64_t>(i) + 1;
}

}  // namespace d2b::sample
