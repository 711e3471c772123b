#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "detect/scene.hpp"

namespace d2b {

/// A square of a scene on its own, and which of its cells are surely roofs.
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

/// The squares of 1024 by 1024 cells that hold the most cells of roofs, up to four; of equal ones the first.
/// They are cut from the scene's first row and column on.
[[nodiscard]] std::vector<RoofSample> roof_samples(const Scene& scene, const Mask& roofs, Executor& threads);

}  // namespace d2b
