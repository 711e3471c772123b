#include "core/crs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <new>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <proj.h>

#include "core/error.hpp"

namespace d2b {
namespace {

// ---- PROJ's objects ----

struct PjDelete {
    void operator()(PJ* pj) const { proj_destroy(pj); }
};
using PjPtr = std::unique_ptr<PJ, PjDelete>;

/// A context of PROJ that prints nothing and stays off the network. Every Crs, CoordinateTransform and
/// Geodesy owns one, so that objects made from one Crs may live in different threads.
class ProjContext {
  public:
    ProjContext() : context_(proj_context_create()) {
        if (!context_)
            throw std::bad_alloc();
        proj_log_func(get(), &reason_, keep_reason);
        proj_log_level(get(), PJ_LOG_ERROR);  // whatever the environment asks for
        proj_context_set_enable_network(get(), 0);
        proj_context_use_proj4_init_rules(get(), 1);  // "+init=epsg:25832" is still about
    }
    // PROJ holds the address of reason_.
    ProjContext(const ProjContext&) = delete;
    ProjContext& operator=(const ProjContext&) = delete;
    ~ProjContext() = default;

    [[nodiscard]] PJ_CONTEXT* get() const { return context_.get(); }
    /// PROJ's last complaint, without the name of the function that made it.
    [[nodiscard]] std::string reason() const {
        const std::size_t colon = reason_.starts_with("proj_") ? reason_.find(": ") : std::string::npos;
        return colon == std::string::npos ? reason_ : reason_.substr(colon + 2);
    }

  private:
    static void keep_reason(void* reason, int /*level*/, const char* message) noexcept {
        *static_cast<std::string*>(reason) = message;
    }
    struct Delete {
        void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    };
    std::string reason_;
    std::unique_ptr<PJ_CONTEXT, Delete> context_;
};

/// A bound CRS is a CRS with a way to WGS 84 attached (TOWGS84, grids); this is the CRS.
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

struct AxisUnit {
    std::string name;
    double factor = 0;  ///< metres or radians in one unit
};

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

/// @param crs not compound, not bound
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
            // A CRS derived from a projected one (site grids) has a type of its own in PROJ 9.2 and none
            // before.
            return PjPtr(proj_crs_get_geodetic_crs(context, crs)) &&
                           axes_type(context, crs) == PJ_CS_TYPE_CARTESIAN
                       ? Crs::Kind::projected
                       : Crs::Kind::other;
    }
}

// ---- reading a CRS ----

/// For messages: WKT can have pages.
std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string result(text.substr(0, longest));
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return "'" + result + (text.size() > longest ? "...'" : "'");
}

