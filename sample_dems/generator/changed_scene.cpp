#include "changed_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "random.hpp"

namespace d2b::sample {

namespace {

constexpr std::array<std::string_view, 5> change_words{"same", "new", "gone", "raised", "lowered"};

constexpr double least_area_m2 = 50;
constexpr double alone_m = 3;  ///< distance from all other buildings of one that may change

double area_of(const WorldPolygon& polygon) {
    const auto ring_area = [](const WorldRing& ring) {
        double twice = 0;
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
            twice += left_of(ring[0], ring[i], ring[i + 1]) * distance(ring[0], ring[i]);
        return twice / 2;
    };
    double area = ring_area(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors)
        area += ring_area(interior);
    return area;
}

bool meet(const Rect& a, const Rect& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// True if nothing stands near a building that is large enough.
bool may_change(const std::vector<Building>& buildings, std::size_t i) {
    if (area_of(buildings[i].footprint) < least_area_m2)
        return false;
    const Rect around = bounds(buildings[i].footprint.exterior).grown(alone_m);
    for (std::size_t k = 0; k < buildings.size(); ++k)
        if (k != i && meet(around, bounds(buildings[k].footprint.exterior)))
            return false;
    return true;
}

TrueChange drawn_change(std::uint64_t seed, std::int64_t id) {
    constexpr double share = 0.1;
    const double u = uniform_at(seed, id, 91) / share;
    return u < 1   ? TrueChange::built
           : u < 2 ? TrueChange::gone
           : u < 3 ? TrueChange::raised
           : u < 4 ? TrueChange::lowered
                   : TrueChange::same;
}

Building with_floor(Building building) {
    for (RoofPart& part : building.parts) {
        part.eave += floor_m;
        part.top += floor_m;
    }
    return building;
}

void place_buildings(const Scene& scene, std::uint64_t seed, ChangedScene& changed) {
    for (std::size_t i = 0; i < scene.buildings.size(); ++i) {
        const Building& building = scene.buildings[i];
        const TrueChange change =
            may_change(scene.buildings, i) ? drawn_change(seed, building.id) : TrueChange::same;
        const bool lowered = change == TrueChange::lowered;
        const bool raised = change == TrueChange::raised;
        if (change != TrueChange::built)
            changed.before.buildings.push_back(lowered ? with_floor(building) : building);
        if (change != TrueChange::gone)
            changed.after.buildings.push_back(raised ? with_floor(building) : building);
        changed.truth.push_back({raised ? with_floor(building) : building, change});
    }
}

void grow_trees(const std::vector<Tree>& trees, std::uint64_t seed, ChangedScene& changed) {
    for (std::size_t i = 0; i < trees.size(); ++i) {
        Random random(hash(seed, static_cast<std::int64_t>(i), 92));
        const double fate = random.uniform();
        Tree tree = trees[i];
        if (fate >= 0.1)
            changed.before.trees.push_back(tree);
        const double growth = random.between(1.1, 1.4);
        tree.height *= growth;
        tree.radius *= growth;
        if (fate < 0.9)
            changed.after.trees.push_back(tree);
    }
}

}  // namespace

std::string_view change_name(TrueChange change) {
    return change_words[static_cast<std::size_t>(change)];
}

ChangedScene change_scene(Scene scene, std::uint64_t seed) {
    scene.number_buildings();
    const std::vector<Building> buildings = std::exchange(scene.buildings, {});
    const std::vector<Tree> trees = std::exchange(scene.trees, {});
    ChangedScene changed{scene, scene, {}};
    scene.buildings = buildings;
    changed.after.seed = hash(scene.seed, 93, 0);
    place_buildings(scene, seed, changed);
    grow_trees(trees, seed, changed);
    return changed;
}

}  // namespace d2b::sample
