#include "outline/walls/regular_outlines.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "outline/packed_outline.hpp"

namespace d2b {

RegularOutlines::RegularOutlines(const ContourList& contours, const WallOptions& options,
                                 std::unique_ptr<Spool> spool, Executor& executor)
    : contours_(contours),
      spool_(std::move(spool)),
      clusters_(wall_clusters(contours, options, executor.stop())),
      cluster_of_(contours.size()),
      outlines_(contours.size()),
      large_clusters_(std::make_unique<LargeClusters>()) {
    std::size_t low = 0;
    while (low < contours.size() && contours.head(low).key.level <= 1)
        ++low;
    footprints_.resize(low);
    for (std::uint32_t c = 0; c < clusters_.size(); ++c)
        for (const std::uint32_t contour : clusters_[c].numbers)
            cluster_of_[contour] = c;
    // Process the largest clusters first, so that no thread starts one when the others are done.
    std::vector<std::uint32_t> order(clusters_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return clusters_[a].numbers.size() > clusters_[b].numbers.size();
    });
    executor.for_each(order.size(), [&](std::size_t i) {
        const ClusterPlan& plan = clusters_[order[i]];
        const FetchedCluster fetched(contours, plan, executor.stop());
        const ClusterOutlines fitted = fit_walls(fetched.cluster(), options, executor.stop());
        for (std::size_t k = 0; k < plan.numbers.size(); ++k)
            outlines_[plan.numbers[k]] = keep(fitted.outlines[k]);
        for (std::size_t k = 0; k < fitted.footprints.size(); ++k)
            footprints_[plan.numbers[k]] = keep(fitted.footprints[k]);
    });
}

RegularOutlines::Kept RegularOutlines::keep(const WallOutline& outline) {
    ByteWriter writer;
    save(outline.polygon, writer);
    return {append(*spool_, writer), outline.quality};
}

FinePolygon RegularOutlines::fetch(const Kept& kept) const {
    return load_outline(*spool_, kept.place);
}

std::shared_ptr<const CornerIndex> RegularOutlines::corners(std::uint32_t cluster) const {
    constexpr std::size_t large = 64;  // contours
    {
        const std::lock_guard lock(large_clusters_->mutex);
        if (const auto known = large_clusters_->corners.find(cluster);
            known != large_clusters_->corners.end())
            return known->second;
    }
    // Several threads may build the same index, because waiting for each other would take longer.
    const FetchedCluster fetched(contours_, clusters_[cluster]);
    auto made = std::make_shared<const CornerIndex>(fetched.cluster().contours);
    if (clusters_[cluster].numbers.size() < large)
        return made;
    const std::lock_guard lock(large_clusters_->mutex);
    return large_clusters_->corners.try_emplace(cluster, made).first->second;
}

FinePolygon RegularOutlines::traced(std::size_t contour) const {
    return fine(corners(cluster_of_[contour])->noded(traced_polygon(contours_.fetch(contour))));
}

}  // namespace d2b