std::string letters_and_digits(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

bool is_proj_string(std::string_view text) {
    return text.find_first_of("[{") == std::string_view::npos &&
           (text.find("proj=") != std::string_view::npos || text.find("init=") != std::string_view::npos);
}

/// PROJ takes anything else for part of a name: "foo" is Amersfoort to it.
bool may_be_a_name(std::string_view text) {
    return text.find_first_of("[{:=") == std::string_view::npos;
}

OptionError unusable(std::string_view text, const std::string& why) {
    return OptionError(
        quoted(text) + " is not " + why +
        "; give a code such as EPSG:25832 or EPSG:25832+7837, WKT, PROJJSON or a PROJ string.");
}

OptionError unreadable(std::string_view text, const ProjContext& context) {
    return unusable(text, "a coordinate reference system (PROJ: " + context.reason() + ")");
}

PjPtr parse(const ProjContext& context, std::string_view text) {
    std::string definition(text);
    if (is_proj_string(text) && text.find("type=crs") == std::string_view::npos)
        definition += " +type=crs";
    PjPtr crs(proj_create(context.get(), definition.c_str()));
    if (!crs)
        throw unreadable(text, context);
    const std::string name = proj_get_name(crs.get());
    if (!proj_is_crs(crs.get()))
        throw unusable(text, "a coordinate reference system but " + quoted(name));
    if (may_be_a_name(text) && letters_and_digits(text) != letters_and_digits(name))
        throw unusable(text,
                       "the name of a coordinate reference system (the nearest is " + quoted(name) + ")");
    return crs;
}

/// Files spell the common units in many ways ("Meter", "Foot_US"); their size tells which they are.
std::optional<LengthUnit> length_unit(const std::optional<AxisUnit>& unit) {
    static constexpr std::array<std::pair<const char*, double>, 3> common{
        {{"metre", 1.0}, {"foot", 0.3048}, {"US survey foot", 1200.0 / 3937.0}}};
    if (!unit || !(unit->factor > 0) || letters_and_digits(unit->name) == "unknown")
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

// ---- positions between CRSs ----

/// The best operation of PROJ in GIS order; null where there is none that can be carried out.
PjPtr operation_between(PJ_CONTEXT* context, const PJ* from, const PJ* to, PJ_AREA* area) {
    const PjPtr as_defined(proj_create_crs_to_crs_from_pj(context, from, to, area, nullptr));
    if (!as_defined)
        return nullptr;
    PjPtr operation(proj_normalize_for_visualization(context, as_defined.get()));
    // Where PROJ keeps several candidates to choose from by position, they have no common type and all work.
    if (operation && proj_get_type(operation.get()) != PJ_TYPE_UNKNOWN &&
        !proj_coordoperation_is_instantiable(context, operation.get()))
        return nullptr;
    return operation;
}

void transform(PJ* operation, std::span<Position> positions) {
    if (positions.empty())
        return;
    constexpr std::size_t stride = sizeof(Position);
    proj_errno_reset(operation);
    proj_trans_generic(operation, PJ_FWD, &positions[0].x, stride, positions.size(), &positions[0].y, stride,
                       positions.size(), nullptr, 0, 0, nullptr, 0, 0);
}

bool is_finite(const Position& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

std::string text_of(const Position& p) {
    std::ostringstream text;
    text.precision(12);
    text << "(" << p.x << ", " << p.y << ")";
    return text.str();
}

/// From a CRS to degrees of longitude and latitude on its own datum; no datum shift.
struct LonLat {
    ProjContext context;
    PjPtr operation;            ///< null where the coordinates are longitude and latitude already
    double degrees = 1;         ///< in one unit of what the operation gives
    double prime_meridian = 0;  ///< degrees east of Greenwich
    double radius = 0;          ///< equatorial, metres
    double flattening = 0;

    /// In place; positions without image become infinite or NaN.
    void apply(std::span<Position> positions) const {
        if (operation)
            transform(operation.get(), positions);
        for (Position& p : positions) {
            p = {p.x * degrees, p.y * degrees};
            if (!(std::abs(p.y) <= 90))  // rounding may lead past a pole
                p.y = std::abs(p.y) <= 90 + 1e-9 ? std::copysign(90.0, p.y)
                                                 : std::numeric_limits<double>::infinity();
        }
    }
};

double to_degrees(double radians) {
    const double degrees = radians * 180 / std::numbers::pi;
    return std::abs(degrees - 1) < 1e-12 ? 1 : degrees;  // the degree itself is often given with few digits
}

bool read_ellipsoid(LonLat& result, const PJ* geographic) {
    PJ_CONTEXT* context = result.context.get();
    const PjPtr ellipsoid(proj_get_ellipsoid(context, geographic));
    double polar_radius = 0;
    double inverse_flattening = 0;
    if (!ellipsoid || !proj_ellipsoid_get_parameters(context, ellipsoid.get(), &result.radius, &polar_radius,
                                                     nullptr, &inverse_flattening))
        return false;
    result.flattening = inverse_flattening == 0 ? 0 : 1 / inverse_flattening;
    const PjPtr meridian(proj_get_prime_meridian(context, geographic));
    double longitude = 0;
    double radians = 0;
    if (meridian &&
        proj_prime_meridian_get_parameters(context, meridian.get(), &longitude, &radians, nullptr))
        result.prime_meridian = longitude * to_degrees(radians);
    return std::isfinite(result.radius) && result.radius > 0 && result.flattening < 1;
}

/// @returns null where the CRS has no longitudes and latitudes, or PROJ does not know its projection
std::unique_ptr<LonLat> lon_lat_of(const PJ* horizontal) {
    auto result = std::make_unique<LonLat>();
    PJ_CONTEXT* context = result->context.get();
    const PjPtr crs = unbound(context, PjPtr(proj_clone(context, horizontal)));
    const Crs::Kind kind = kind_of(context, crs.get());
    if (kind != Crs::Kind::projected && kind != Crs::Kind::geographic)
        return nullptr;
    PjPtr base(proj_crs_get_geodetic_crs(context, crs.get()));
    while (base && proj_crs_is_derived(context, base.get()))  // rotated poles
        base.reset(proj_get_source_crs(context, base.get()));
    if (!base || kind_of(context, base.get()) != Crs::Kind::geographic ||
        !read_ellipsoid(*result, base.get()))
        return nullptr;
    const std::optional<AxisUnit> unit = axis_unit(context, base.get(), 0);
    if (!unit)
        return nullptr;
    result->degrees = to_degrees(unit->factor);
    if (kind == Crs::Kind::geographic && !proj_crs_is_derived(context, crs.get()))
        return result;
    result->operation = operation_between(context, crs.get(), base.get(), nullptr);
    return result->operation ? std::move(result) : nullptr;
}

}  // namespace

// ---- Crs ----

struct Crs::Impl {
    std::unique_ptr<ProjContext> context;  ///< null where there is no CRS
    PjPtr horizontal;                      ///< of the compound, or all of it; still bound if it was
    Kind kind = Kind::none;
    std::string name;
    std::string wkt;
    std::optional<LengthUnit> horizontal_unit;
    std::optional<LengthUnit> vertical_unit;
    bool on_ellipsoid = false;
    double angular_unit = 0;  ///< degrees in one unit of the horizontal axes, 0 where they are lengths

    void read(std::string_view text);
};

/// Everything that is ever asked is found out here, so that later calls only read.
void Crs::Impl::read(std::string_view text) {
    context = std::make_unique<ProjContext>();
    PJ_CONTEXT* pj_context = context->get();
    const PjPtr given = parse(*context, text);
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
    on_ellipsoid = lon_lat_of(horizontal.get()) != nullptr;
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
std::optional<LengthUnit> Crs::horizontal_unit() const {
    return impl_->horizontal_unit;
}
std::optional<LengthUnit> Crs::vertical_unit() const {
    return impl_->vertical_unit;
}
bool Crs::on_ellipsoid() const {
    return impl_->on_ellipsoid;
}

// ---- CoordinateTransform ----

namespace {

struct AreaDelete {
    void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
};
using AreaPtr = std::unique_ptr<PJ_AREA, AreaDelete>;

/// The smallest range of longitudes that holds all: what is left of the circle without its widest gap.
/// The first may be east of the second: the range crosses the antimeridian.
std::pair<double, double> longitude_range(std::vector<double> longitudes) {
    std::sort(longitudes.begin(), longitudes.end());
    std::pair<double, double> range{longitudes.front(), longitudes.back()};
    double widest = longitudes.front() + 360 - longitudes.back();
    for (std::size_t i = 1; i < longitudes.size(); ++i) {
        if (longitudes[i] - longitudes[i - 1] > widest) {
            widest = longitudes[i] - longitudes[i - 1];
            range = {longitudes[i], longitudes[i - 1]};
        }
    }
    return range;
}

/// @returns null where nothing is known of the area: PROJ then goes by the CRSs' areas of use
AreaPtr area_of(const PJ* crs, std::span<const Position> positions) {
    const std::unique_ptr<LonLat> lon_lat = lon_lat_of(crs);
    if (!lon_lat)
        return nullptr;
    std::vector<Position> places(positions.begin(), positions.end());
    lon_lat->apply(places);
    std::erase_if(places, [](const Position& p) { return !is_finite(p); });
    if (places.empty())
        return nullptr;
    double south = 90;
    double north = -90;
    std::vector<double> longitudes;
    for (const Position& p : places) {
        longitudes.push_back(std::remainder(p.x + lon_lat->prime_meridian, 360.0));
        south = std::min(south, p.y);
        north = std::max(north, p.y);
    }
    const auto [west, east] = longitude_range(std::move(longitudes));
    AreaPtr area(proj_area_create());
    proj_area_set_bbox(area.get(), west, south, east, north);
    return area;
}

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
    PjPtr operation;  ///< null where both CRSs are the same
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
    // Heights are not transformed, so the vertical parts of compounds must not stand in the way.
    PJ_CONTEXT* context = impl_->context.get();
    const PjPtr source(proj_clone(context, from.impl().horizontal.get()));
    const PjPtr target(proj_clone(context, to.impl().horizontal.get()));
    impl_->operation = operation_between(context, source.get(), target.get(),
                                         area_of(from.impl().horizontal.get(), area).get());
    if (!impl_->operation)
        throw OptionError("PROJ knows no operation from " + quoted(from.name()) + " to " + quoted(to.name()) +
                          "; choose a coordinate reference system that the coordinates can be brought to.");
}

CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;
CoordinateTransform::~CoordinateTransform() = default;

void CoordinateTransform::apply(std::span<Position> positions) {
    std::vector<Position>& images = impl_->images;
    images.assign(positions.begin(), positions.end());
    if (impl_->operation)
        transform(impl_->operation.get(), images);
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(images[i]))
            throw InputError("Position " + text_of(positions[i]) + " of " + quoted(impl_->from) +
                             " has no image in " + quoted(impl_->to) +
                             "; check which coordinate reference system the coordinates are in.");
    std::copy(images.begin(), images.end(), positions.begin());
}

// ---- Geodesy ----

namespace {

double squared_length(const Position& v) {
    return v.x * v.x + v.y * v.y;
}

Position at(const Position& start, const Position& along, double share) {
    return {start.x + along.x * share, start.y + along.y * share};
}

/// About the first position, where differences of large coordinates are exact enough.
Geodesy::Measure planar_ring(std::span<const Position> ring, double metres) {
    double twice_area = 0;
    double perimeter = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i];
        const Position& q = ring[(i + 1) % ring.size()];
        if (!is_finite(p))
            throw InputError("Position " + text_of(p) + " is not finite; check the georeferencing.");
        const Position& o = ring[0];
        twice_area += (p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y);
        perimeter += std::hypot(q.x - p.x, q.y - p.y);
    }
    return {std::abs(twice_area) / 2 * metres * metres, perimeter * metres};
}

/// Polygons of geodesics on an ellipsoid. Positions are longitudes and latitudes in degrees.
class GeodesicPolygon {
  public:
    GeodesicPolygon(double radius, double flattening) : earth_(radius, flattening), wide_(earth_) {}

    [[nodiscard]] Geodesy::Measure measure(std::span<const Position> places);
    [[nodiscard]] double sag(const Position& a, const Position& middle, const Position& b) const;

  private:
    [[nodiscard]] Geodesy::Measure measure_near(std::span<const Position> places) const;

    GeographicLib::Geodesic earth_;
    GeographicLib::PolygonArea wide_;
};

/// PolygonArea adds areas between edges and the equator, whose rounding (up to 1e-5 m2 an edge) is felt in a
/// house.
Geodesy::Measure GeodesicPolygon::measure(std::span<const Position> places) {
    constexpr double near = 0.15;  // degrees of a great circle, about 17 km
    const Position& first = places[0];
    const double shrink = std::cos(first.y * GeographicLib::Math::degree());
    if (std::all_of(places.begin(), places.end(), [&](const Position& p) {
            return std::abs(p.y - first.y) <= near &&
                   std::abs(std::remainder(p.x - first.x, 360.0)) * shrink <= near;
        }))
        return measure_near(places);
    wide_.Clear();
    for (const Position& p : places)
        wide_.AddPoint(p.y, p.x);
    Geodesy::Measure result;
    wide_.Compute(false, true, result.perimeter_m, result.area_m2);
    result.area_m2 = std::abs(result.area_m2);
    return result;
}

/// A fan of geodesic triangles about the first place. Each has two sides and the angle between them; within
/// 50 km it is that of the sphere with the ellipsoid's curvature here, to 1e-9 of its area.
Geodesy::Measure GeodesicPolygon::measure_near(std::span<const Position> places) const {
    struct Ray {
        double length = 0;   ///< over the radius
        double azimuth = 0;  ///< radians
        double sine = 0;     ///< of the length
        double half_tangent = 0;
    };
    const Position& first = places[0];
    const double e2 = earth_.Flattening() * (2 - earth_.Flattening());
    const double sine = std::sin(first.y * GeographicLib::Math::degree());
    const double radius = earth_.EquatorialRadius() * std::sqrt(1 - e2) / (1 - e2 * sine * sine);
    double half_excess = 0;
    double perimeter = 0;
    Ray last;
    for (std::size_t i = 1; i <= places.size(); ++i) {
        Ray ray;
        if (i < places.size()) {
            double unused = 0;
            earth_.Inverse(first.y, first.x, places[i].y, places[i].x, ray.length, ray.azimuth, unused);
            ray.length /= radius;
            ray.azimuth *= GeographicLib::Math::degree();
            ray.sine = std::sin(ray.length);
            ray.half_tangent = std::tan(ray.length / 2);
        }
        const double angle = ray.azimuth - last.azimuth;
        const double tangents = ray.half_tangent * last.half_tangent;
        half_excess += std::atan2(tangents * std::sin(angle), 1 + tangents * std::cos(angle));
        const double across = std::sin(angle / 2);
        const double along = std::sin((ray.length - last.length) / 2);
        perimeter += 2 * std::asin(std::sqrt(along * along + ray.sine * last.sine * across * across));
        last = ray;
    }
    return {2 * std::abs(half_excess) * radius * radius, perimeter * radius};
}

/// Distance of the middle of an edge from the geodesic a b, metres. Only across: the middle of the edge need
/// not be the middle of the geodesic. Good to some nanometres.
double GeodesicPolygon::sag(const Position& a, const Position& middle, const Position& b) const {
    double distance = 0;
    double azimuth_middle = 0;
    double azimuth_b = 0;
    double unused = 0;
    earth_.Inverse(a.y, a.x, b.y, b.x, azimuth_b, unused);
    earth_.Inverse(a.y, a.x, middle.y, middle.x, distance, azimuth_middle, unused);
    return std::abs(distance * std::sin((azimuth_middle - azimuth_b) * GeographicLib::Math::degree()));
}

/// Rings whose edges are straight in a CRS, from polygons of geodesics.
///
/// An edge and the geodesic between its ends enclose about 2/3 * length * sag, where sag is the distance of
/// the edge's middle from the geodesic. With no sag above 3/2 * share * area / perimeter, what all edges
/// leave out is below `share` of the area; an edge in n pieces sags by 1/n^2. Because the sag of a short edge
/// is at most bend * length^2, where bend is a property of the place, short edges need not be looked at.
class GeodesicMeter {
  public:
    /// @param step  length in units of the CRS above which edges are cut without looking
    /// @param turn  units of the CRS in a full circle of longitude, 0 where the coordinates are no angles
    GeodesicMeter(std::unique_ptr<LonLat> lon_lat, std::string name, double step, double turn)
        : lon_lat_(std::move(lon_lat)),
          name_(std::move(name)),
          step_(step),
          turn_(turn),
          polygon_(lon_lat_->radius, lon_lat_->flattening) {}

    [[nodiscard]] Geodesy::Measure ring(std::span<const Position> ring);

  private:
    /// Of a fixed grid over the CRS; its cells double in size from level to level.
    struct Tile {
        int level = 0;
        std::int64_t col = 0;
        std::int64_t row = 0;
        auto operator<=>(const Tile&) const = default;
    };

    [[nodiscard]] Position edge(std::size_t corner) const;
    [[nodiscard]] double longest_squared() const;
    void locate(std::span<const Position> positions, std::span<Position> places) const;
    [[nodiscard]] Position locate(const Position& position) const;
    void cut_long_edges();
    [[nodiscard]] double tile_size(int level) const { return std::ldexp(step_ / 8, level); }
    [[nodiscard]] double bend();
    [[nodiscard]] double measure_bend(const Tile& tile) const;
    [[nodiscard]] Geodesy::Measure measure_cut();
    void cut(const Position& start, const Position& along, const Position& a, const Position& b,
             int halvings);

    std::unique_ptr<LonLat> lon_lat_;
    std::string name_;
    double step_;
    double turn_;
    GeodesicPolygon polygon_;
    std::map<Tile, double> bends_;
    // Of the ring at hand, kept for their memory.
    std::vector<Position> corners_;  ///< in the CRS
    std::vector<Position> places_;   ///< of the corners
    std::vector<Position> outline_;  ///< places of the corners and of the pieces between them
    double largest_sag_ = 0;         ///< metres
    double harmless_squared_ = 0;    ///< units of the CRS, squared
};

/// From a corner to the next. More than half a turn of longitude is a ring that crosses the antimeridian.
Position GeodesicMeter::edge(std::size_t corner) const {
    const Position& a = corners_[corner];
    const Position& b = corners_[corner + 1 == corners_.size() ? 0 : corner + 1];
    Position along{b.x - a.x, b.y - a.y};
    if (turn_ > 0 && std::abs(along.x) > turn_ / 2)
        along.x = std::remainder(along.x, turn_);
    return along;
}

double GeodesicMeter::longest_squared() const {
    double longest = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        longest = std::max(longest, squared_length(edge(i)));
    return longest;
}

/// To longitude and latitude.
void GeodesicMeter::locate(std::span<const Position> positions, std::span<Position> places) const {
    const double farthest = 20000 * step_;  // some projections wrap around and around
    std::copy(positions.begin(), positions.end(), places.begin());
    lon_lat_->apply(places);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(places[i]) || std::abs(positions[i].x) > farthest)
            throw InputError("Position " + text_of(positions[i]) + " of " + quoted(name_) +
                             " has no longitude and latitude; check which coordinate reference system the "
                             "coordinates are in.");
}

