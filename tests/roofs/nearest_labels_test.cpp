#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "roofs/building_grid.hpp"

namespace d2b::roofs {
namespace {

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::set<std::int32_t> labels;  ///< of all cells at that distance
};

Nearest nearest_of(const std::vector<std::int32_t>& labels, int cols, int row, int col) {
    Nearest nearest;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] < 0)
            continue;
        const int rows = static_cast<int>(i) / cols - row;
        const int across = static_cast<int>(i) % cols - col;
        const double distance = std::sqrt(rows * rows + across * across);
        if (distance < nearest.distance)
            nearest = {distance, {}};
        if (distance == nearest.distance)
            nearest.labels.insert(labels[i]);
    }
    return nearest;
}

TEST(NearestLabels, AreThoseOfNoFartherCells) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const int rows = 1 + static_cast<int>(random() % 14);
        const int cols = 1 + static_cast<int>(random() % 14);
        std::vector<std::int32_t> labels;
        for (int i = 0; i < rows * cols; ++i)
            labels.push_back(random() % 9 == 0 ? static_cast<std::int32_t>(random() % 5) : -1);
        const NearestLabels found = nearest_labels(labels, rows, cols);
        for (int row = 0; row < rows; ++row)
            for (int col = 0; col < cols; ++col) {
                const auto i = static_cast<std::size_t>(row * cols + col);
                const Nearest nearest = nearest_of(labels, cols, row, col);
                EXPECT_FLOAT_EQ(found.distances[i], static_cast<float>(nearest.distance));
                if (nearest.labels.empty())
                    EXPECT_EQ(found.labels[i], -1);
                else
                    EXPECT_TRUE(nearest.labels.contains(found.labels[i])) << row << ' ' << col;
                if (labels[i] >= 0) {
                    EXPECT_EQ(found.labels[i], labels[i]);
                }
            }
    }
}

}  // namespace
}  // namespace d2b::roofs
