#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/band.hpp"
#include "core/elevation_sample.hpp"
#include "core/lattice.hpp"
#include "core/point_stats.hpp"

namespace d2b {

/// What names a contour, whatever the bands, threads and tiles that found it: its level and its first unit
/// square in the scan order of the whole raster.
struct ContourKey {
    std::int32_t level = 0;
    LatticePoint first;

    friend auto operator<=>(const ContourKey&, const ContourKey&) = default;
};

/// One connected piece of the points above a threshold, as traced: exact on the lattice, every ring simple.
struct Contour {
    ContourKey key;
    Label label = 0;
    std::int64_t parent = -1;  ///< index of the contour one level down that contains it; -1 in level 0
    PackedRing exterior;
    std::vector<PackedRing> interiors;
    PointStats own;  ///< of the points that no contour above holds
    /// Level 1 only: the lowest valid point that does not qualify within a cell outside the exterior ring;
    /// +infinity where there is none.
    double lowest_outside = std::numeric_limits<double>::infinity();

    /// Unit squares inside.
    [[nodiscard]] std::int64_t squares() const {
        std::int64_t sum = exterior.area();
        for (const PackedRing& ring : interiors)
            sum += ring.area();
        return sum;
    }
};

/// A contour of level 1 with all that stands on it, or a root alone. Parents come before their children;
/// `parent` counts from the stack's first contour.
struct Stack {
    std::vector<Contour> contours;
    ElevationSample sample;  ///< of all points of a level 1 stack
    std::vector<std::int64_t>
        standing_on_it;  ///< of a root: what the sink called the stacks that stand on it
};

/// What becomes of a stack.
struct Taken {
    std::int64_t handle = -1;  ///< -1: dropped
    PointStats fallen;         ///< points that nothing of the stack holds any more, so that the root does
};

/// Gets each stack as soon as its last row has passed, so that finished contours leave the tracer.
class StackSink {
  public:
    StackSink() = default;
    StackSink(const StackSink&) = delete;
    StackSink& operator=(const StackSink&) = delete;
    virtual ~StackSink() = default;
    virtual Taken take(Stack&& stack) = 0;
};

}  // namespace d2b
