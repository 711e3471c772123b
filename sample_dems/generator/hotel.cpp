#include "draft.hpp"
#include "random.hpp"
#include "samples.hpp"

namespace d2b::sample {

namespace {

constexpr double foot = 0.3048;

/// A row of bushes of 4 to 12 feet along a wall, from one end to the other.
void add_bushes(Scene& scene, const Position& from, const Position& to, Random& random) {
    const double length = distance(from, to);
    for (double along = random.between(0, 2); along < length; along += random.between(1.5, 4.5)) {
        const double t = along / length;
        const double high = random.between(4, 12) * foot;
        scene.plant({{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)},
                     0,
                     high,
                     random.between(1, 1.8),
                     false,
                     0},
                    0);
    }
}

/// An H of 176 x 200 feet whose wings are 56 feet wide, a tower on its bar.
Draft hotel_draft() {
    const RoofStyle flat{Roof::flat, 135 * foot, 0};
    Draft draft = h_house("hotel", {0, 0, 176 * foot, 200 * foot}, 56 * foot, flat);
    const Position centre{88 * foot, 100 * foot};
    const auto storey = [&](double half_side, double top) {
        return wing({centre.x - half_side * foot, centre.y - half_side * foot, centre.x + half_side * foot,
                     centre.y + half_side * foot},
                    {Roof::flat, top * foot, 0});
    };
    draft.parts.push_back(storey(26, 165));
    draft.parts.push_back(storey(18, 185));
    return draft;
}

}  // namespace

Sample hotel() {
    const Grid grid{70, 85, 1, 1, {425100, 1, 0, 4513700, 0, -1}};
    Sample sample{"hotel_70x85", {grid, {"ft", foot, 1.0 / 64}, "EPSG:26912", {}, false}, {}};
    Scene& scene = sample.scene;
    scene.seed = 185;
    scene.noise = 0.2 * foot;
    const Position corner{8.2, 12.1};
    scene.add(hotel_draft(), {corner, {}});
    scene.number_buildings();
    const double left = corner.x;
    const double right = corner.x + 176 * foot;
    const double bottom = corner.y;
    const double top = corner.y + 200 * foot;
    Random random(scene.seed);
    const double gap = 1.2;  // metres between the wall and the middle of a bush
    add_bushes(scene, {left - gap, bottom}, {left - gap, top}, random);
    add_bushes(scene, {right + gap, bottom}, {right + gap, top}, random);
    add_bushes(scene, {left, bottom - gap}, {right, bottom - gap}, random);
    add_bushes(scene, {left + 60 * foot, top + gap}, {right - 60 * foot, top + gap}, random);
    // Adds bushes in the forecourt between the wings.
    add_bushes(scene, {left + 60 * foot, bottom + 8}, {right - 60 * foot, bottom + 8}, random);
    return sample;
}

}  // namespace d2b::sample
