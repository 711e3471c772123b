#include "score/score.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "score/objects.hpp"
#include "score/shapes.hpp"

namespace d2b::score {
namespace {

using namespace test;

TEST(Score, ofTheSameIsPerfect) {
    const Score result = score(side({box(0, 0, 10, 10)}), side({box(0, 0, 10, 10)}), {});
    EXPECT_DOUBLE_EQ(result.iou, 1);
    EXPECT_DOUBLE_EQ(result.completeness, 1);
    EXPECT_DOUBLE_EQ(result.correctness, 1);
    EXPECT_EQ(result.object_completeness, 1);
    EXPECT_EQ(result.object_correctness, 1);
    EXPECT_NEAR(result.outline_rms_m.value(), 0, 1e-9);
    EXPECT_NEAR(result.outline_m, 40, 1e-9);
    EXPECT_EQ(result.polis_m, 0);
    EXPECT_EQ(result.pairs, 1U);
    EXPECT_EQ(result.overlap, 0);
    EXPECT_EQ(result.vertex_ratio, 1);
    EXPECT_FALSE(result.heights);
}

TEST(Score, ofAShiftedSquare) {
    // 10 by 10, by 2 to the right: 80 m2 shared, of 120 m2 of both.
    const Score result = score(side({box(2, 0, 12, 10)}), side({box(0, 0, 10, 10)}), {});
    EXPECT_NEAR(result.iou, 80.0 / 120, 1e-12);
    EXPECT_NEAR(result.completeness, 0.8, 1e-12);
    EXPECT_NEAR(result.correctness, 0.8, 1e-12);
    EXPECT_NEAR(result.polis_m.value(), 1, 1e-12);  // two of four vertices are 2 away, both ways
    // Integrals of squared distances: right edge 10 * 4; left edge, which is nearer to the level edges where
    // these are less than 2 away, 6 * 4 + 2 * 8/3; level edges 0 for 8 m and 8/3 for the 2 m that stick out.
    EXPECT_NEAR(result.outline_rms_m.value(), std::sqrt((40 + 24 + 4 * 8.0 / 3) / 40), 1e-3);
}

TEST(Score, countsOutlinesNearTheReferenceAlone) {
    // 4 m wider to the right: the right edge is 4 m away; of the level ones the last metre is beyond 3 m.
    const Score result = score(side({box(0, 0, 14, 10)}), side({box(0, 0, 10, 10)}), {});
    EXPECT_NEAR(result.outline_m, 48, 1e-9);
    EXPECT_NEAR(result.outline_near_m, 10 + 2 * 13, 0.05);
    EXPECT_NEAR(result.outline_rms_m.value(), std::sqrt(2 * 9.0 / 36), 0.01);
}

TEST(Score, ofNothingIsZero) {
    const Score nothing_found = score(side({}), side({box(0, 0, 10, 10)}), {});
    EXPECT_EQ(nothing_found.iou, 0);
    EXPECT_EQ(nothing_found.completeness, 0);
    EXPECT_EQ(nothing_found.correctness, 0);
    EXPECT_EQ(nothing_found.object_correctness, 0);
    EXPECT_EQ(nothing_found.vertex_ratio, 0);
    EXPECT_FALSE(nothing_found.outline_rms_m);
    EXPECT_FALSE(nothing_found.polis_m);
    EXPECT_EQ(score(side({box(0, 0, 10, 10)}), side({}), {}).vertex_ratio, 0);
    EXPECT_EQ(score(side({}), side({}), {}).iou, 0);
}

TEST(Score, measuresOverlap) {
    // 100 and 100 m2 with 30 m2 in common: 170 m2 are covered.
    const Score result = score(side({box(0, 0, 10, 10), box(7, 0, 17, 10)}), side({box(0, 0, 17, 10)}), {});
    EXPECT_NEAR(result.overlap, 30.0 / 170, 1e-12);
    EXPECT_NEAR(result.iou, 1, 1e-12);
    EXPECT_EQ(result.found.objects, 1U);  // dissolved
    EXPECT_EQ(result.found.features, 2U);
}

TEST(Score, countsAndRepairsInvalidPolygons) {
    // A bow tie of two triangles with 25 m2 each.
    const WorldPolygon bow_tie{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}};
    const Score result = score(side({bow_tie}), side({box(0, 0, 10, 10)}), {});
    EXPECT_EQ(result.found.invalid, 1U);
    EXPECT_NEAR(result.found.area_m2, 50, 1e-9);
    EXPECT_NEAR(result.completeness, 0.5, 1e-12);
    EXPECT_EQ(result.found.vertices, 5U);  // as it was given
    Overlay overlay;
    EXPECT_EQ(score_side({{{box(0, 0, 1, 1)}, {}, true}}, overlay).invalid, 1U);  // an open ring
}

TEST(Score, countsObjectsThatAreCoveredByHalf) {
    // Found: one of 100 m2 with 60 in the reference, one of 100 m2 beside, one of 9 m2 that is too small.
    // Reference: one of 100 m2 with 60 in the found one, one of 400 m2 with none.
    const Score result = score(side({box(4, 0, 14, 10), box(100, 0, 110, 10), box(50, 0, 53, 3)}),
                               side({box(0, 0, 10, 10), box(200, 0, 220, 20)}), {});
    EXPECT_EQ(result.found.objects, 2U);
    EXPECT_EQ(result.found.objects_covered, 1U);
    EXPECT_EQ(result.object_correctness, 0.5);
    EXPECT_EQ(result.reference.objects, 2U);
    EXPECT_EQ(result.object_completeness, 0.5);
    EXPECT_EQ(result.pairs, 0U);  // its IoU is 60 / 140
    ScoreOptions options;
    options.min_object_m2 = 5;
    EXPECT_EQ(score(side({box(50, 0, 53, 3)}), side({box(0, 0, 10, 10)}), options).found.objects, 1U);
}

TEST(Score, looksInsideTheRegionAlone) {
    ScoreOptions options;
    options.region = Polygons{box(0, 0, 10, 20)};
    // Left of 10 the found square is as the reference's; right of it, it is far too long. One more lies
    // outside.
    const Score result =
        score(side({box(2, 2, 30, 12), box(40, 0, 50, 10)}), side({box(2, 2, 12, 12)}), options);
    EXPECT_NEAR(result.iou, 1, 1e-12);
    EXPECT_NEAR(result.found.area_m2, 80, 1e-9);
    EXPECT_NEAR(result.outline_m, 8 + 10 + 8, 0.01);  // where the region ends is no outline
    EXPECT_NEAR(result.outline_rms_m.value(), 0, 1e-6);
    EXPECT_EQ(result.found.features, 2U);
    EXPECT_EQ(result.found.vertices, 5U);  // the one outside does not touch the region
}

TEST(Score, countsOutlinesOnTheLeftAndUpperBorderOfTheRegion) {
    ScoreOptions options;
    options.region = Polygons{box(0, 0, 10, 20)};
    const Score result = score(side({box(0, 0, 10, 20)}), side({box(0, 0, 10, 20)}), options);
    EXPECT_NEAR(result.outline_m, 10 + 20, 0.01);
}

TEST(Score, turnsFeetIntoMetres) {
    ScoreOptions options;
    options.metres = 0.3048;
    // 100 by 100 ft, 4 ft to the right of the reference: 929.0304 m2.
    const Score result = score(side({box(4, 0, 104, 100)}), side({box(0, 0, 100, 100)}), options);
    EXPECT_NEAR(result.found.area_m2, 929.0304, 1e-6);
    EXPECT_NEAR(result.shared_m2, 929.0304 * 0.96, 1e-6);
    EXPECT_NEAR(result.outline_m, 121.92, 1e-6);
    EXPECT_NEAR(result.polis_m.value(), 2 * 0.3048, 1e-9);
    EXPECT_EQ(result.found.objects, 1U);
    // 20 by 20 ft are 37.2 m2.
    EXPECT_EQ(score(side({box(0, 0, 20, 20)}), side({box(0, 0, 20, 20)}), options).found.objects, 0U);
}

TEST(Score, simplifiesTheReferenceBeforeItsVerticesAreCounted) {
    const WorldPolygon wavy{{{0, 0}, {5, 0.04}, {10, 0}, {10, 10}, {0, 10}}, {}};
    const Score result = score(side({wavy}), side({wavy}), {});
    EXPECT_EQ(result.found.vertices, 6U);
    EXPECT_EQ(result.reference.vertices, 5U);
    EXPECT_DOUBLE_EQ(result.vertex_ratio, 6.0 / 5);
}

TEST(Score, comparesHeightsOfPairs) {
    const ScoreSide found =
        side({box(0, 0, 10, 10), box(50, 0, 60, 10), box(90, 0, 99, 10)}, {12.0, 7.0, 99.0});
    const ScoreSide reference =
        side({box(0, 0, 10, 10), box(50, 0, 60, 10), box(120, 0, 130, 10)}, {10.0, 8.0, 1.0});
    const HeightErrors errors = score(found, reference, {}).heights.value();
    EXPECT_EQ(errors.pairs, 2U);
    EXPECT_DOUBLE_EQ(errors.mean, 0.5);
    EXPECT_DOUBLE_EQ(errors.rms, std::sqrt(2.5));
    EXPECT_DOUBLE_EQ(errors.median_absolute, 1.5);
}

TEST(HeightErrors, ofThree) {
    const HeightErrors errors = height_errors(std::vector<double>{-1, 2, 5}).value();
    EXPECT_EQ(errors.pairs, 3U);
    EXPECT_DOUBLE_EQ(errors.mean, 2);
    EXPECT_DOUBLE_EQ(errors.rms, std::sqrt(10.0));
    EXPECT_EQ(errors.median_absolute, 2);
}

TEST(HeightErrors, takeTheMiddleOfTwoMedians) {
    EXPECT_EQ(height_errors(std::vector<double>{-4, 1, 2, 10}).value().median_absolute, 3);
}

TEST(HeightErrors, areNothingWithoutPairs) {
    EXPECT_FALSE(height_errors({}));
}

TEST(ObjectHeights, areMeansByArea) {
    Overlay overlay;
    const Polygons objects{box(0, 0, 10, 10), box(20, 0, 30, 10), box(40, 0, 50, 10)};
    // In the first object 30 m2 of 4 m, 70 m2 of 14 m, and one without a height; in the second none.
    const std::vector<Polygons> areas{
        {box(0, 0, 3, 10)}, {box(3, 0, 10, 10)}, {box(1, 1, 2, 2)}, {box(20, 0, 30, 10)}};
    const std::vector<std::optional<double>> heights{4.0, 14.0, {}, {}};
    const auto result = object_heights(heights, areas, objects, overlay);
    ASSERT_EQ(result.size(), 3U);
    EXPECT_DOUBLE_EQ(result[0].value(), 0.3 * 4 + 0.7 * 14);
    EXPECT_FALSE(result[1]);
    EXPECT_FALSE(result[2]);
}

TEST(Compare, sharesAreasOutToObjects) {
    Overlay overlay;
    // One found object over two of the reference, 6 by 10 and 2 by 10 of it; one alone.
    const Comparison result =
        compare({box(0, 0, 10, 10), box(50, 0, 60, 10)}, {box(-4, 0, 6, 10), box(8, 0, 18, 10)}, overlay);
    EXPECT_DOUBLE_EQ(result.found_area, 200);
    EXPECT_DOUBLE_EQ(result.reference_area, 200);
    EXPECT_DOUBLE_EQ(result.shared_area, 80);
    EXPECT_DOUBLE_EQ(result.found.shared[0], 80);
    EXPECT_EQ(result.found.shared[1], 0);
    EXPECT_DOUBLE_EQ(result.reference.shared[0], 60);
    EXPECT_DOUBLE_EQ(result.reference.shared[1], 20);
    ASSERT_EQ(result.pairs.size(), 2U);
    EXPECT_DOUBLE_EQ(result.pairs[0].iou, 60.0 / 140);
    EXPECT_DOUBLE_EQ(result.pairs[1].iou, 20.0 / 180);
    EXPECT_EQ(result.pairs[1].reference, 1U);
}

TEST(CountObjects, leavesSmallOnesOut) {
    const ScoredObjects objects{{box(0, 0, 7, 7), box(10, 0, 20, 5), box(30, 0, 40, 10), box(50, 0, 60, 10)},
                                {49, 50, 100, 100},
                                {49, 25, 49.9, 80}};
    const ObjectCount count = count_objects(objects, 50);
    EXPECT_EQ(count.large, 3U);    // 49 is too small, 50 is not
    EXPECT_EQ(count.covered, 2U);  // exactly half is enough
    EXPECT_EQ(count_objects(objects, 0).large, 4U);
}

TEST(Reaches, bearsRounding) {
    EXPECT_TRUE(at_least(0.1 + 0.7, 0.8));  // 0.7999999999999999
    EXPECT_FALSE(at_least(0.7999, 0.8));
    EXPECT_TRUE(at_least(0, 0));
}

}  // namespace
}  // namespace d2b::score
