#pragma once

#include <span>
#include <vector>

#include "geometry/overlay.hpp"

namespace d2b::compare {

/// Share of the area of each outline that lies in a region. @param outlines each valid @param region valid
[[nodiscard]] std::vector<double> shares_in_region(std::span<const Polygons> outlines, const Polygons& region,
                                                   Overlay& overlay);

}  // namespace d2b::compare
