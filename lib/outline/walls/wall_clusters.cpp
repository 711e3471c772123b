#include "outline/walls/wall_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/for_rings.hpp"
#include "core/grouped_indices.hpp"

namespace d2b::outline {
namespace {

/// Half-open range of lattice rows.
struct RowRange {
    std::int64_t begin;
    std::int64_t end;
};

/// Edges of traces in a grid of square buckets, limited to a range of rows.
class TraceEdgeGrid {
  public:
    TraceEdgeGrid(LatticePoint reach, RowRange rows) : reach_(reach), rows_(rows) {}

    void add(const contours::Contour& contour, std::uint32_t number);
    /// Joins the groups of edges that are near each other.
    void join(DisjointSets& groups);

  private:
    struct Edge {
        LatticeBox box;  // buffered, so that the boxes of near edges overlap
        std::uint32_t contour;
    };
    void add(const PackedRing& packed, std::uint32_t number);
    void build();
    template <typename Visit>
    void for_each_bucket(const LatticeBox& box, const Visit& visit) const {
        for (std::int64_t row = bucket(box.low.row, low_.row); row <= bucket(box.high.row, low_.row); ++row)
            for (std::int64_t col = bucket(box.low.col, low_.col); col <= bucket(box.high.col, low_.col);
                 ++col)
                visit(static_cast<std::size_t>(row * columns_ + col));
    }
    [[nodiscard]] std::int64_t bucket(std::int32_t at, std::int32_t low) const {
        return (static_cast<std::int64_t>(at) - low) >> shift_;
    }
    void join_bucket(std::span<const std::uint32_t> edges, DisjointSets& groups) const;

