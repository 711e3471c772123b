#include "outline/walls/fit_walls.hpp"

#include <algorithm>
#include <utility>

#include "outline/walls/wall_rounds.hpp"

namespace d2b {
namespace {

std::vector<WallOutline> outlines_of(const WallRounds& rounds, std::size_t count, const StopRequest& stop) {
    std::vector<WallOutline> outlines;
    outlines.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        stop.check();
        outlines.push_back(rounds.outline(i));
    }
    return outlines;
}

WallCluster low_levels(const WallCluster& cluster) {
    const auto end =
        std::ranges::find_if(cluster.contours, [](const Contour* contour) { return contour->key.level > 1; });
    const auto count = end - cluster.contours.begin();
    return {{cluster.contours.begin(), end}, {cluster.parents.begin(), cluster.parents.begin() + count}};
}

}  // namespace

ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop) {
    ClusterOutlines result;
    // A wall knows nothing of what stands on it: low levels come first, and higher ones begin with them.
    const WallCluster low = low_levels(cluster);
    WallRounds rounds(cluster, options, stop);
    if (!low.contours.empty() && low.contours.size() < cluster.contours.size()) {
        WallRounds low_rounds(low, options, stop);
        low_rounds.settle();
        result.footprints = outlines_of(low_rounds, low.contours.size(), stop);
        rounds.adopt(std::move(low_rounds));
    }
    rounds.settle();
    result.outlines = outlines_of(rounds, cluster.contours.size(), stop);
    return result;
}

}  // namespace d2b
