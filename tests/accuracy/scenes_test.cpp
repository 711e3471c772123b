// Scenes whose truth is exact, found with the defaults: bounds that a worse default would not meet. run.py
// measures on many more.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/run.hpp"
#include "score/score.hpp"
#include "seen_scene.hpp"

namespace d2b::test {
namespace {

score::ScoreSide side_of(const std::vector<PolygonFeature>& features) {
    Overlay overlay;
    return score::score_side(features, overlay);
}

/// A scene's score, with the sampling and the warnings that the run reports.
struct Scored : Score {
    SamplingReport sampling;
    std::vector<std::string> warnings;
};

Scored scored(const std::string& name) {
    const sample::SceneChoice choice = sample::choose_scene(name);
    const sample::Scene scene = choice.place.make(1);
    const sample::Seen seen = sample::see(scene, sample::grid_over(choice), choice.survey);
    SeenScene source(seen);
    MemorySink sink;
    const RunReport report = run({}, {source}, {sink});

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
    return {score::score(side_of(found), side_of(truth), {}), report.sampling.value(), report.warnings};
}

TEST(AccuracyOfScenes, RowsOfHousesAreFoundWhole) {
    const Scored score = scored("rows_lidar8");
    EXPECT_GT(score.iou, 0.94);
    EXPECT_EQ(score.object_completeness, 1);
    EXPECT_EQ(score.object_correctness, 1);
    EXPECT_LT(score.outline_rms_m.value(), 0.3);
    EXPECT_LT(score.sampling.edge_width_cells.value(), 1);
    EXPECT_EQ(score.warnings.size(), 0U);
}

TEST(AccuracyOfScenes, FarmsAmongThinPointsAreFoundByHalf) {
    const Scored score = scored("hamlet_thinned");
    EXPECT_GT(score.iou, 0.5);
    EXPECT_GE(score.object_completeness, 0.5);
    EXPECT_GE(score.object_correctness, 0.9);
    const double points = 0.3 * 2.5 * 2.5;  // a cell
    EXPECT_NEAR(score.sampling.points_per_cell.value(), points, 0.25 * points);
    EXPECT_LT(score.sampling.edge_width_cells.value(), 1);
    ASSERT_EQ(score.warnings.size(), 1U);
    EXPECT_TRUE(score.warnings[0].starts_with("Points are sparse: about ")) << score.warnings[0];
}

TEST(AccuracyOfScenes, ABlurIsSeenForWhatItIs) {
    const Scored score = scored("rows_satellite");
    const double width = 2.563 * 2;  // of a normal distribution of 2 m, between a tenth and nine tenths
    EXPECT_NEAR(score.sampling.edge_width_cells.value(), width, 0.15 * width);
    EXPECT_EQ(score.sampling.points_per_cell, std::nullopt);
    ASSERT_EQ(score.warnings.size(), 1U);
    EXPECT_TRUE(score.warnings[0].starts_with("Walls are blurred: they extend over ")) << score.warnings[0];
}

}  // namespace
}  // namespace d2b::test
