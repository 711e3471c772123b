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
    std::int64_t parent = -1;  ///< index of the contour one level down that contains it; -1: none
    PackedRing exterior;
    std::vector<PackedRing> interiors;
    PointStats own;    ///< of the points that no contour above holds
    PointStats above;  ///< of those that contours above hold
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

/// A contour whose last row has passed; what stands on it has been handed out before.
struct FinishedContour {
    Contour contour;
    ElevationSample sample;                    ///< level 1: of all its points but spires
    std::vector<std::int64_t> standing_on_it;  ///< what the sink called the contours that stand on it
};

/// Gets each contour as soon as its last row has passed, so that nothing finished stays in the tracer.
class ContourSink {
  public:
    ContourSink() = default;
    ContourSink(const ContourSink&) = delete;
    ContourSink& operator=(const ContourSink&) = delete;
    virtual ~ContourSink() = default;
    /// @return a name for it; -1: it is dropped with all that stands on it, and the contour below holds its
    ///         points
    virtual std::int64_t take(FinishedContour&& finished) = 0;
};

}  // namespace d2b
