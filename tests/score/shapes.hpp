#pragma once

#include <optional>
#include <vector>

#include "read/polygon_layer.hpp"
#include "score/score.hpp"
#include "support/box.hpp"

namespace d2b::test {

/// Each polygon a feature.
inline score::ScoreSide side(const std::vector<WorldPolygon>& polygons,
                             std::vector<std::optional<double>> heights = {}) {
    heights.resize(polygons.size());
    std::vector<PolygonFeature> footprints;
    for (std::size_t i = 0; i < polygons.size(); ++i)
        footprints.push_back({{polygons[i]}, heights[i], false});
    Overlay overlay;
    return score::score_side(footprints, overlay);
}

}  // namespace d2b::test
