#include "write/surface_sinks.hpp"

#include <utility>

#include "write/cityjson_sink.hpp"
#include "write/glb_sink.hpp"
#include "write/obj_sink.hpp"
#include "write/stl_sink.hpp"
#include "write/surface_format.hpp"

namespace d2b {

SurfacePlace locate_surface(const RasterTarget& target) {
    SurfacePlace place{locate_raster(target), std::nullopt};
    if (surface_format_of(target.destination) == SurfaceFormat::obj) {
        RasterTarget materials = target;
        materials.destination = materials_name(target.destination);
        materials.format = RasterFormat::materials;
        place.materials = locate_raster(materials);
    }
    return place;
}

std::unique_ptr<SurfaceSink> open_surface_sink(SurfacePlace place, SurfaceSolids solids) {
    switch (*surface_format_of(place.file.name)) {
        case SurfaceFormat::cityjson:
            return open_cityjson_sink(std::move(place.file));
        case SurfaceFormat::glb:
            return open_glb_sink(std::move(place.file));
        case SurfaceFormat::stl:
            return open_stl_sink(std::move(place.file), solids);
        case SurfaceFormat::obj:
            break;
    }
    return open_obj_sink(std::move(place.file), std::move(*place.materials), solids);
}

}  // namespace d2b
