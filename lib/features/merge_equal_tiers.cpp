#include "features/merge_equal_tiers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "outline/fine_geometry.hpp"

namespace d2b {
namespace {

Int128 twice_area(const FineRing& ring) {
    Int128 sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += turn(ring[0], ring[i], ring[i + 1]);
    return sum < 0 ? -sum : sum;
}

Int128 twice_area(const FinePolygon& polygon) {
    Int128 sum = twice_area(polygon.exterior);
    for (const FineRing& interior : polygon.interiors)
        sum -= twice_area(interior);
    return sum;
}

class TierMerger {
  public:
    explicit TierMerger(DrawnCluster& drawn) : drawn_(drawn), contours_(drawn.cluster.contours) {
        for (std::size_t i = 0; i < contours_.size(); ++i) {
            into_.push_back(i);
            is_raised_.push_back(false);
        }
    }

    void merge() {
        merge_equal();
        merge_what_is_covered();
        drop_merged();
    }

  private:
    /// Returns the tier below, after all merges so far.
    [[nodiscard]] std::size_t below(std::size_t tier) const {
        auto lower = static_cast<std::size_t>(contours_[tier].parent);
        while (into_[lower] != lower)
            lower = into_[lower];
        return lower;
    }
    void merge_equal();
    void merge_what_is_covered();
    void drop_merged();

    DrawnCluster& drawn_;
    std::vector<PlanContour>& contours_;
    std::vector<std::size_t> into_;  ///< tier that each one has been merged into
    std::vector<bool> is_raised_;
};

/// Compares each tier with the outline that would remain, because otherwise small losses could accumulate.
void TierMerger::merge_equal() {
    std::vector<Int128> areas;
    for (const PlanContour& contour : contours_)
        areas.push_back(twice_area(contour.outline));
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (contours_[i].parent < 0)
            continue;
        const std::size_t lower = below(i);
        if (areas[i] * 1000 < areas[lower] * 999)
            continue;
        into_[i] = lower;
        is_raised_[lower] = true;
        contours_[lower].top = std::max(contours_[lower].top, contours_[i].top);
    }
}

void TierMerger::merge_what_is_covered() {
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (contours_[i].parent < 0 || into_[i] != i)
            continue;
        const std::size_t lower = below(i);
        if (is_raised_[lower] && contours_[i].top <= contours_[lower].top)
            into_[i] = lower;
    }
}

void TierMerger::drop_merged() {
    std::vector<std::int32_t> place(contours_.size());
    std::vector<PlanContour> stay;
    std::vector<std::int32_t> levels;
    for (std::size_t i = 0; i < contours_.size(); ++i) {
        if (into_[i] != i)
            continue;
        place[i] = static_cast<std::int32_t>(stay.size());
        const std::int32_t parent = contours_[i].parent < 0 ? -1 : place[below(i)];
        stay.push_back(std::move(contours_[i]));
        stay.back().parent = parent;
        levels.push_back(drawn_.levels[i]);
    }
    contours_ = std::move(stay);
    drawn_.levels = std::move(levels);
}

}  // namespace

void merge_equal_tiers(DrawnCluster& drawn) {
    TierMerger(drawn).merge();
}

}  // namespace d2b
