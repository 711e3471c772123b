#include "features/surface_cluster.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

/// Blocks of 100 by 100 steps, one beside the other, that stand at 1 m.
SurfaceCluster blocks(const std::vector<std::int64_t>& tops) {
    SurfaceCluster cluster;
    for (const std::int64_t top : tops) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        const std::int64_t left = 100 * building;
        cluster.contours.push_back(
            {{{{0, left}, {0, left + 100}, {-100, left + 100}, {-100, left}}, {}}, -1, building, top});
        cluster.buildings.push_back({building + 1, 1000});
    }
    return cluster;
}

std::vector<std::int64_t> tops(const SurfaceCluster& cluster) {
    std::vector<std::int64_t> tops;
    for (const PartitionContour& contour : cluster.contours)
        tops.push_back(contour.top);
    return tops;
}

/// 10 m on 9,950 square steps are as much as 10.05 m on what is left of 10,000 of them.
TEST(FitRoofs, keepsTheVolumeThatPinchesTake) {
    SurfaceCluster cluster = blocks({11000, 21000});
    EXPECT_TRUE(preserve_volumes({9950, 10020}, cluster));
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{11050, 20960}));
}

/// What a height in millimetres cannot say, what is not made, and what has another form by now.
TEST(FitRoofs, leavesOthersAlone) {
    SurfaceCluster cluster = blocks({11000, 11000, 11000, 11000});
    EXPECT_FALSE(preserve_volumes({10000, 9999, 0, 5000}, cluster));
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>(4, 11000)));
}

}  // namespace
}  // namespace d2b
