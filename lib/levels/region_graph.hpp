#pragma once

#include <cstdint>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "core/disjoint_sets.hpp"

namespace d2b {

/// Region adjacency graph whose regions are merged, with their sums and the lengths of their common borders.
class RegionGraph {
  public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    struct Region {
        double points = 0;
        double sum = 0;   ///< sum of elevations
        double mean = 0;  ///< undefined without points

        void add(const Region& other) {
            points += other.points;
            sum += other.sum;
            mean = sum / points;
        }
    };
    /// Squared error added by merging two regions.
    [[nodiscard]] static double added_error(const Region& one, const Region& other) {
        if (one.points == 0 || other.points == 0)
            return 0;
        const double step = one.mean - other.mean;
        return one.points * other.points / (one.points + other.points) * step * step;
    }

    /// @param own_border border in cells that each region has in addition to its actual one
    explicit RegionGraph(std::vector<Region> regions, double own_border = 0);

    /// Adds a border. Repeated calls for the same two regions add up.
    /// @param length length in cells
    void add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(regions_.size()); }
    [[nodiscard]] std::uint32_t root(std::uint32_t region) { return sets_.find(region); }
    [[nodiscard]] bool is_root(std::uint32_t region) const { return sets_.stands(region); }
    [[nodiscard]] const Region& of(std::uint32_t root) const { return regions_[root]; }

    struct Neighbour {
        std::uint32_t region = none;
        double cost = 0;  ///< cost of merging: added squared error per length of the removed border,
                          ///< including a region's own one
    };
    /// Returns the cheapest neighbour to merge with; the lowest index in case of a tie. Cached until the
    /// region or a neighbour changes.
    [[nodiscard]] Neighbour cheapest(std::uint32_t root);
    /// @return the root of both
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

  private:
    struct Border {
        std::uint32_t region = none;
        std::uint32_t length = 0;
    };
    /// Cached cheapest neighbour, and the number of merges at that time; none if not cached.
    struct Cheapest {
        Neighbour neighbour;
        std::uint32_t merges = none;
    };
    [[nodiscard]] bool still_holds(std::uint32_t root) const;
    /// Merges the borders with the same neighbour.
    void gather(std::uint32_t root);

    /// Borders of a region. Most regions have few, which need no heap allocation: the average of a planar
    /// graph is below six.
    using Borders = boost::container::small_vector<Border, 10>;

    double own_border_;
    std::vector<Region> regions_;
    DisjointSets sets_;
    std::vector<Borders> borders_;
    std::vector<std::uint32_t>
        given_;  ///< number of borders as added, which determines the list that is moved
    std::vector<Cheapest> cheapest_;
    std::vector<std::uint32_t> changed_;  ///< number of merges when it last grew or was merged
    std::uint32_t merges_ = 0;
    std::vector<std::uint32_t> place_;  ///< scratch of gather(): index of a neighbour in the list of borders
};

}  // namespace d2b
