#include "core/crs/operation.hpp"

#include <cstddef>

namespace d2b {

PjPtr operation_between(PJ_CONTEXT* context, const PJ* from, const PJ* to, PJ_AREA* area) {
    const PjPtr as_defined(proj_create_crs_to_crs_from_pj(context, from, to, area, nullptr));
    if (!as_defined)
        return nullptr;
    PjPtr operation(proj_normalize_for_visualization(context, as_defined.get()));
    // If PROJ keeps several candidates to choose from by position, the type is unknown and all can be
    // instantiated.
    if (operation && proj_get_type(operation.get()) != PJ_TYPE_UNKNOWN &&
        !proj_coordoperation_is_instantiable(context, operation.get()))
        return nullptr;
    return operation;
}

void carry_out(PJ* operation, std::span<Position> positions) {
    if (positions.empty())
        return;
    constexpr std::size_t stride = sizeof(Position);
    proj_errno_reset(operation);
    proj_trans_generic(operation, PJ_FWD, &positions[0].x, stride, positions.size(), &positions[0].y, stride,
                       positions.size(), nullptr, 0, 0, nullptr, 0, 0);
}

}  // namespace d2b
