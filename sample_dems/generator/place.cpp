#include "place.hpp"

#include <array>

#include "samples.hpp"

namespace d2b::sample {

namespace {

/// The sample town; another one for another seed.
Scene town_place(std::uint64_t seed) {
    TownPlan plan = town_plan();
    Scene scene = town_ground();
    if (seed != 1) {
        plan.seed = seed;
        scene.seed = seed;
        scene.ground.seed = seed;
    }
    build_strip(plan, 0, plan.rows * plan.pitch, scene);
    return scene;
}

constexpr std::array<Place, 11> all_places{{{"village", 600, village},
                                            {"hamlet", 500, hamlet},
                                            {"pines", 300, pines},
                                            {"hillside", 400, hillside},
                                            {"rows", 300, rows},
                                            {"outskirts", 600, outskirts},
                                            {"park", 500, park},
                                            {"town", 1000, town_place},
                                            {"estate", 400, estate},
                                            {"forest", 1000, forest},
                                            {"fields", 1000, fields}}};

}  // namespace

std::span<const Place> places() {
    return all_places;
}

}  // namespace d2b::sample
