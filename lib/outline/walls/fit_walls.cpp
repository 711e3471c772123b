#include "outline/walls/fit_walls.hpp"

#include <algorithm>

#include "outline/walls/wall_rounds.hpp"

namespace d2b {
namespace {

bool has_higher_levels(const WallCluster& cluster) {
    return std::ranges::any_of(cluster.contours,
                               [](const Contour* contour) { return contour->key.level > 1; });
}

}  // namespace

ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop) {
    ClusterOutlines result;
    WallRounds rounds(cluster, options, stop);
    rounds.settle();
    const DrawnOutlines drawn = rounds.outlines();
    const bool own_footprints = has_higher_levels(cluster);
    for (std::size_t i = 0; i < cluster.contours.size(); ++i) {
        stop.check();
        result.outlines.push_back(drawn.outline(i));
        if (own_footprints && cluster.contours[i]->key.level <= 1)
            result.footprints.push_back(drawn.footprint(i));
    }
    return result;
}

}  // namespace d2b
