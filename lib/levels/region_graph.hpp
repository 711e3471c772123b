#pragma once

#include <cstdint>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "core/disjoint_sets.hpp"

namespace d2b {

/// Regions that grow together: what they hold, and how long the borders between them are.
class RegionGraph {
  public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    struct Region {
        double points = 0;
        double sum = 0;   ///< of their elevations
        double mean = 0;  ///< of no meaning where there is no point

        void add(const Region& other) {
            points += other.points;
            sum += other.sum;
            mean = sum / points;
        }
    };
    /// Squared error that merging two adds.
    [[nodiscard]] static double added_error(const Region& one, const Region& other) {
        if (one.points == 0 || other.points == 0)
            return 0;
        const double step = one.mean - other.mean;
        return one.points * other.points / (one.points + other.points) * step * step;
    }

    /// @param own_border of each region beside that which it has, in cells
    explicit RegionGraph(std::vector<Region> regions, double own_border = 0);

    /// Also more than once for the same two: lengths add up. @param length in cells
    void add_border(std::uint32_t a, std::uint32_t b, std::uint32_t length);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(regions_.size()); }
    [[nodiscard]] std::uint32_t root(std::uint32_t region) { return sets_.find(region); }
    [[nodiscard]] bool is_root(std::uint32_t region) const { return sets_.stands(region); }
    [[nodiscard]] const Region& of(std::uint32_t root) const { return regions_[root]; }

    struct Neighbour {
        std::uint32_t region = none;
        double cost = 0;  ///< of merging: squared error that is added a length of the border that goes, a
                          ///< region's own included
    };
    /// The neighbour that is cheapest to merge with; the one with the lowest number where two cost the same.
    /// Found anew only where the region or one beside it has changed since it was asked for last.
    [[nodiscard]] Neighbour cheapest(std::uint32_t root);
    /// @return the root of the two
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

  private:
    struct Border {
        std::uint32_t region = none;
        std::uint32_t length = 0;
    };
    /// What was cheapest, and after how many merges; none where it was not asked for.
    struct Cheapest {
        Neighbour neighbour;
        std::uint32_t merges = none;
    };
    [[nodiscard]] bool still_holds(std::uint32_t root) const;
    /// Makes one border of all those with the same neighbour.
    void gather(std::uint32_t root);

    /// Borders of a region: most have few, which need no memory of their own. A plane has six on the average.
    using Borders = boost::container::small_vector<Border, 10>;

    double own_border_;
    std::vector<Region> regions_;
    DisjointSets sets_;
    std::vector<Borders> borders_;
    std::vector<std::uint32_t> given_;  ///< borders as they were given: what says which of two lists moves
    std::vector<Cheapest> cheapest_;
    std::vector<std::uint32_t> changed_;  ///< after how many merges it last grew, or went into another
    std::uint32_t merges_ = 0;
    std::vector<std::uint32_t> place_;  ///< room of gather(): of a neighbour among the borders
};

}  // namespace d2b
