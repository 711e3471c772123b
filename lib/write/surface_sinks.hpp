#pragma once

#include <memory>
#include <optional>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Where a surface goes.
struct SurfacePlace {
    RasterPlace file;
    std::optional<RasterPlace> materials;  ///< of an OBJ: a file beside it
};

/// @param target of RasterFormat::surface @throws OptionError, OutputError as locate_raster() does
[[nodiscard]] SurfacePlace locate_surface(const RasterTarget& target);

/// A file of a surface, in the format that its name ends in. @param solids of an OBJ or STL
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(SurfacePlace place, SurfaceSolids solids);

}  // namespace d2b
