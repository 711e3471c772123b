#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/stop_request.hpp"
#include "dem2buildings/sinks.hpp"
#include "geometry/geos.hpp"

namespace d2b {

/// A coordinate as a destination will write it, so that rounding it again changes nothing.
[[nodiscard]] double rounded(double coordinate, const CoordinateRounding& rounding);

/// Rounds polygons as the destination will, before they are written, so that the ones that are checked are
/// those that are read back. What is broken by it is mended on the same grid. All polygons are looked at once
/// more in finish(): none may be lost, none may run into a neighbour, and a contour lies within its parent.
class RoundedPolygons {
  public:
    /// Who must not run into whom.
    enum class Layer { buildings, contours, rejected };

    RoundedPolygons(CoordinateRounding rounding, bool is_stacked, StopRequest stop);

    /// @param id, parent_id of the feature in its layer; parent 0: none
    /// @param name for messages: "contour 7"
    /// @return whether the polygon had to be mended
    bool round(Layer layer, std::int64_t id, std::int64_t parent_id, std::string name,
               std::vector<WorldPolygon>& parts);
    /// @throws OptionError with the coarsest precision that keeps all polygons, where this one does not
    void finish();

  private:
    struct Item {
        Layer layer = Layer::buildings;
        std::int64_t id = 0;
        std::int64_t parent_id = 0;
        std::string name;
        std::vector<WorldPolygon> exact;
    };
    using Parts = std::vector<WorldPolygon>;
    /// Polygons that a rounding loses or lets run into others.
    struct Harm {
        std::size_t count = 0;
        std::string first;

        void add(const std::string& name) {
            if (count++ == 0)
                first = name;
        }
    };

    [[nodiscard]] Parts as_rounded(const Parts& exact, const CoordinateRounding& rounding, bool& mended);
    [[nodiscard]] Harm harm_of(const CoordinateRounding& rounding);
    void find_overlaps(const std::vector<Parts>& shapes, Layer layer, Harm& harm);
    void find_escapes(const std::vector<Parts>& shapes, Harm& harm);

    CoordinateRounding rounding_;
    bool is_stacked_;
    bool is_coarse_;
    StopRequest stop_;
    Geos geos_;
    std::vector<Item> items_;
    bool any_moved_ = false;
};

}  // namespace d2b