Position GeodesicMeter::locate(const Position& position) const {
    Position place;
    locate({&position, 1}, {&place, 1});
    return place;
}

/// The middle of an edge across half the globe says nothing about it.
void GeodesicMeter::cut_long_edges() {
    std::vector<Position> cut_corners;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Position along = edge(i);
        const double pieces = std::max(1.0, std::ceil(std::sqrt(squared_length(along)) / step_));
        for (double piece = 0; piece < pieces; ++piece)
            cut_corners.push_back(at(corners_[i], along, piece / pieces));
    }
    corners_ = std::move(cut_corners);
    places_.resize(corners_.size());
    locate(corners_, places_);
}

/// How much edges bend in the neighbourhood of the ring: no edge there has a sag (in metres) above bend *
/// length^2 (in units of the CRS). Found once for each tile of a fixed grid, so that no result depends on
/// earlier rings.
double GeodesicMeter::bend() {
    Position low = corners_[0];
    Position high = corners_[0];
    for (const Position& p : corners_) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    constexpr int most_levels = 8;
    Tile tile;
    while (tile.level < most_levels && tile_size(tile.level) < std::max(high.x - low.x, high.y - low.y))
        ++tile.level;
    const double size = tile_size(tile.level);
    if (tile.level == most_levels)
        return std::numeric_limits<double>::infinity();  // every edge is looked at
    tile.col = std::llround((low.x + high.x) / 2 / size);
    tile.row = std::llround((low.y + high.y) / 2 / size);
    const auto [found, is_new] = bends_.try_emplace(tile);
    if (is_new)
        found->second = measure_bend(tile);
    return found->second;
}

