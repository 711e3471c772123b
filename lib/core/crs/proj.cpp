#include "core/crs/proj.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <locale>
#include <new>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/system/process.hpp"

namespace d2b {

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string result(text.substr(0, longest));
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return "'" + result + (text.size() > longest ? "...'" : "'");
}

std::string position_text(const Position& p) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(12);
    text << "(" << p.x << ", " << p.y << ")";
    return text.str();
}

std::string lower_alphanumerics(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

ProjContext::ProjContext() : context_(proj_context_create()) {
    if (!context_)
        throw std::bad_alloc();
    if (const std::filesystem::path& data = system::data_beside_program(); !data.empty()) {
        const std::string folder = (data / "proj").string();
        const std::array<const char*, 1> folders{folder.c_str()};
        proj_context_set_search_paths(get(), static_cast<int>(folders.size()), folders.data());
    }
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

std::optional<AxisUnit> axis_unit(PJ_CONTEXT* context, const PJ* crs, int axis) {
    const PjPtr axes(proj_crs_get_coordinate_system(context, crs));
    const char* name = nullptr;
    double factor = 0;
    if (!axes || axis >= proj_cs_get_axis_count(context, axes.get()) ||
        !proj_cs_get_axis_info(context, axes.get(), axis, nullptr, nullptr, nullptr, &factor, &name, nullptr,
                               nullptr))
        return std::nullopt;
    return AxisUnit{name ? name : "", factor};
}

double to_degrees(double radians) {
    const double degrees = radians * 180 / std::numbers::pi;
    return std::abs(degrees - 1) < 1e-12 ? 1 : degrees;  // the degree is often given with few digits
}

/// Identifies common units by their size, because files spell them in many ways ("Meter", "Foot_US").
std::optional<LengthUnit> length_unit(const std::optional<AxisUnit>& unit) {
    static constexpr std::array<std::pair<const char*, double>, 3> common{
        {{"metre", 1.0}, {"foot", 0.3048}, {"US survey foot", 1200.0 / 3937.0}}};
    if (!unit || !(unit->factor > 0) || lower_alphanumerics(unit->name) == "unknown")
        return std::nullopt;
    for (const auto& [name, metres] : common)
        if (std::abs(unit->factor - metres) < 1e-9 * metres)
            return LengthUnit{name, unit->factor};
    return LengthUnit{unit->name, unit->factor};
}

std::optional<LengthUnit> vertical_unit_of(PJ_CONTEXT* context, const PJ* whole, const PJ* horizontal) {
    if (proj_get_type(whole) == PJ_TYPE_COMPOUND_CRS) {
        const PjPtr vertical = unbound(context, PjPtr(proj_crs_get_sub_crs(context, whole, 1)));
        if (vertical && axes_type(context, vertical.get()) == PJ_CS_TYPE_VERTICAL)
            return length_unit(axis_unit(context, vertical.get(), 0));
    }
    return length_unit(axis_unit(context, horizontal, 2));
}

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

void transform_in_place(PJ* operation, std::span<Position> positions) {
    if (positions.empty())
        return;
    constexpr std::size_t stride = sizeof(Position);
    proj_errno_reset(operation);
    proj_trans_generic(operation, PJ_FWD, &positions[0].x, stride, positions.size(), &positions[0].y, stride,
                       positions.size(), nullptr, 0, 0, nullptr, 0, 0);
}

namespace {

bool is_proj_string(std::string_view text) {
    return text.find_first_of("[{") == std::string_view::npos &&
           (text.find("proj=") != std::string_view::npos || text.find("init=") != std::string_view::npos);
}

/// Returns true if PROJ would search for the text as a part of a name: it takes "foo" for Amersfoort.
bool may_be_a_name(std::string_view text) {
    return text.find_first_of("[{:=") == std::string_view::npos;
}

OptionError unusable(std::string_view text, const std::string& why) {
    return OptionError(
        in_quotes(text) + " is not " + why +
        "; give a code such as EPSG:25832 or EPSG:25832+7837, WKT, PROJJSON or a PROJ string.");
}

}  // namespace

std::string guess_epsg_code(std::string_view text) {
    constexpr std::string_view authority = "epsg";
    if (lower_alphanumerics(text.substr(0, authority.size())) == authority) {
        text.remove_prefix(authority.size());
        text.remove_prefix(std::min(text.find_first_not_of(" -_/"), text.size()));
    }
    const bool digits =
        std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0 || c == '+'; });
    if (text.empty() || !digits || text.find_first_of("123456789") != 0)
        return "";
    return "EPSG:" + std::string(text);
}

OptionError unreadable(std::string_view text, const ProjContext& context) {
    return unusable(text, "a coordinate reference system (PROJ: " + context.reason() + ")");
}

PjPtr parse_crs(const ProjContext& context, std::string_view text) {
    if (const std::string code = guess_epsg_code(text); !code.empty())
        throw OptionError(in_quotes(text) + " is not a coordinate reference system; write " + code +
                          " if that is meant.");
    std::string definition(text);
    if (is_proj_string(text) && text.find("type=crs") == std::string_view::npos)
        definition += " +type=crs";
    PjPtr crs(proj_create(context.get(), definition.c_str()));
    if (!crs)
        throw unreadable(text, context);
    const std::string name = proj_get_name(crs.get());
    if (!proj_is_crs(crs.get()))
        throw unusable(text, "a coordinate reference system but " + in_quotes(name));
    if (may_be_a_name(text) && lower_alphanumerics(text) != lower_alphanumerics(name))
        throw unusable(text,
                       "the name of a coordinate reference system (the nearest is " + in_quotes(name) + ")");
    return crs;
}

}  // namespace d2b
