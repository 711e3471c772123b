#include "core/crs/crs_impl.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <GeographicLib/Config.h>
#include <proj.h>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Returns the OGC URL of a CRS from its own code; "" if it has none.
std::string stated_url(const PJ* crs) {
    const char* authority = proj_get_id_auth_name(crs, 0);
    const char* code = proj_get_id_code(crs, 0);
    if (authority == nullptr || code == nullptr)
        return "";
    return "https://www.opengis.net/def/crs/" + std::string(authority) + "/0/" + code;
}

/// Searches PROJ's database for the code of an equal CRS, because a GeoTIFF keeps only the codes of the parts
/// of a compound.
std::string found_url(PJ_CONTEXT* context, const PJ* crs) {
    constexpr int equal = 90;  // percent: the names may differ, nothing else
    int* confidence = nullptr;
    PJ_OBJ_LIST* matches = proj_identify(context, crs, nullptr, nullptr, &confidence);
    std::string url;
    for (int i = 0; i < proj_list_get_count(matches) && confidence[i] >= equal && url.empty(); ++i)
        url = stated_url(PjPtr(proj_list_get(context, matches, i)).get());
    proj_int_list_destroy(confidence);
    proj_list_destroy(matches);
    return url;
}

std::string url_of(PJ_CONTEXT* context, const PJ* crs) {
    const std::string stated = stated_url(crs);
    return stated.empty() ? found_url(context, crs) : stated;
}

void require_horizontal(const Crs& crs, const char* role) {
    if (crs.kind() == Crs::Kind::none)
        throw OptionError(std::string("There is no coordinate reference system to transform ") + role +
                          "; state which one the coordinates are in.");
    if (crs.kind() == Crs::Kind::other)
        throw OptionError(in_quotes(crs.name()) + " has no plane coordinates to transform " + role +
                          "; choose a projected or geographic coordinate reference system.");
}

}  // namespace

void Crs::Impl::read(std::string_view text) {
    context = std::make_unique<ProjContext>();
    PJ_CONTEXT* pj_context = context->get();
    const PjPtr given = parse_crs(*context, text);
    name = proj_get_name(given.get());
    static constexpr std::array<const char*, 2> one_line{"MULTILINE=NO", nullptr};
    const char* exported = proj_as_wkt(pj_context, given.get(), PJ_WKT2_2019, one_line.data());
    if (!exported)
        throw unreadable(text, *context);
    wkt = exported;

    horizontal = horizontal_part(pj_context, given.get());
    const PjPtr base = unbound(pj_context, PjPtr(proj_clone(pj_context, horizontal.get())));
    kind = kind_of(pj_context, base.get());
    const std::optional<AxisUnit> unit = axis_unit(pj_context, base.get(), 0);
    if (kind == Kind::geographic && unit)
        angular_unit = to_degrees(unit->factor);
    if (kind == Kind::projected ||
        (kind == Kind::local && axes_type(pj_context, base.get()) == PJ_CS_TYPE_CARTESIAN))
        horizontal_unit = length_unit(unit);
    if (kind != Kind::other)
        vertical_unit = vertical_unit_of(pj_context, given.get(), base.get());
    lon_lat = lon_lat_of(horizontal.get());
}

Crs::Crs() : impl_(std::make_shared<const Impl>()) {}

Crs::Crs(std::string_view text) {
    auto impl = std::make_shared<Impl>();
    if (!text.empty())
        impl->read(text);
    impl_ = std::move(impl);
}

Crs::Kind Crs::kind() const {
    return impl_->kind;
}
std::string Crs::name() const {
    return impl_->name;
}
std::string Crs::wkt() const {
    return impl_->wkt;
}
// Searched on demand, because most runs do not write the URL.
std::string Crs::url() const {
    if (impl_->wkt.empty())
        return "";
    const ProjContext context;
    return url_of(context.get(), unbound(context.get(), parse_crs(context, impl_->wkt)).get());
}
std::string Crs::horizontal_url() const {
    if (impl_->wkt.empty())
        return "";
    const ProjContext context;
    PjPtr horizontal = horizontal_part(context.get(), parse_crs(context, impl_->wkt).get());
    return url_of(context.get(), unbound(context.get(), std::move(horizontal)).get());
}
std::optional<LengthUnit> Crs::horizontal_unit() const {
    return impl_->horizontal_unit;
}
double Crs::turn() const {
    return impl_->angular_unit > 0 ? 360 / impl_->angular_unit : 0;
}
std::optional<LengthUnit> Crs::vertical_unit() const {
    return impl_->vertical_unit;
}
bool Crs::on_ellipsoid() const {
    return impl_->lon_lat != nullptr;
}

void require_plane(const Crs& crs, const std::string& option, const std::string& input) {
    if (crs.kind() != Crs::Kind::other)
        return;
    const std::string what = in_quotes(crs.name()) + ", which has no plane coordinates; ";
    if (!option.empty())
        throw OptionError(option + " is " + what +
                          "give a projected or geographic coordinate reference system.");
    throw InputError("The coordinate reference system of '" + input + "' is " + what +
                     "correct it with gdal_edit.py -a_srs, or for the DEM with -a_srs.");
}

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
        throw OptionError("PROJ has no operation from " + in_quotes(from.name()) + " to " +
                          in_quotes(to.name()) +
                          "; choose a coordinate reference system that the coordinates can be converted to.");
}

CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;
CoordinateTransform::~CoordinateTransform() = default;

void CoordinateTransform::apply(std::span<Position> positions) {
    std::vector<Position>& images = impl_->images;
    images.assign(positions.begin(), positions.end());
    if (impl_->operation)
        transform_in_place(impl_->operation.get(), images);
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(images[i]))
            throw InputError("Position " + position_text(positions[i]) + " of " + in_quotes(impl_->from) +
                             " has no counterpart in " + in_quotes(impl_->to) +
                             "; check which coordinate reference system the coordinates are in.");
    std::copy(images.begin(), images.end(), positions.begin());
}

bool CoordinateTransform::try_apply(std::span<Position> positions) {
    if (impl_->operation)
        transform_in_place(impl_->operation.get(), positions);
    return std::all_of(positions.begin(), positions.end(), is_finite);
}

/// Built from the numbers, because the text in PJ_INFO is shared and rewritten by every call of any thread.
std::string proj_version() {
    const PJ_INFO info = proj_info();
    return std::to_string(info.major) + "." + std::to_string(info.minor) + "." + std::to_string(info.patch);
}

std::string geographiclib_version() {
    return GEOGRAPHICLIB_VERSION_STRING;
}

}  // namespace d2b