/// From chords in four directions on a lattice of 5 x 5 places that reaches a tile's size to all sides of the
/// tile's centre (a ring no larger than the tile reaches that far), doubled for what lies between.
double GeodesicMeter::measure_bend(const Tile& tile) const {
    constexpr int n = 5;
    const double size = tile_size(tile.level);
    std::array<Position, std::size_t{n * n}> places;
    const auto place = [&](int col, int row) -> Position& {
        return places[static_cast<std::size_t>(row * n + col)];
    };
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col)
            place(col, row) = {(static_cast<double>(tile.col) + col / 2.0 - 1) * size,
                               (static_cast<double>(tile.row) + row / 2.0 - 1) * size};
    lon_lat_->apply(places);
    if (!std::all_of(places.begin(), places.end(), is_finite))
        return std::numeric_limits<double>::infinity();

    static constexpr std::array<std::pair<int, int>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    const auto inside = [](int index, int reach) {
        return index >= std::abs(reach) && index + std::abs(reach) < n;
    };
    double largest = 0;
    for (const auto& [dx, dy] : directions)
        for (int row = 0; row < n; ++row)
            for (int col = 0; col < n; ++col)
                if (inside(col, dx) && inside(row, dy))
                    largest = std::max(largest, polygon_.sag(place(col - dx, row - dy), place(col, row),
                                                             place(col + dx, row + dy)) /
                                                    (size * size * (dx * dx + dy * dy)));
    return 2 * largest;
}

