#include <algorithm>

#include "draft.hpp"
#include "lots.hpp"
#include "place.hpp"
#include "random.hpp"

namespace d2b::sample {

namespace {

constexpr int lots_a_side = 10;
constexpr double lot_side = 40;  // metres

/// A house around the middle of its lot. Mansard and pyramidal roofs are twice as frequent as others, because
/// other places have none or few.
Draft estate_house(int form, Random& random) {
    const double depth = random.eighths(9, 15);
    const double width = depth + random.eighths(2.5, 9);
    const double eave = random.eighths(3, 9);
    const double pitch = random.between(0.45, 0.95);
    const Rect box{-width / 2, -depth / 2, width / 2, depth / 2};
    const Rect square{-depth / 2, -depth / 2, depth / 2, depth / 2};
    switch (form) {
        case 0:
        case 1:
            return box_house("house", box, {Roof::mansard, eave, random.between(0.6, 0.85)});
        case 2:
        case 3:
            return box_house("house", square, {Roof::hipped, eave, pitch});
        case 4:
            return box_house("house", box, {Roof::hipped, eave, pitch});
        case 5:
            return box_house("house", box, {Roof::gabled, eave, pitch});
        case 6:
            return l_house("house", {-width / 2, -depth / 2 - 3, width / 2, depth / 2 + 3}, 7,
                           {Roof::gabled, eave, pitch});
        case 7:
            return box_house("house", box, {Roof::shed, eave, random.between(0.18, 0.4)});
        case 8:
            return box_house("house", box, {Roof::flat, eave, 0});
        default: {
            const Roof roof = random.chance(0.5) ? Roof::cone : Roof::dome;
            return round_house("rotunda", {0, 0}, depth / 2, {roof, eave, 0}, pitch * depth / 2);
        }
    }
}

}  // namespace

Scene estate(std::uint64_t seed) {
    Scene scene;
    scene.seed = seed;
    scene.ground.seed = hash(seed, 11, 1);
    scene.ground.base = 60;
    scene.ground.relief = 12;
    for (int row = 0; row < lots_a_side; ++row)
        for (int col = 0; col < lots_a_side; ++col) {
            Random random(hash(seed, col, row));
            const Frame middle{{(col + 0.5) * lot_side, (row + 0.5) * lot_side},
                               Direction::from_half_tangent(random.between(-1, 1))};
            const std::size_t first = scene.buildings.size();
            // Each form once in a row, beginning at another one.
            scene.add(estate_house((col + 3 * row) % lots_a_side, random), middle);
            const Site garden{scene, random, middle.moved({-18, -18}), 36, 36};
            if (random.chance(0.3))
                garden.plant({random.between(0, 5), random.between(0, 36)}, random.between(4, 12), false,
                             first);
        }
    return scene;
}

}  // namespace d2b::sample
