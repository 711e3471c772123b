#include "detect/neighbour_prior.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

constexpr SupposedShare half{0.5, 0.5};

/// Objects of one cell of a metre each, and what is thought of them.
struct Place {
    Place(std::int32_t rows, std::int32_t cols) : cells(rows, cols) {}

    /// In scan order.
    void add(std::int32_t r, std::int32_t c, double confidence) {
        cells.at(r, c) = 1;
        objects.push_back({confidence, Doubt::rough, 1});
    }
    [[nodiscard]] std::vector<double> corrected(const SupposedShare& supposed, Executor& threads) const {
        std::vector<DetectedObject> result = objects;
        correct_for_neighbours(connected_regions(cells, 1, 0, threads), {1, 1}, supposed, result, threads);
        std::vector<double> confidences;
        for (const DetectedObject& object : result)
            confidences.push_back(object.confidence);
        return confidences;
    }
    [[nodiscard]] std::vector<double> corrected(const SupposedShare& supposed) const {
        return corrected(supposed, test::threads());
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
    JudgedObjects witnesses;
    witnesses.regions = connected_regions(test::drawn({"#...#"}), 1, 0, test::threads());
    witnesses.objects = {{0.9, Doubt::rough, 1}, {1, Doubt::rough, 1}};  // what is certain is no witness
    JudgedObjects judged;
    judged.regions = connected_regions(test::drawn({"..#.#"}), 1, 0, test::threads());
    judged.objects = {{0.6, Doubt::rough, 1}, {0, Doubt::rough, 1}};
    const CellSize cell{37.5, 37.5};
    correct_for_witnesses(witnesses, cell, half, judged, test::threads());
    const double weight = 0.75 * 0.75;  // half of the reach away
    const double share = (0.5 + weight * 0.9) / (1 + weight);
    const double odds = 0.6 / 0.4 * share / (1 - share);
    EXPECT_NEAR(judged.objects[0].confidence, odds / (1 + odds), 1e-12);
    EXPECT_EQ(judged.objects[1].confidence, 0);
    EXPECT_EQ(witnesses.objects[0].confidence, 0.9);
}

TEST(CorrectForWitnesses, WhereThereIsNone) {
    JudgedObjects witnesses;
    witnesses.regions = connected_regions(test::drawn({"..."}), 1, 0, test::threads());
    JudgedObjects judged;
    judged.regions = connected_regions(test::drawn({"#.#"}), 1, 0, test::threads());
    judged.objects = {{0.6, Doubt::rough, 1}, {0.8, Doubt::rough, 1}};
    correct_for_witnesses(witnesses, {1, 1}, half, judged, test::threads());
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
