#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A binary glTF 2.0: a node a building with its attributes as extras, and a mesh each of roof, walls and
/// ground. As glTF has it, y points up and z to the south. The origin and what the metadata say are extras of
/// the asset. Without a building there is no file, and a warning says so.
/// @param most bytes of the file, which its format counts with 32 bits
[[nodiscard]] std::unique_ptr<SurfaceSink> open_glb_sink(
    RasterPlace place, std::uint64_t most = std::numeric_limits<std::uint32_t>::max());

}  // namespace d2b