/// With edges cut where they are longer than harmless and sag by more than largest_sag_.
Geodesy::Measure GeodesicMeter::measure_cut() {
    constexpr int most_halvings = 30;
    outline_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Position& place = places_[i];
        outline_.push_back(place);
        cut(corners_[i], edge(i), place, places_[i + 1 == corners_.size() ? 0 : i + 1], most_halvings);
    }
    return polygon_.measure(outline_);
}

/// Adds what an edge needs between its ends.
/// @param along in the CRS, from start to end @param a, b places of its ends
void GeodesicMeter::cut(const Position& start, const Position& along, const Position& a, const Position& b,
                        int halvings) {
    const double squared = squared_length(along);
    if (halvings == 0 || squared <= harmless_squared_)
        return;
    const Position middle = at(start, along, 0.5);
    const Position place = locate(middle);
    const double sag = polygon_.sag(a, place, b);
    if (sag <= largest_sag_)
        return;
    const double pieces = std::ceil(std::sqrt(sag / largest_sag_));
    if (pieces <= 2) {
        outline_.push_back(place);
    } else if (squared <= tile_size(0) * tile_size(0)) {  // the bend is the same all along
        for (double piece = 1; piece < pieces; ++piece)
            outline_.push_back(locate(at(start, along, piece / pieces)));
    } else {
        const Position half{along.x / 2, along.y / 2};
        cut(start, half, a, place, halvings - 1);
        outline_.push_back(place);
        cut(middle, half, place, b, halvings - 1);
    }
}

