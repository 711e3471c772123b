#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect/priors.hpp"

namespace d2b {
namespace {

constexpr double usual = 0.62;

double normal_density(double x, double mean) {
    return std::exp(-(x - mean) * (x - mean) / 2);
}

/// Candidates of which so many are buildings: what is seen of them is normal about 1, of others about -1.
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

/// So many of a confidence beyond doubt, of one above a half, and of one below.
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

TEST(CorrectForPlace, AHundredCandidatesAndAFifthBeyondDoubt) {
    EXPECT_TRUE(is_changed(place(20, 20, 60)));
    EXPECT_FALSE(is_changed(place(20, 20, 59)));
    EXPECT_TRUE(is_changed(place(20, 80, 60)));
    EXPECT_FALSE(is_changed(place(20, 81, 60))) << "roofs do not look here as elsewhere";
    EXPECT_TRUE(is_changed(place(0, 0, 100))) << "a wood";
}

TEST(CorrectForPlace, NotWherePointsAreThin) {
    for (const double filled : {0.1, 0.11}) {
        std::vector<DetectedObject> objects = place(40, 40, 920);
        apply_scene_prior(filled, objects);
        EXPECT_EQ(objects.back().confidence != 0.15, filled == 0.1) << filled;
    }
}

TEST(CorrectForPlace, AmongWoodsLessIsABuilding) {
    std::vector<DetectedObject> objects = place(40, 40, 920);
    apply_scene_prior(0, objects);
    EXPECT_LT(objects[40].confidence, 0.3);
    EXPECT_GT(objects[0].confidence, 0.95);
    EXPECT_LT(objects.back().confidence, 0.05);
}

TEST(CorrectForPlace, NothingIsMoreCertainThanElsewhere) {
    EXPECT_FALSE(is_changed(place(400, 40, 20)));
}

TEST(CorrectForPlace, EvenOddsStayEvenAtTheUsualShare) {
    // All but one candidate are as good as certain; a hair fewer of them than usual are buildings.
    std::vector<DetectedObject> objects = place(6190, 0, 3810);
    for (DetectedObject& object : objects)
        object.confidence = object.confidence > 0.5 ? 1 - 1e-9 : 1e-9;
    objects.push_back({0.5, CounterEvidence::rough, 100});
    apply_scene_prior(0, objects);
    EXPECT_NE(objects.back().confidence, 0.5);
    EXPECT_NEAR(objects.back().confidence, 0.5, 2e-3);
}

TEST(CorrectForPlace, SaysWhatShareConfidencesSupposeThen) {
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

TEST(CorrectForPlace, SaysWhetherBuildingsLookedAsElsewhereBefore) {
    std::vector<DetectedObject> woods = place(40, 40, 920);
    EXPECT_TRUE(apply_scene_prior(0, woods).usual_appearance);
    std::vector<DetectedObject> few = place(1, 4, 0);
    EXPECT_TRUE(apply_scene_prior(0, few).usual_appearance);
    few = place(1, 5, 0);
    EXPECT_FALSE(apply_scene_prior(0, few).usual_appearance);
}

TEST(LooksAsElsewhere, AFifthOfTheLikelyAreBeyondDoubt) {
    EXPECT_TRUE(has_usual_appearance({}));
    EXPECT_TRUE(has_usual_appearance(place(1, 4, 50)));
    EXPECT_FALSE(has_usual_appearance(place(1, 5, 0)));
}

TEST(HardlyAnyIsSure, LessThanATenthOfTheLikelyButForOne) {
    EXPECT_TRUE(lacks_certain_buildings({}));
    EXPECT_TRUE(lacks_certain_buildings(place(1, 0, 50))) << "one may be so by chance";
    EXPECT_FALSE(lacks_certain_buildings(place(2, 8, 50)));
    EXPECT_TRUE(lacks_certain_buildings(place(2, 9, 50)));
}

TEST(CorrectForPlace, SingleTreesOfFieldsAreNoHouses) {
    // Thirty trees, five of which look like small houses. The likelihood ratios of 0.55 and 0.15 are 0.8117
    // and 0.05404. One candidate with the usual share is added.
    std::vector<DetectedObject> trees = place(0, 5, 25);
    std::vector<DetectedObject> others = objects_of({0, 0.55, 1});
    const PriorShare prior = apply_scene_prior(0.2, trees, others);
    const double estimated = prior.most / 2.5;
    double sum = usual;
    for (const double ratio : {0.8117, 0.05404})
        sum += (ratio > 0.5 ? 5 : 25) * estimated * ratio / (estimated * ratio + 1 - estimated);
    EXPECT_NEAR(sum / 31, estimated, 1e-5);
    const double change = prior.most / (1 - prior.most) * (1 - usual) / usual;
    const double changed = 0.55 / 0.45 * change / (1 + 0.55 / 0.45 * change);
    EXPECT_NEAR(trees[0].confidence, changed, 1e-9);
    EXPECT_LT(changed, 0.1);
    EXPECT_EQ(others[0].confidence, 0);
    EXPECT_EQ(others[1].confidence, trees[0].confidence);
    EXPECT_EQ(others[2].confidence, 1);
}

TEST(CorrectForPlace, AFewDoubtsAreNoFields) {
    for (std::vector<DetectedObject> objects : {place(0, 1, 0), place(0, 2, 1), place(2, 3, 25)}) {
        const std::vector<DetectedObject> before = objects;
        apply_scene_prior(0.2, objects);
        for (std::size_t i = 0; i < objects.size(); ++i)
            EXPECT_EQ(objects[i].confidence, before[i].confidence);
    }
}

TEST(CorrectForPlace, KeepsTheOrderAndWhatIsCertain) {
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

}  // namespace
}  // namespace d2b
