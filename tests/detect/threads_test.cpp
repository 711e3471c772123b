#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "detect/detection.hpp"
#include "options/run_plan.hpp"

namespace d2b {
namespace {

/// Houses with gables and steps, and trees, on level ground; some points are missing.
MetreGrid city(std::int32_t rows, std::int32_t cols) {
    std::mt19937 random(23);
    const auto below = [&](std::int32_t limit) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(limit));
    };
    MetreGrid surface(rows, cols, 50.0F);
    for (int house = 0; house < rows * cols / 1500; ++house) {
        const std::int32_t row = below(rows), col = below(cols), depth = 6 + below(20),
                           length = 6 + below(60);
        const auto height = static_cast<float>(50 + 3 + below(12));
        for (std::int32_t i = row; i < std::min(rows, row + depth); ++i)
            for (std::int32_t j = col; j < std::min(cols, col + length); ++j)
                surface.at(i, j) = height + 0.4F * static_cast<float>(std::min(i - row, row + depth - i));
    }
    for (float& z : surface.values) {
        z += static_cast<float>(below(100)) / 800;
        if (below(12) == 0)
            z += static_cast<float>(below(9));
        if (below(90) == 0)
            z = std::nanf("");
    }
    return surface;
}

struct Case {
    double cell;
    double split_height;
};

TEST(DetectionThreads, TheirNumberDoesNotShow) {
    const MetreGrid surface = city(1100, 1700);
    const MetreGrid terrain(1100, 1700, 50.0F);
    MetreGrid ndvi(1100, 1700, 0.1F);
    for (std::size_t i = 0; i < ndvi.size(); i += 7)
        ndvi.values[i] = 0.5F;
    for (const Case& now : {Case{1, 0}, Case{0.5, 2}}) {
        const Scene scene{surface, terrain, {now.cell, now.cell}, nullptr, &ndvi};
        DetectOptions options;
        options.split_height = now.split_height;
        Context one;
        const Detection expected = detect_buildings(scene, options, default_min_building_m2, one);
        EXPECT_GT(expected.buildings, 100U);
        for (const int count : {2, 5}) {
            Context context;
            context.threads = std::make_unique<Executor>(count);
            const Detection found = detect_buildings(scene, options, default_min_building_m2, context);
            EXPECT_TRUE(found.labels.values == expected.labels.values) << count;
            EXPECT_EQ(found.buildings, expected.buildings);
            EXPECT_TRUE(std::equal(
                found.objects.begin(), found.objects.end(), expected.objects.begin(), expected.objects.end(),
                [](const DetectedObject& a, const DetectedObject& b) {
                    return a.confidence == b.confidence && a.doubt == b.doubt && a.cells == b.cells;
                }));
        }
    }
}

}  // namespace
}  // namespace d2b
