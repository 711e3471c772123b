#include "outline/walls.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "outline/noding.hpp"

namespace d2b {

RegularOutlines::RegularOutlines(const std::vector<Contour>& contours, const WallOptions& options,
                                 Executor& executor)
    : clusters_(wall_clusters(contours, options)),
      cluster_of_(contours.size()),
      outlines_(contours.size()),
      own_footprint_(contours.size()) {
    const auto high = std::ranges::find_if(contours, [](const Contour& c) { return c.key.level > 1; });
    footprints_.resize(static_cast<std::size_t>(high - contours.begin()));
    for (std::uint32_t c = 0; c < clusters_.size(); ++c)
        for (const std::uint32_t contour : clusters_[c].numbers)
            cluster_of_[contour] = c;
    // The largest first, so that no thread begins with one when the others are done.
    std::vector<std::uint32_t> order(clusters_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return clusters_[a].contours.size() > clusters_[b].contours.size();
    });
    executor.for_each(order.size(), [&](std::size_t i) {
        const WallCluster& cluster = clusters_[order[i]];
        keep(cluster, fit_walls(cluster, options));
    });
}

void RegularOutlines::keep(const WallCluster& cluster, const ClusterOutlines& fitted) {
    const auto kept = [](const WallOutline& outline) {
        return Kept{PackedOutline(outline.polygon), outline.quality};
    };
    for (std::size_t i = 0; i < cluster.numbers.size(); ++i)
        outlines_[cluster.numbers[i]] = kept(fitted.outlines[i]);
    for (std::size_t i = 0; i < fitted.footprints.size(); ++i) {
        footprints_[cluster.numbers[i]] = kept(fitted.footprints[i]);
        own_footprint_[cluster.numbers[i]] = 1;
    }
}

FinePolygon RegularOutlines::traced(std::size_t contour) const {
    const WallCluster& cluster = clusters_[cluster_of_[contour]];
    const auto place = std::ranges::lower_bound(cluster.numbers, static_cast<std::uint32_t>(contour));
    const Contour& own = *cluster.contours[static_cast<std::size_t>(place - cluster.numbers.begin())];
    return fine(CornerIndex(cluster.contours).noded(traced_polygon(own)));
}

}  // namespace d2b