    LatticePoint reach_;
    RowRange rows_;
    std::vector<Edge> edges_;
    LatticePoint low_{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
    LatticePoint high_{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
    int shift_ = 4;
    std::int64_t columns_ = 0;
    GroupedIndices in_bucket_;  // edges
};

/// Bounding box of an edge, buffered by half the conflict distance on each side.
LatticeBox buffered(LatticePoint from, LatticePoint to, LatticePoint reach) {
    return {
        {std::min(from.row, to.row) - reach.row / 2, std::min(from.col, to.col) - reach.col / 2},
        {std::max(from.row, to.row) + (reach.row + 1) / 2, std::max(from.col, to.col) + (reach.col + 1) / 2}};
}

void TraceEdgeGrid::add(const contours::Contour& contour, std::uint32_t number) {
    for_rings(contour, [&](const PackedRing& ring) { add(ring, number); });
}

void TraceEdgeGrid::add(const PackedRing& packed, std::uint32_t number) {
    const LatticeRing ring = packed.corners();
    LatticePoint from = ring.back();
    for (const LatticePoint to : ring) {
        const LatticeBox box = buffered(from, to, reach_);
        from = to;
        if (box.high.row < rows_.begin || box.low.row >= rows_.end)
            continue;
        low_ = {std::min(low_.row, box.low.row), std::min(low_.col, box.low.col)};
        high_ = {std::max(high_.row, box.high.row), std::max(high_.col, box.high.col)};
        edges_.push_back({box, number});
    }
}

void TraceEdgeGrid::build() {
    const auto buckets = [&] {
        columns_ = bucket(high_.col, low_.col) + 1;
        return (bucket(high_.row, low_.row) + 1) * columns_;
    };
    // A few edges far from each other need large buckets.
    while (buckets() > 64 + 16 * static_cast<std::int64_t>(edges_.size()))
        ++shift_;
    in_bucket_ = GroupedIndices(static_cast<std::size_t>(buckets()), [&](const auto& add) {
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            for_each_bucket(edges_[e].box, [&](std::size_t b) { add(b, e); });
    });
}

void TraceEdgeGrid::join_bucket(std::span<const std::uint32_t> edges, DisjointSets& groups) const {
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const Edge& edge = edges_[edges[i]];
        std::uint32_t last = edge.contour;  // consecutive entries mostly belong to one contour
        for (const std::uint32_t before : edges.first(i)) {
            const Edge& other = edges_[before];
            if (other.contour == last || !edge.box.overlaps(other.box))
                continue;
            last = other.contour;
            groups.join(edge.contour, other.contour);
        }
    }
}

void TraceEdgeGrid::join(DisjointSets& groups) {
    if (edges_.empty())
        return;
    build();
    for (std::size_t b = 0; b < in_bucket_.size(); ++b) {
        const std::span<const std::uint32_t> edges = in_bucket_[b];
        const auto group = [&](std::uint32_t e) { return groups.find(edges_[e].contour); };
        // Most buckets hold edges of a single group.
        if (std::ranges::any_of(edges, [&](std::uint32_t e) { return group(e) != group(edges.front()); }))
            join_bucket(edges, groups);
    }
}

/// Only traces of levels 0 and 1 can be near those of other groups, because higher levels lie within them.
bool is_low(const contours::ContourHead& head) {
    return head.key.level <= 1 || head.parent < 0;
}

/// Joins contours that are near each other, one strip of rows at a time.
void join_neighbours(const contours::ContourList& contours, const WallOptions& options,
                     std::int64_t rows_per_strip, DisjointSets& groups, const StopToken& stop) {
    const LatticePoint reach = conflict_distance(options);
    const auto first_row = [&](std::uint32_t i) {
        return std::int64_t{contours.head(i).key.first.row} - reach.row;
    };
    std::vector<std::uint32_t> low;
    for (std::uint32_t i = 0; i < contours.size(); ++i)
        if (is_low(contours.head(i)))
            low.push_back(i);
    std::ranges::stable_sort(low, {}, first_row);
    std::vector<std::uint32_t> open;  // contours that extend below the strips processed so far
    auto next = low.begin();
    for (std::int64_t row = low.empty() ? 0 : first_row(low.front()); next != low.end() || !open.empty();
         row += rows_per_strip) {
        const RowRange rows{row, row + rows_per_strip};
        TraceEdgeGrid buckets(reach, rows);
        std::vector<std::uint32_t> still_open;
        const auto add = [&](std::uint32_t i) {
            stop.check();
            const contours::Contour contour = contours.fetch(i);
            buckets.add(contour, i);
            if (contour.exterior.box().high.row + reach.row >= rows.end)
                still_open.push_back(i);
        };
        std::ranges::for_each(open, add);
        for (; next != low.end() && first_row(*next) < rows.end; ++next)
            add(*next);
        open = std::move(still_open);
        buckets.join(groups);
    }
}

}  // namespace

LatticePoint conflict_distance(const WallOptions& options) {
    const double cell = std::abs(cross(options.shape.col, options.shape.row));
    const auto steps = [&](Vec2 other) {
        return static_cast<std::int32_t>(std::floor(2 * options.tolerance * length(other) / cell)) + 1;
    };
    return {steps(options.shape.col), steps(options.shape.row)};
}

std::vector<ClusterPlan> wall_clusters(const contours::ContourList& contours, const WallOptions& options,
                                       const StopToken& stop, std::int64_t rows_per_strip) {
    DisjointSets groups(static_cast<std::uint32_t>(contours.size()));
    for (std::uint32_t i = 0; i < contours.size(); ++i)
        if (!is_low(contours.head(i)))
            groups.join(i, static_cast<std::uint32_t>(contours.head(i).parent));
    join_neighbours(contours, options, rows_per_strip, groups, stop);
    constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> cluster_of(contours.size(), nowhere);
    std::vector<std::int32_t> place(contours.size());
    std::vector<ClusterPlan> clusters;
    for (std::uint32_t i = 0; i < contours.size(); ++i) {
        const std::uint32_t group = groups.find(i);  // smallest index of the group
        if (group == i) {
            cluster_of[i] = static_cast<std::uint32_t>(clusters.size());
            clusters.emplace_back();
        }
        cluster_of[i] = cluster_of[group];
        ClusterPlan& cluster = clusters[cluster_of[i]];
        const std::int64_t parent = contours.head(i).parent;
        const bool with_parent = parent >= 0 && cluster_of[static_cast<std::size_t>(parent)] == cluster_of[i];
        place[i] = static_cast<std::int32_t>(cluster.numbers.size());
        cluster.numbers.push_back(i);
        cluster.parents.push_back(with_parent ? place[static_cast<std::size_t>(parent)] : -1);
    }
    return clusters;
}

WallCluster fetch_cluster(const contours::ContourList& contours, const ClusterPlan& plan,
                          const StopToken& stop) {
    WallCluster cluster;
    cluster.contours.reserve(plan.numbers.size());
    cluster.tiers.reserve(plan.numbers.size());
    for (const std::uint32_t number : plan.numbers) {
        stop.check();
        cluster.contours.push_back(contours.fetch(number));
        cluster.tiers.push_back(contours.head(number).tier_z);
    }
    cluster.parents = plan.parents;
    return cluster;
}

}  // namespace d2b::outline
