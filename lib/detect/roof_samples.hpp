#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/scene.hpp"

namespace d2b {

/// Copy of a square of a scene, with its certain roof cells.
struct RoofSample {
    MetreGrid surface;
    MetreGrid terrain;
    CellSize cell;
    std::optional<Mask> allowed;
    std::optional<MetreGrid> greenness;
    Mask roofs;

    [[nodiscard]] Scene scene() const {
        return {surface, terrain, cell, allowed ? &*allowed : nullptr, greenness ? &*greenness : nullptr};
    }
};

/// Copies the up to four squares of 1024 by 1024 cells with most roof cells; the first ones win ties. The
/// squares are tiles from the scene's first row and column.
[[nodiscard]] std::vector<RoofSample> roof_samples(const Scene& scene, const Mask& roofs, Executor& threads);

}  // namespace d2b
