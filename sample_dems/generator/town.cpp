#include "samples.hpp"
#include "town_plan.hpp"

namespace d2b::sample {

TownPlan town_plan() {
    using enum Quarter;
    TownPlan plan;
    plan.seed = 2682;
    plan.quarters = {works,  row_houses, villas,      // the south
                     slabs,  old_town,   row_houses,  //
                     villas, old_town,   park};
    return plan;
}

Scene town_ground() {
    Scene scene;
    scene.seed = 2003;
    scene.noise = 0.04;
    scene.ground = {25, 205, 0, 0, 46, {}, {}};
    return scene;
}

Sample town() {
    const Grid grid{1000, 1000, 1, 1, {391000, 1, 0, 5821000, 0, -1}};
    Sample sample{"town", {grid, {}, "EPSG:25833", {}, true}, town_ground()};
    const TownPlan plan = town_plan();
    build_strip(plan, 0, plan.rows * plan.pitch, sample.scene);
    sample.scene.number_buildings();
    return sample;
}

}  // namespace d2b::sample
