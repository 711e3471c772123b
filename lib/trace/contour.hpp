#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/band.hpp"
#include "core/elevation_sample.hpp"
#include "core/lattice.hpp"
#include "core/point_stats.hpp"

namespace d2b {

/// Identifies a contour independently of bands, threads and tiles: its level and its first unit square in the
/// scan order of the whole raster.
struct ContourKey {
    std::int32_t level = 0;
    LatticePoint first;

    friend auto operator<=>(const ContourKey&, const ContourKey&) = default;
};

/// A connected component of the points above a threshold, as traced: exact on the lattice, with simple rings.
struct Contour {
    ContourKey key;
    Label label = 0;
    std::int64_t parent = -1;  ///< index of the containing contour one level down; -1: none
    PackedRing exterior;
    std::vector<PackedRing> interiors;
    PointStats own;    ///< points outside all contours of the level above
    PointStats above;  ///< points inside contours of the level above
    /// Level 1 only: lowest valid elevation below the threshold within a cell outside the exterior ring;
    /// +infinity if there is none.
    double lowest_outside = std::numeric_limits<double>::infinity();

    /// Number of unit squares inside.
    [[nodiscard]] std::int64_t squares() const {
        std::int64_t sum = exterior.area();
        for (const PackedRing& ring : interiors)
            sum += ring.area();
        return sum;
    }
};

/// A contour whose last row has passed. Its children are handed out before it.
struct FinishedContour {
    Contour contour;
    ElevationSample sample;                    ///< level 1: all points except spires
    std::vector<std::int64_t> standing_on_it;  ///< names of the child contours, as returned by the sink
};

/// Receives each contour as soon as its last row has passed, so that the tracer keeps only open contours.
class ContourSink {
  public:
    ContourSink() = default;
    ContourSink(const ContourSink&) = delete;
    ContourSink& operator=(const ContourSink&) = delete;
    virtual ~ContourSink() = default;
    /// @return name of the contour; -1 drops it and its children, and adds its points to its parent
    virtual std::int64_t take(FinishedContour&& finished) = 0;
};

}  // namespace d2b
