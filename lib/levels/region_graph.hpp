#pragma once

#include <cstdint>
#include <vector>

#include "core/disjoint_sets.hpp"

namespace d2b {

/// Regions that grow together: what they hold, and how long the borders between them are.
class RegionGraph {
  public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    struct Region {
        double points = 0;
        double sum = 0;  ///< of their elevations
    };
    /// Squared error that merging two adds.
    [[nodiscard]] static double added_error(const Region& one, const Region& other);

    explicit RegionGraph(std::vector<Region> regions);

    /// Also more than once for the same two: lengths add up. @param length in cells
    void add_border(std::uint32_t a, std::uint32_t b, double length);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(regions_.size()); }
    [[nodiscard]] std::uint32_t root(std::uint32_t region) { return sets_.find(region); }
    [[nodiscard]] const Region& of(std::uint32_t root) const { return regions_[root]; }

    struct Neighbour {
        std::uint32_t region = none;
        double cost = 0;  ///< of merging: squared error that is added a length of the border that goes
    };
    /// The neighbour that is cheapest to merge with; the one with the lowest number where two cost the same.
    [[nodiscard]] Neighbour cheapest(std::uint32_t root);
    /// @return the root of the two
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

  private:
    struct Border {
        std::uint32_t region = none;
        double length = 0;
    };
    /// Makes one border of all those with the same neighbour.
    void gather(std::uint32_t root);

    std::vector<Region> regions_;
    DisjointSets sets_;
    std::vector<std::vector<Border>> borders_;
    std::vector<std::uint32_t> place_;  ///< room of gather(): of a neighbour among the borders
};

}  // namespace d2b
