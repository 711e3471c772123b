#pragma once

#include <memory>
#include <optional>

#include "dem2buildings/options.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Destination files of a surface.
struct SurfacePlace {
    RasterPlace file;
    std::optional<RasterPlace> materials;  ///< second file of an OBJ
};

/// @param target of RasterFormat::surface @throws OptionError, OutputError like locate_raster()
[[nodiscard]] SurfacePlace locate_surface(const RasterTarget& target);

/// Opens a surface in the format of the file extension. @param solids used by OBJ and STL
[[nodiscard]] std::unique_ptr<SurfaceSink> open_surface_sink(SurfacePlace place, SurfaceSolids solids);

}  // namespace d2b
