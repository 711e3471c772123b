#include "core/crs/proj_objects.hpp"

#include <cstddef>
#include <new>
#include <utility>

namespace d2b {

ProjContext::ProjContext() : context_(proj_context_create()) {
    if (!context_)
        throw std::bad_alloc();
    proj_log_func(get(), &reason_, keep_reason);
    proj_log_level(get(), PJ_LOG_ERROR);  // overrides the environment
    proj_context_set_enable_network(get(), 0);
    proj_context_use_proj4_init_rules(get(), 1);  // "+init=epsg:25832" is still in use
}

std::string ProjContext::reason() const {
    const std::size_t colon = reason_.starts_with("proj_") ? reason_.find(": ") : std::string::npos;
    return colon == std::string::npos ? reason_ : reason_.substr(colon + 2);
}

void ProjContext::keep_reason(void* reason, int /*level*/, const char* message) noexcept {
    *static_cast<std::string*>(reason) = message;
}

PjPtr unbound(PJ_CONTEXT* context, PjPtr crs) {
    while (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
        crs.reset(proj_get_source_crs(context, crs.get()));
    return crs;
}

PjPtr horizontal_part(PJ_CONTEXT* context, const PJ* crs) {
    if (proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS)
        return PjPtr(proj_crs_get_sub_crs(context, crs, 0));
    return PjPtr(proj_clone(context, crs));
}

PJ_COORDINATE_SYSTEM_TYPE axes_type(PJ_CONTEXT* context, const PJ* crs) {
    const PjPtr axes(proj_crs_get_coordinate_system(context, crs));
    return axes ? proj_cs_get_type(context, axes.get()) : PJ_CS_TYPE_UNKNOWN;
}

Crs::Kind kind_of(PJ_CONTEXT* context, const PJ* crs) {
    switch (proj_get_type(crs)) {
        case PJ_TYPE_PROJECTED_CRS:
            return Crs::Kind::projected;
        case PJ_TYPE_GEOGRAPHIC_2D_CRS:
        case PJ_TYPE_GEOGRAPHIC_3D_CRS:
            return Crs::Kind::geographic;
        case PJ_TYPE_ENGINEERING_CRS:
            return Crs::Kind::local;
        case PJ_TYPE_GEODETIC_CRS:
        case PJ_TYPE_GEOCENTRIC_CRS:
        case PJ_TYPE_VERTICAL_CRS:
            return Crs::Kind::other;
        default:
            // A CRS derived from a projected one (site grids) has its own type since PROJ 9.2, and none
            // before.
            return PjPtr(proj_crs_get_geodetic_crs(context, crs)) &&
                           axes_type(context, crs) == PJ_CS_TYPE_CARTESIAN
                       ? Crs::Kind::projected
                       : Crs::Kind::other;
    }
}

}  // namespace d2b
