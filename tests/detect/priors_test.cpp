#include "detect/priors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr double usual = 0.62;

double normal_density(double x, double mean) {
    return std::exp(-(x - mean) * (x - mean) / 2);
}

/// Candidates of which so many are buildings: their ratios are normal about 1, those of others about -1.
std::vector<double> ratios_of(double share, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> spread;
    std::vector<double> ratios;
    for (int i = 0; i < count; ++i) {
        const double seen = spread(random) + (i < share * count ? 1 : -1);
        ratios.push_back(normal_density(seen, 1) / normal_density(seen, -1));
    }
    return ratios;
}

TEST(ShareOfBuildings, IsFoundWithoutLabels) {
    for (const double share : {0.02, 0.1, 0.39, 0.7, 0.95})
        for (const unsigned seed : {1U, 2U, 3U})
            EXPECT_NEAR(estimate_building_share(ratios_of(share, 5000, seed)), share, 0.03)
                << share << " " << seed;
}

TEST(ShareOfBuildings, IsWhatTheCandidatesSayOnTheMean) {
    const std::vector<double> ratios = ratios_of(0.3, 400, 5);
    const double share = estimate_building_share(ratios);
    double sum = 50 * usual;
    for (const double ratio : ratios)
        sum += share * ratio / (share * ratio + 1 - share);
    EXPECT_NEAR(sum / 450, share, 1e-5);
}

TEST(ShareOfBuildings, TheUsualOneWhereNothingIsKnown) {
    EXPECT_NEAR(estimate_building_share({}), usual, 1e-9);
    EXPECT_NEAR(estimate_building_share(std::vector<double>(1000, 1.0)), usual, 1e-9);
    // Two that say it all move it by a fiftieth each.
    const double two = estimate_building_share(std::vector<double>(2, 1e-9));
    EXPECT_NEAR(two, 50 * usual / 52, 1e-6);
}

std::vector<DetectedObject> objects_of(const std::vector<double>& confidences) {
    std::vector<DetectedObject> objects;
    for (const double confidence : confidences)
        objects.push_back({confidence, CounterEvidence::rough, 100});
    return objects;
}

/// Objects: so many of a confidence beyond doubt, of one above a half, and of one below.
std::vector<DetectedObject> place(int sure, int likely, int doubtful) {
    std::vector<double> confidences;
    confidences.insert(confidences.end(), static_cast<std::size_t>(sure), 0.99);
    confidences.insert(confidences.end(), static_cast<std::size_t>(likely), 0.55);
    confidences.insert(confidences.end(), static_cast<std::size_t>(doubtful), 0.15);
    return objects_of(confidences);
}

bool is_changed(std::vector<DetectedObject> objects) {
    const double before = objects.back().confidence;
    apply_scene_prior(0, objects);
    return objects.back().confidence != before;
}

TEST(ScenePrior, AmongWoodsLessIsABuilding) {
    std::vector<DetectedObject> objects = place(40, 40, 920);
    apply_scene_prior(0, objects);
    EXPECT_LT(objects[40].confidence, 0.3);
    EXPECT_GT(objects[0].confidence, 0.95);
    EXPECT_LT(objects.back().confidence, 0.05);
}

TEST(ScenePrior, NothingIsMoreCertainThanElsewhere) {
    EXPECT_FALSE(is_changed(place(400, 40, 20)));
}

TEST(ScenePrior, EvenOddsStayEvenAtTheUsualShare) {
    // All but one candidate are as good as certain; a hair fewer of them than usual are buildings.
    std::vector<DetectedObject> objects = place(6190, 0, 3810);
    for (DetectedObject& object : objects)
        object.confidence = object.confidence > 0.5 ? 1 - 1e-9 : 1e-9;
    objects.push_back({0.5, CounterEvidence::rough, 100});
    apply_scene_prior(0, objects);
    EXPECT_NE(objects.back().confidence, 0.5);
    EXPECT_NEAR(objects.back().confidence, 0.5, 2e-3);
}

