#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect/priors.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

constexpr PriorShare half{0.5, 0.5};

/// Objects of one cell of a metre each, and what is thought of them.
struct Place {
    Place(std::int32_t rows, std::int32_t cols) : cells(rows, cols) {}

    /// In scan order.
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
        return corrected(prior, test::threads());
    }

    Mask cells;
    std::vector<DetectedObject> objects;
};

TEST(CorrectForNeighbours, BayesRuleWithTheShareAround) {
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

TEST(CorrectForNeighbours, HousesAmongHousesAndCrownsAmongCrowns) {
    Place place(600, 30);
    for (std::int32_t r = 0; r < 600; r += 20)
        place.add(r, r % 30, r == 100 || r == 500 ? 0.5 : r < 300 ? 0.9 : 0.1);
    const std::vector<double> now = place.corrected(half);
    EXPECT_GT(now[5], 0.75);
    EXPECT_LT(now[25], 0.25);
}

TEST(CorrectForNeighbours, AShareWithinWhatIsSupposedChangesNothing) {
    Place place(10, 100);
    for (std::int32_t c = 0; c < 100; c += 10)
        place.add(5, c, 0.3);
    EXPECT_EQ(place.corrected({0.2, 0.6}), std::vector<double>(10, 0.3));
    EXPECT_LT(place.corrected({0.4, 0.6})[4], 0.3);
    EXPECT_GT(place.corrected({0.1, 0.2})[4], 0.3);
}

TEST(CorrectForNeighbours, WhatIsCertainStaysAndIsNoNeighbour) {
    Place place(1, 5);
    place.add(0, 0, 0);
    place.add(0, 2, 0.5);
    place.add(0, 4, 1);
    EXPECT_EQ(place.corrected(half), (std::vector<double>{0, 0.5, 1}));
}

TEST(CorrectForNeighbours, WhereNothingStands) {
    EXPECT_TRUE(Place(3, 3).corrected(half).empty());
}

TEST(CorrectForWitnesses, BayesRuleWithTheShareOfOthersAlone) {
    Candidates reference_objects;
    reference_objects.regions = connected_regions(test::drawn({"#...#"}), 1, 0, test::threads());
    reference_objects.objects = {{0.9, CounterEvidence::rough, 1},
                                 {1, CounterEvidence::rough, 1}};  // what is certain is no witness
    Candidates judged;
    judged.regions = connected_regions(test::drawn({"..#.#"}), 1, 0, test::threads());
    judged.objects = {{0.6, CounterEvidence::rough, 1}, {0, CounterEvidence::rough, 1}};
    const CellSize cell{37.5, 37.5};
    apply_reference_prior(reference_objects, cell, half, judged, test::threads());
    const double weight = 0.75 * 0.75;  // half of the reach away
    const double share = (0.5 + weight * 0.9) / (1 + weight);
    const double odds = 0.6 / 0.4 * share / (1 - share);
    EXPECT_NEAR(judged.objects[0].confidence, odds / (1 + odds), 1e-12);
    EXPECT_EQ(judged.objects[1].confidence, 0);
    EXPECT_EQ(reference_objects.objects[0].confidence, 0.9);
}

TEST(CorrectForWitnesses, WhereThereIsNone) {
    Candidates reference_objects;
    reference_objects.regions = connected_regions(test::drawn({"..."}), 1, 0, test::threads());
    Candidates judged;
    judged.regions = connected_regions(test::drawn({"#.#"}), 1, 0, test::threads());
    judged.objects = {{0.6, CounterEvidence::rough, 1}, {0.8, CounterEvidence::rough, 1}};
    apply_reference_prior(reference_objects, {1, 1}, half, judged, test::threads());
    EXPECT_NEAR(judged.objects[0].confidence, 0.6, 1e-12);
    EXPECT_NEAR(judged.objects[1].confidence, 0.8, 1e-12);
}

TEST(CorrectForNeighbours, TheSameOnAnyNumberOfThreads) {
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
}  // namespace d2b
