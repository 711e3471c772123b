#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/stop_token.hpp"
#include "dem2buildings/sinks.hpp"
#include "geometry/geos.hpp"

namespace d2b::features {

/// Rounds a coordinate the way a destination will write it. Idempotent.
[[nodiscard]] double rounded(double coordinate, const CoordinateRounding& rounding);

/// Rounds polygons before writing in the same way as the destination, so that the polygons checked are those
/// read back. Polygons broken by rounding are repaired on the same grid. finish() checks all polygons
/// together: none may collapse or overlap a neighbour. A contour may extend beyond its parent by as much as
/// rounding moves corners, because a parent has no corner where one of its contours ends at its walls.
class RoundedPolygons {
  public:
    RoundedPolygons(CoordinateRounding rounding, bool is_stacked, StopToken stop);

    /// @param layer polygons of one layer, buildings or contours, must not overlap
    /// @param parent_id of the feature in its layer; 0: none
    /// @param name for messages, such as "contour 7"
    /// @return true if the polygon was repaired
    bool round(LayerRole layer, std::int64_t parent_id, std::string name, std::vector<WorldPolygon>& parts);
    /// @throws OptionError if this precision damages polygons, naming the coarsest one that does not
    void finish();

  private:
    struct Item {
        LayerRole layer = LayerRole::buildings;
        std::int64_t parent_id = 0;
        std::string name;
        std::vector<WorldPolygon> exact;
    };
    using Parts = std::vector<WorldPolygon>;
    /// Polygons that collapse or overlap others after rounding.
    struct Damage {
        std::size_t count = 0;
        std::string first;

        void add(const std::string& name) {
            if (count++ == 0)
                first = name;
        }
    };

    [[nodiscard]] Parts round_parts(const Parts& exact, const CoordinateRounding& rounding,
                                    bool& was_repaired);
    [[nodiscard]] Damage damage_of(const CoordinateRounding& rounding);
    void find_overlaps(const std::vector<Parts>& shapes, LayerRole layer, Damage& harm);

    CoordinateRounding rounding_;
    bool is_stacked_;
    bool is_coarse_;
    StopToken stop_;
    Geos geos_;
    std::vector<Item> items_;
    bool any_moved_ = false;
};

}  // namespace d2b::features
