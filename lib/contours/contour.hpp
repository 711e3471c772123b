#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/band.hpp"
#include "core/byte_stream.hpp"
#include "core/lattice.hpp"
#include "core/statistics.hpp"

namespace d2b::contours {

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
    ElevationSample sample;              ///< level 1: all points except spires
    std::vector<std::int64_t> children;  ///< names of the child contours, as returned by the sink
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

/// Relations of a contour to others, and the values that determine its place in the stack.
struct ContourHead {
    ContourKey key;
    Label label = 0;
    std::int64_t parent = -1;    ///< index of the containing contour one level down; -1: none
    std::int64_t building = -1;  ///< index of the building; -1 in level 0
    double tier_z =
        unknown;  ///< mean of the points outside all contours of the level above; NaN if there are none
    double lowest_outside = std::numeric_limits<double>::infinity();  ///< see Contour

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
};

/// All contours that are kept, sorted by key. Heads are in memory; rings and points are fetched.
class ContourList {
  public:
    ContourList() = default;
    ContourList(const ContourList&) = delete;
    ContourList& operator=(const ContourList&) = delete;
    virtual ~ContourList() = default;

    [[nodiscard]] virtual std::size_t size() const = 0;
    [[nodiscard]] virtual const ContourHead& head(std::size_t contour) const = 0;
    /// Thread-safe. @throws OutputError if the contours are in a file that cannot be read
    [[nodiscard]] virtual Contour fetch(std::size_t contour) const = 0;
};

/// Fetches all contours, for algorithms that need random access.
[[nodiscard]] std::vector<Contour> fetch_all(const ContourList& contours);

/// Outline of a contour, as traced.
[[nodiscard]] LatticePolygon traced_polygon(const Contour& contour);
/// Serializes rings and points, but not the head, which the caller stores.
void save(const Contour& contour, ByteWriter& writer);
[[nodiscard]] Contour load_contour(ByteReader& reader);

}  // namespace d2b::contours
