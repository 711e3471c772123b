#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/byte_record.hpp"
#include "trace/contour.hpp"

namespace d2b {

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

/// Serializes rings and points, but not the head, which the caller stores.
void save(const Contour& contour, ByteWriter& writer);
[[nodiscard]] Contour load_contour(ByteReader& reader);

}  // namespace d2b
