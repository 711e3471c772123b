#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "contours/contour.hpp"
#include "contours/runs.hpp"

namespace d2b::contours {

/// Connected component of runs: a contour that is still growing.
struct Component {
    std::uint32_t up = no_index;  ///< union-find parent; a root is its own parent
    std::uint32_t size = 1;
    std::uint32_t next_member = no_index;  ///< circular list of all united numbers
    std::int32_t level = 0;
    std::int32_t last_row = 0;
    std::uint32_t place = no_index;  ///< index in the list of components that continue beyond a band
    bool open_above = false;         ///< may continue in rows above that are not known yet
    Label label = 0;
    LatticePoint first;
    std::uint32_t below = no_index;  ///< component one level down
    PointStats own;
    PointStats above;
    double lowest_outside = nothing_below;
    PackedRing exterior;
    std::vector<PackedRing> interiors;
    std::unique_ptr<ElevationSample> sample;  ///< level 1 only
    std::vector<std::int64_t> children;       ///< names of finished contours, as returned by the sink

    static constexpr double nothing_below = std::numeric_limits<double>::infinity();
};

/// Union-find over the runs of all levels. Not DisjointSets, because the contents of components are merged as
/// well (small into large) and numbers are reused after a contour is finished, which bounds the memory by the
/// open components.
class Components {
  public:
    /// @param range of the elevations in samples
    explicit Components(const ElevationRange& range) : range_(range) {}

    /// @return a component with one run
    std::uint32_t add(std::int32_t level, Label label, LatticePoint first, std::uint32_t below);
    /// @param found component from elsewhere; its union-find members are reset
    /// @return a component with the same contents
    std::uint32_t add(Component&& found);
    std::uint32_t find(std::uint32_t component);
    /// @return common root
    std::uint32_t unite(std::uint32_t a, std::uint32_t b);
    Component& operator[](std::uint32_t component) { return pool_[component]; }

    /// Frees the numbers of a finished root. @return its contents
    FinishedContour finish(std::uint32_t root);

  private:
    std::uint32_t allocate();

    ElevationRange range_;
    std::vector<Component> pool_;
    std::uint32_t free_ = no_index;
};

}  // namespace d2b::contours