TEST(ScenePrior, SaysWhatShareConfidencesSupposeThen) {
    std::vector<DetectedObject> woods = place(40, 40, 920);
    const PriorShare corrected = apply_scene_prior(0, woods);
    EXPECT_EQ(corrected.least, corrected.most);
    double sum = 50 * usual;
    for (const DetectedObject& object : woods)
        sum += object.confidence;
    EXPECT_NEAR(sum / 1050, corrected.least, 1e-5);
    // Not corrected: between the usual share and their mean.
    std::vector<DetectedObject> few = objects_of({0, 0.2, 0.4, 1});
    const PriorShare low = apply_scene_prior(0, few);
    EXPECT_NEAR(low.least, 0.3, 1e-12);
    EXPECT_EQ(low.most, usual);
    few = objects_of({0.8, 0.9});
    const PriorShare high = apply_scene_prior(0, few);
    EXPECT_EQ(high.least, usual);
    EXPECT_NEAR(high.most, 0.85, 1e-12);
    few.clear();
    EXPECT_EQ(apply_scene_prior(0, few).least, usual);
}

TEST(UsualAppearance, AFifthOfTheLikelyAreBeyondDoubt) {
    EXPECT_TRUE(has_usual_appearance({}));
    EXPECT_TRUE(has_usual_appearance(place(1, 4, 50)));
    EXPECT_FALSE(has_usual_appearance(place(1, 5, 0)));
}

TEST(ScenePrior, SingleTreesOfFieldsAreNoHouses) {
    // Thirty trees, five of which look like small houses. The likelihood ratios of 0.55 and 0.15 are 0.8117
    // and 0.05404. One candidate with the usual share is added.
    std::vector<DetectedObject> trees = place(0, 5, 25);
    const PriorShare prior = apply_scene_prior(0.2, trees);
    const double estimated = prior.most / 2.5;
    double sum = usual;
    for (const double ratio : {0.8117, 0.05404})
        sum += (ratio > 0.5 ? 5 : 25) * estimated * ratio / (estimated * ratio + 1 - estimated);
    EXPECT_NEAR(sum / 31, estimated, 1e-5);
    const double change = prior.most / (1 - prior.most) * (1 - usual) / usual;
    const double changed = 0.55 / 0.45 * change / (1 + 0.55 / 0.45 * change);
    EXPECT_NEAR(trees[0].confidence, changed, 1e-9);
    EXPECT_LT(changed, 0.1);
}

TEST(ScenePrior, AFewDoubtsAreNoFields) {
    for (std::vector<DetectedObject> objects : {place(0, 1, 0), place(0, 2, 1), place(2, 3, 25)}) {
        const std::vector<DetectedObject> before = objects;
        apply_scene_prior(0.2, objects);
        for (std::size_t i = 0; i < objects.size(); ++i)
            EXPECT_EQ(objects[i].confidence, before[i].confidence);
    }
}

TEST(ScenePrior, KeepsTheOrderAndWhatIsCertain) {
    std::vector<double> confidences{0, 1};
    for (int i = 1; i < 200; ++i)
        confidences.push_back(i / 200.0);
    std::vector<DetectedObject> objects = objects_of(confidences);
    for (int i = 0; i < 100; ++i)
        objects.push_back({0.97, CounterEvidence::steep, 5});
    for (int i = 0; i < 300; ++i)
        objects.push_back({0.1, CounterEvidence::steep, 5});
    apply_scene_prior(0, objects);
    EXPECT_EQ(objects[0].confidence, 0);
    EXPECT_EQ(objects[1].confidence, 1);
    EXPECT_NE(objects[100].confidence, confidences[100]);
    EXPECT_TRUE(std::is_sorted(objects.begin() + 2, objects.begin() + 201,
                               [](const auto& a, const auto& b) { return a.confidence < b.confidence; }));
    EXPECT_EQ(objects.back().doubt, CounterEvidence::steep);
    EXPECT_EQ(objects.back().cells, 5);
    std::vector<DetectedObject> none;
    apply_scene_prior(0, none);
    EXPECT_TRUE(none.empty());
}

