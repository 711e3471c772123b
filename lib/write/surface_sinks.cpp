#include "write/surface_sinks.hpp"

#include <utility>

#include "write/cityjson_sink.hpp"
#include "write/glb_sink.hpp"
#include "write/obj_sink.hpp"
#include "write/stl_sink.hpp"
#include "write/surface_format.hpp"

namespace d2b {

std::unique_ptr<SurfaceSink> open_surface_sink(RasterPlace place, SurfaceSolids solids) {
    switch (*surface_format_of(place.name)) {
        case SurfaceFormat::cityjson:
            return open_cityjson_sink(std::move(place));
        case SurfaceFormat::glb:
            return open_glb_sink(std::move(place));
        case SurfaceFormat::stl:
            return open_stl_sink(std::move(place), solids);
        case SurfaceFormat::obj:
            break;
    }
    return open_obj_sink(std::move(place), solids);
}

}  // namespace d2b
