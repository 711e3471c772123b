#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/byte_record.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// What relates a contour to the others, and what its place in the stack depends on.
struct ContourHead {
    ContourKey key;
    Label label = 0;
    std::int64_t parent = -1;    ///< index of the contour one level down that contains it; -1: none
    std::int64_t building = -1;  ///< index of the building whose stack it is in; -1 in level 0
    double tier_z = unknown;     ///< mean of the points that no contour above holds; NaN where there are none
    double lowest_outside = std::numeric_limits<double>::infinity();  ///< as Contour's

    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
};

/// All contours that are kept, sorted by key. How they are related is at hand; rings and points are fetched.
class ContourList {
  public:
    ContourList() = default;
    ContourList(const ContourList&) = delete;
    ContourList& operator=(const ContourList&) = delete;
    virtual ~ContourList() = default;

    [[nodiscard]] virtual std::size_t size() const = 0;
    [[nodiscard]] virtual const ContourHead& head(std::size_t contour) const = 0;
    /// From any thread. @throws OutputError where they wait in a file that cannot be read
    [[nodiscard]] virtual Contour fetch(std::size_t contour) const = 0;
};

/// All of a list, for what needs them side by side.
[[nodiscard]] std::vector<Contour> fetch_all(const ContourList& contours);

/// Rings and points of a contour; its head is the caller's.
void save(const Contour& contour, ByteWriter& writer);
[[nodiscard]] Contour load_contour(ByteReader& reader);

}  // namespace d2b