Geodesy::Measure GeodesicMeter::ring(std::span<const Position> ring) {
    constexpr double share = 0.8e-7;                     // promised is 1e-7
    const double finest_sag = 3e-15 * lon_lat_->radius;  // metres; below, it is rounding that is measured
    corners_.assign(ring.begin(), ring.end());
    places_.resize(ring.size());
    locate(corners_, places_);
    if (ring.size() < 2)
        return {};
    if (longest_squared() > step_ * step_)
        cut_long_edges();
    Geodesy::Measure measure = polygon_.measure(places_);
    if (!(measure.perimeter_m > 0))
        return measure;
    // How much may be left out is unknown before the area is; a narrow ring may turn out smaller than it was.
    const double longest = longest_squared();
    const double bend_here = bend();
    for (double believed = std::numeric_limits<double>::infinity(); measure.area_m2 < believed / 2;) {
        believed = measure.area_m2;
        largest_sag_ = std::max(1.5 * share * measure.area_m2 / measure.perimeter_m, finest_sag);
        harmless_squared_ = largest_sag_ / bend_here;
        if (longest <= harmless_squared_)
            break;
        measure = measure_cut();
    }
    return measure;
}

/// Units of the CRS in some 50 km on the earth, or half a degree.
double longest_edge(const Crs::Impl& crs, double radius) {
    if (crs.angular_unit > 0)
        return 0.5 / crs.angular_unit;
    return radius / 128 / (crs.horizontal_unit ? crs.horizontal_unit->metres : 1);
}

}  // namespace

