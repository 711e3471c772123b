#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A binary glTF 2.0: one mesh of all buildings with a primitive for each material: roof, wall and ground.
/// The vertex attribute _FEATURE_ID_0 is the place of a corner's building in the extras of the node, a list
/// of names and attributes. As glTF has it, y points up and z to the south. The origin and what the metadata
/// say are extras of the asset. Without a building there is no file, and a warning says so.
/// @param most bytes of the file, which its format counts with 32 bits
[[nodiscard]] std::unique_ptr<SurfaceSink> open_glb_sink(
    RasterPlace place, std::uint64_t most = std::numeric_limits<std::uint32_t>::max());

}  // namespace d2b
