#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trace/contour.hpp"
#include "trace/runs.hpp"

namespace d2b {

/// A contour while it grows: the connected runs found so far.
struct Component {
    std::uint32_t up = no_index;  ///< union-find; itself where it is a root
    std::uint32_t size = 1;
    std::uint32_t next_member = no_index;  ///< ring of all numbers that were united
    std::int32_t level = 0;
    std::int32_t last_row = 0;
    std::uint32_t place = no_index;  ///< in the list of what goes on beyond a band
    bool open_above = false;         ///< it may go on in rows above that are not known yet
    Label label = 0;
    LatticePoint first;
    std::uint32_t below = no_index;  ///< component one level down
    PointStats own;
    PointStats above;
    double lowest_outside = nothing_below;
    PackedRing exterior;
    std::vector<PackedRing> interiors;
    std::unique_ptr<ElevationSample> sample;   ///< level 1
    std::vector<std::int64_t> standing_on_it;  ///< finished contours, as the sink calls them

    static constexpr double nothing_below = std::numeric_limits<double>::infinity();
};

/// Union-find over the runs of all levels: no DisjointSets, since what a component holds is merged with it,
/// and the larger one stays; numbers are used again once a contour is finished, so that memory is bounded by
/// what is open.
class Components {
  public:
    /// @param range of the elevations that samples hold
    explicit Components(const ElevationRange& range) : range_(range) {}

    /// @return a component of one run
    std::uint32_t add(std::int32_t level, Label label, LatticePoint first, std::uint32_t below);
    /// @param found elsewhere; what it says of union-find is written anew
    /// @return a component that holds as much
    std::uint32_t add(Component&& found);
    std::uint32_t find(std::uint32_t component);
    /// @return the root of both
    std::uint32_t unite(std::uint32_t a, std::uint32_t b);
    Component& operator[](std::uint32_t component) { return pool_[component]; }

    /// Gives a finished root's numbers back. @return what it held
    FinishedContour finish(std::uint32_t root);

  private:
    std::uint32_t free_number();

    ElevationRange range_;
    std::vector<Component> pool_;
    std::uint32_t free_ = no_index;
};

}  // namespace d2b
