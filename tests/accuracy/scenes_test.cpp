// Scenes whose truth is exact, found with the defaults: bounds that a worse default would not meet. run.py
// measures on many more.
#include <gtest/gtest.h>

#include "dem2buildings/run.hpp"
#include "score/score.hpp"
#include "seen_scene.hpp"

namespace d2b::test {
namespace {

ScoreSide side_of(const std::vector<PolygonFeature>& features) {
    Overlay overlay;
    return score_side(features, overlay);
}

Score scored(const std::string& name) {
    const sample::SceneChoice choice = sample::choose_scene(name);
    const sample::Scene scene = choice.place.make(1);
    const sample::Seen seen = sample::see(scene, sample::grid_over(choice), choice.survey);
    SeenScene source(seen);
    MemorySink sink;
    run({}, {source}, {sink});

    std::vector<PolygonFeature> found;
    for (const Feature& feature : sink.features[0])
        found.push_back({feature.parts, {}, false});
    std::vector<PolygonFeature> truth;
    for (const sample::Building& building : scene.buildings) {
        WorldPolygon polygon = building.footprint;
        const auto place = [&](WorldRing& ring) {
            for (Position& p : ring)
                p = seen.grid.to_world(p);
            ring.push_back(ring.front());
        };
        place(polygon.exterior);
        for (WorldRing& hole : polygon.interiors)
            place(hole);
        truth.push_back({{polygon}, {}, false});
    }
    return score(side_of(found), side_of(truth), {});
}

TEST(AccuracyOfScenes, RowsOfHousesAreFoundWhole) {
    const Score score = scored("rows_lidar8");
    EXPECT_GT(score.iou, 0.94);
    EXPECT_EQ(score.object_completeness, 1);
    EXPECT_EQ(score.object_correctness, 1);
    EXPECT_LT(score.outline_rms_m.value(), 0.3);
}

TEST(AccuracyOfScenes, FarmsAmongThinPointsAreFoundByHalf) {
    const Score score = scored("hamlet_thinned");
    EXPECT_GT(score.iou, 0.5);
    EXPECT_GE(score.object_completeness, 0.5);
    EXPECT_GE(score.object_correctness, 0.9);
}

}  // namespace
}  // namespace d2b::test
