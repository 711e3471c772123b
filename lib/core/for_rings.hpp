#pragma once

namespace d2b {

/// Calls use(ring) for the exterior and then for the interiors of a polygon or contour.
template <typename Polygon, typename Use>
void for_rings(Polygon&& polygon, const Use& use) {
    use(polygon.exterior);
    for (auto& ring : polygon.interiors)
        use(ring);
}

}  // namespace d2b
