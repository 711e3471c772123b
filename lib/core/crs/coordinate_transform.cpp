#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <proj.h>

#include "core/crs.hpp"
#include "core/crs/area_of_interest.hpp"
#include "core/crs/crs_impl.hpp"
#include "core/crs/operation.hpp"
#include "core/crs/position_math.hpp"
#include "core/crs/proj_objects.hpp"
#include "core/crs/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

void require_horizontal(const Crs& crs, const char* role) {
    if (crs.kind() == Crs::Kind::none)
        throw OptionError(std::string("There is no coordinate reference system to transform ") + role +
                          "; state which one the coordinates are in.");
    if (crs.kind() == Crs::Kind::other)
        throw OptionError(quoted(crs.name()) + " has no plane coordinates to transform " + role +
                          "; choose a projected or geographic coordinate reference system.");
}

}  // namespace

struct CoordinateTransform::Impl {
    ProjContext context;
    PjPtr operation;  ///< null if both CRSs are the same
    std::string from;
    std::string to;
    std::vector<Position> images;
};

CoordinateTransform::CoordinateTransform(const Crs& from, const Crs& to, std::span<const Position> area)
    : impl_(std::make_unique<Impl>()) {
    require_horizontal(from, "from");
    require_horizontal(to, "to");
    impl_->from = from.name();
    impl_->to = to.name();
    if (from.wkt() == to.wkt())
        return;
    // Heights are not transformed, so the vertical parts of compounds must not prevent an operation.
    PJ_CONTEXT* context = impl_->context.get();
    const PjPtr source(proj_clone(context, from.impl().horizontal.get()));
    const PjPtr target(proj_clone(context, to.impl().horizontal.get()));
    impl_->operation = operation_between(context, source.get(), target.get(),
                                         area_of(from.impl().horizontal.get(), area).get());
    if (!impl_->operation)
        throw OptionError("PROJ knows no operation from " + quoted(from.name()) + " to " + quoted(to.name()) +
                          "; choose a coordinate reference system that the coordinates can be converted to.");
}

CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;
CoordinateTransform::~CoordinateTransform() = default;

void CoordinateTransform::apply(std::span<Position> positions) {
    std::vector<Position>& images = impl_->images;
    images.assign(positions.begin(), positions.end());
    if (impl_->operation)
        carry_out(impl_->operation.get(), images);
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(images[i]))
            throw InputError("Position " + position_text(positions[i]) + " of " + quoted(impl_->from) +
                             " has no image in " + quoted(impl_->to) +
                             "; check which coordinate reference system the coordinates are in.");
    std::copy(images.begin(), images.end(), positions.begin());
}

bool CoordinateTransform::try_apply(std::span<Position> positions) {
    if (impl_->operation)
        carry_out(impl_->operation.get(), positions);
    return std::all_of(positions.begin(), positions.end(), is_finite);
}

}  // namespace d2b
