#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// Binary glTF 2.0: one mesh of all buildings with one primitive per material: roof, wall and ground. The
/// vertex attribute _FEATURE_ID_0 is the index of the building in the extras of the node, a list of names and
/// attributes. y points up and z to the south, because glTF requires it. The origin and the metadata are
/// extras of the asset. Without any building no file is written, and a warning says so. @param most largest
/// file size in bytes, which the format stores in 32 bits
[[nodiscard]] std::unique_ptr<SurfaceSink> open_glb_sink(
    FileDestination place, std::uint64_t most = std::numeric_limits<std::uint32_t>::max());

}  // namespace d2b::writing
