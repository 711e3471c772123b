#include "core/crs.hpp"

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <proj.h>

#include "core/crs/axis_units.hpp"
#include "core/crs/crs_impl.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/parse_crs.hpp"
#include "core/crs/proj_objects.hpp"
#include "core/crs/text.hpp"
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
    const std::string what = quoted(crs.name()) + ", which has no plane coordinates; ";
    if (!option.empty())
        throw OptionError(option + " is " + what +
                          "give a projected or geographic coordinate reference system.");
    throw InputError("The coordinate reference system of '" + input + "' is " + what +
                     "correct it with gdal_edit.py -a_srs, or for the DEM with -a_srs.");
}

}  // namespace d2b