struct Geodesy::Impl {
    std::optional<GeodesicMeter> geodesic;  ///< empty: planar
    double metres = 1;                      ///< in one unit, where planar
};

Geodesy::Geodesy(const Crs& crs) : impl_(std::make_unique<Impl>()) {
    const Crs::Impl& definition = crs.impl();
    if (definition.horizontal_unit)
        impl_->metres = definition.horizontal_unit->metres;
    std::unique_ptr<LonLat> lon_lat =
        definition.on_ellipsoid ? lon_lat_of(definition.horizontal.get()) : nullptr;
    if (!lon_lat)
        return;
    const double step = longest_edge(definition, lon_lat->radius);
    const double turn = definition.angular_unit > 0 ? 360 / definition.angular_unit : 0;
    impl_->geodesic.emplace(std::move(lon_lat), definition.name, step, turn);
}

Geodesy::Geodesy(Geodesy&&) noexcept = default;
Geodesy& Geodesy::operator=(Geodesy&&) noexcept = default;
Geodesy::~Geodesy() = default;

bool Geodesy::geodesic() const {
    return impl_->geodesic.has_value();
}

Geodesy::Measure Geodesy::ring(std::span<const Position> ring) {
    return impl_->geodesic ? impl_->geodesic->ring(ring) : planar_ring(ring, impl_->metres);
}

Geodesy::Measure Geodesy::polygon(const WorldPolygon& polygon) {
    Measure sum = ring(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors) {
        const Measure hole = ring(interior);
        sum.area_m2 -= hole.area_m2;
        sum.perimeter_m += hole.perimeter_m;
    }
    sum.area_m2 = std::max(sum.area_m2, 0.0);
    return sum;
}

}  // namespace d2b