constexpr PriorShare half{0.5, 0.5};

/// Objects of one cell of a metre each, and their confidences.
struct Place {
    Place(std::int32_t rows, std::int32_t cols) : cells(rows, cols) {}

    /// Adds objects in scan order.
    void add(std::int32_t r, std::int32_t c, double confidence) {
        cells.at(r, c) = 1;
        objects.push_back({confidence, CounterEvidence::rough, 1});
    }
    [[nodiscard]] std::vector<double> corrected(const PriorShare& prior, Executor& threads) const {
        std::vector<DetectedObject> result = objects;
        apply_spatial_prior(connected_regions(cells, 1, 0, threads), {1, 1}, prior, result, threads);
        std::vector<double> confidences;
        for (const DetectedObject& object : result)
            confidences.push_back(object.confidence);
        return confidences;
    }
    [[nodiscard]] std::vector<double> corrected(const PriorShare& prior) const {
        return corrected(prior, threads());
    }

    Mask cells;
    std::vector<DetectedObject> objects;
};

TEST(SpatialPrior, BayesRuleWithTheShareAround) {
    Place place(1, 400);
    place.add(0, 100, 0.6);
    place.add(0, 175, 0.9);  // half of the reach away
    place.add(0, 399, 0.1);  // beyond the reach of both
    const double weight = 0.75 * 0.75;
    const double share = (0.5 + weight * 0.9) / (1 + weight);
    const double odds = 0.6 / 0.4 * share / (1 - share);
    const std::vector<double> now = place.corrected(half);
    EXPECT_NEAR(now[0], odds / (1 + odds), 1e-12);
    EXPECT_NEAR(now[2], 0.1, 1e-12) << "alone";
}

TEST(SpatialPrior, HousesAmongHousesAndCrownsAmongCrowns) {
    Place place(600, 30);
    for (std::int32_t r = 0; r < 600; r += 20)
        place.add(r, r % 30, r == 100 || r == 500 ? 0.5 : r < 300 ? 0.9 : 0.1);
    const std::vector<double> now = place.corrected(half);
    EXPECT_GT(now[5], 0.75);
    EXPECT_LT(now[25], 0.25);
}

TEST(SpatialPrior, AShareWithinWhatIsSupposedChangesNothing) {
    Place place(10, 100);
    for (std::int32_t c = 0; c < 100; c += 10)
        place.add(5, c, 0.3);
    EXPECT_EQ(place.corrected({0.2, 0.6}), std::vector<double>(10, 0.3));
    EXPECT_LT(place.corrected({0.4, 0.6})[4], 0.3);
    EXPECT_GT(place.corrected({0.1, 0.2})[4], 0.3);
}

TEST(SpatialPrior, WhatIsCertainStaysAndIsNoNeighbour) {
    Place place(1, 5);
    place.add(0, 0, 0);
    place.add(0, 2, 0.5);
    place.add(0, 4, 1);
    EXPECT_EQ(place.corrected(half), (std::vector<double>{0, 0.5, 1}));
}

TEST(SpatialPrior, WhereNothingStands) {
    EXPECT_TRUE(Place(3, 3).corrected(half).empty());
}

TEST(SpatialPrior, TheSameOnAnyNumberOfThreads) {
    std::mt19937 random(7);
    Place place(700, 300);
    for (std::int32_t r = 0; r < 700; r += 2)
        for (std::int32_t c = 0; c < 300; c += 2)
            if (random() % 60 == 0)
                place.add(r, c, static_cast<double>(1 + random() % 98) / 100);
    Executor alone(1);
    const std::vector<double> one = place.corrected({0.3, 0.4}, alone);
    for (const int count : {2, 7}) {
        Executor several(count);
        EXPECT_EQ(place.corrected({0.3, 0.4}, several), one) << count;
    }
}

}  // namespace
}  // namespace d2b::detect
