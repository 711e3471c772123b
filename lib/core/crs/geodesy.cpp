#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolygonArea.hpp>

#include "core/crs.hpp"
#include "core/crs/crs_impl.hpp"
#include "core/crs/local_metric.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/proj.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Polygons of geodesics on an ellipsoid. Positions are longitudes and latitudes in degrees.
class GeodesicPolygon {
  public:
    GeodesicPolygon(double radius, double flattening) : earth_(radius, flattening), wide_(earth_) {}

    /// @param places at least one
    [[nodiscard]] Geodesy::Measure measure(std::span<const Position> places);
    /// Returns the distance in metres of the midpoint of an edge from the geodesic a b, measured across it,
    /// because the midpoint of the edge need not be that of the geodesic. Accurate to some nanometres.
    [[nodiscard]] double sag(const Position& a, const Position& middle, const Position& b) const;

  private:
    [[nodiscard]] Geodesy::Measure measure_near(std::span<const Position> places) const;

    GeographicLib::Geodesic earth_;
    GeographicLib::PolygonArea wide_;
};

/// Square of a fixed grid over a CRS. The size of tiles doubles from level to level.
struct MapTile {
    int level = 0;
    std::int64_t col = 0;
    std::int64_t row = 0;
    auto operator<=>(const MapTile&) const = default;
};

/// Values of places in a CRS, each computed once per tile, so that results do not depend on earlier rings.
template <typename Value>
class TileCache {
  public:
    /// @param smallest side of the tiles of level 0, units of the CRS @param levels number of levels
    TileCache(double smallest, int levels) : smallest_(smallest), levels_(levels) {}

    /// Returns make(tile, side of the tile) for a tile around a ring; null if there is no such tile.
    /// @param corners at least one
    template <typename Make>
    [[nodiscard]] const Value* around(std::span<const Position> corners, const Make& make) {
        const std::optional<MapTile> tile = tile_around(corners);
        if (!tile)
            return nullptr;
        const auto [found, is_new] = values_.try_emplace(*tile);
        if (is_new)
            found->second = make(*tile, std::ldexp(smallest_, tile->level));
        return &found->second;
    }

  private:
    [[nodiscard]] std::optional<MapTile> tile_around(std::span<const Position> corners) const;

    double smallest_;
    int levels_;
    std::map<MapTile, Value> values_;
};

/// Returns a tile near whose centre a ring lies, on the lowest level on which the ring is no larger than a
/// tile; nothing if no level is high enough, or a position is not finite or too far away.
template <typename Value>
std::optional<MapTile> TileCache<Value>::tile_around(std::span<const Position> corners) const {
    constexpr double farthest = 1e15;  // tiles; up to here they are numbered exactly
    Position low = corners[0];
    Position high = corners[0];
    for (const Position& p : corners) {
        if (!is_finite(p))
            return std::nullopt;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    MapTile tile;
    while (tile.level < levels_ &&
           std::ldexp(smallest_, tile.level) < std::max(high.x - low.x, high.y - low.y))
        ++tile.level;
    const double size = std::ldexp(smallest_, tile.level);
    const Position place{(low.x + high.x) / 2 / size, (low.y + high.y) / 2 / size};
    if (tile.level == levels_ || !(std::max(std::abs(place.x), std::abs(place.y)) < farthest))
        return std::nullopt;
    tile.col = std::llround(place.x);
    tile.row = std::llround(place.y);
    return tile;
}

/// Measures rings whose edges are straight in a CRS. Rings of up to a few kilometres use the local metric;
/// others, and those near poles, are densified into polygons of geodesics.
///
/// An edge and the geodesic between its ends enclose about 2/3 * length * sag, where sag is the distance of
/// the edge's midpoint from the geodesic. If no sag exceeds 3/2 * share * area / perimeter, the total error
/// is below `share` of the area; an edge in n pieces sags by 1/n^2. Because the sag of a short edge is at
/// most bend * length^2, and the bend depends only on the location, short edges need not be checked.
class GeodesicRingMeasurer {
  public:
    /// @param name of the CRS @param step length in units of the CRS above which edges are always divided
    /// @param turn full circle of longitude in units of the CRS, 0 if the coordinates are not angles
    GeodesicRingMeasurer(std::unique_ptr<LonLat> lon_lat, std::string name, double step, double turn,
                         StopToken stop)
        : lon_lat_(std::move(lon_lat)),
          name_(std::move(name)),
          step_(step),
          turn_(turn),
          stop_(std::move(stop)),
          polygon_(lon_lat_->radius, lon_lat_->flattening),
          tile_(step / 8),
          metrics_(tile_, 3),
          bends_(tile_, 8) {}

    /// @throws InputError if a position has no longitude and latitude
    [[nodiscard]] Geodesy::Measure ring(std::span<const Position> ring);

  private:
    [[nodiscard]] Position edge(std::size_t corner) const;
    [[nodiscard]] double longest_squared() const;
    void locate(std::span<const Position> positions, std::span<Position> places) const;
    [[nodiscard]] Position locate(const Position& position) const;
    void cut_long_edges();
    [[nodiscard]] Geodesy::Measure measure_cut();
    void cut(const Position& start, const Position& along, const Position& a, const Position& b,
             int halvings);

    std::unique_ptr<LonLat> lon_lat_;
    std::string name_;
    double step_;
    double turn_;
    StopToken stop_;
    GeodesicPolygon polygon_;
    double tile_;  ///< length over which the bend may be considered constant, in units of the CRS
    TileCache<std::optional<LocalMetric>> metrics_;
    TileCache<double> bends_;
    // State of the current ring, kept to reuse memory.
    std::vector<Position> corners_;  ///< coordinates in the CRS
    std::vector<Position> places_;   ///< longitude and latitude of the corners
    std::vector<Position>
        outline_;             ///< longitude and latitude of the corners and of the points added between them
    double largest_sag_ = 0;  ///< metres
    double harmless_length_squared_ =
        0;                        ///< squared length of edges that need no division, in units of the CRS
    std::size_t max_places_ = 0;  ///< limit of outline_, so that a sliver around the Earth terminates, too
};

/// Small rings are measured separately, because PolygonArea sums areas between edges and the equator, whose
/// rounding errors (up to 1e-5 m2 per edge) matter for a house.
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

/// Sums a fan of geodesic triangles about the first position, each with two sides and the angle between them.
/// Within 50 km, a triangle on the sphere with the local Gaussian curvature is accurate to 1e-9 of its area.
Geodesy::Measure GeodesicPolygon::measure_near(std::span<const Position> places) const {
    struct Ray {
        double length = 0;   ///< divided by the radius
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

double GeodesicPolygon::sag(const Position& a, const Position& middle, const Position& b) const {
    double distance = 0;
    double azimuth_middle = 0;
    double azimuth_b = 0;
    double unused = 0;
    earth_.Inverse(a.y, a.x, b.y, b.x, azimuth_b, unused);
    earth_.Inverse(a.y, a.x, middle.y, middle.x, distance, azimuth_middle, unused);
    return std::abs(distance * std::sin((azimuth_middle - azimuth_b) * GeographicLib::Math::degree()));
}

namespace {

/// Returns the bend of straight edges of a CRS near a tile: no edge there has a sag (in metres) above bend *
/// length^2 (in units of the CRS). Takes the largest sag of chords in four directions on a lattice of 5 x 5
/// positions that extends one tile size to all sides of the tile's centre (as far as a ring no larger than
/// the tile reaches), doubled because of the gaps between them.
double bend_near(const MapTile& tile, double size, const LonLat& lon_lat, const GeodesicPolygon& polygon) {
    constexpr int n = 5;
    std::array<Position, std::size_t{n} * n> places;
    const auto place = [&](int col, int row) -> Position& {
        return places[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(col)];
    };
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col)
            place(col, row) = {(static_cast<double>(tile.col) + col / 2.0 - 1) * size,
                               (static_cast<double>(tile.row) + row / 2.0 - 1) * size};
    lon_lat.apply(places);
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
                    largest = std::max(largest, polygon.sag(place(col - dx, row - dy), place(col, row),
                                                            place(col + dx, row + dy)) /
                                                    (size * size * (dx * dx + dy * dy)));
    return 2 * largest;
}

}  // namespace

/// Returns the vector to the next corner. If it exceeds half a turn of longitude, the ring crosses the
/// antimeridian.
Position GeodesicRingMeasurer::edge(std::size_t corner) const {
    const Position& a = corners_[corner];
    const Position& b = corners_[corner + 1 == corners_.size() ? 0 : corner + 1];
    Position along{b.x - a.x, b.y - a.y};
    if (turn_ > 0 && std::abs(along.x) > turn_ / 2)
        along.x = std::remainder(along.x, turn_);
    return along;
}

double GeodesicRingMeasurer::longest_squared() const {
    double longest = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        longest = std::max(longest, squared_length(edge(i)));
    return longest;
}

/// Converts to longitude and latitude.
void GeodesicRingMeasurer::locate(std::span<const Position> positions, std::span<Position> places) const {
    const double farthest = 20000 * step_;  // some projections wrap around repeatedly
    std::copy(positions.begin(), positions.end(), places.begin());
    lon_lat_->apply(places);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_finite(positions[i]) || !is_finite(places[i]) || std::abs(positions[i].x) > farthest)
            throw InputError("Position " + position_text(positions[i]) + " of " + in_quotes(name_) +
                             " has no longitude and latitude; check which coordinate reference system the "
                             "coordinates are in.");
}

Position GeodesicRingMeasurer::locate(const Position& position) const {
    Position place;
    locate({&position, 1}, {&place, 1});
    return place;
}

/// Divides edges longer than step_, because the midpoint of an edge across half the globe is not
/// representative.
void GeodesicRingMeasurer::cut_long_edges() {
    std::vector<Position> cut_corners;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Position along = edge(i);
        const double pieces = std::max(1.0, std::ceil(std::sqrt(squared_length(along)) / step_));
        for (std::int64_t piece = 0; piece < static_cast<std::int64_t>(pieces); ++piece)
            cut_corners.push_back(point_along(corners_[i], along, static_cast<double>(piece) / pieces));
    }
    corners_ = std::move(cut_corners);
    places_.resize(corners_.size());
    locate(corners_, places_);
}

/// Measures with edges divided if they are longer than harmless and sag by more than largest_sag_.
Geodesy::Measure GeodesicRingMeasurer::measure_cut() {
    constexpr int most_halvings = 30;
    constexpr std::size_t most_cuts = std::size_t{1} << 18;  // a second or so
    max_places_ = corners_.size() + most_cuts;
    outline_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        stop_.check();
        const Position& place = places_[i];
        outline_.push_back(place);
        cut(corners_[i], edge(i), place, places_[i + 1 == corners_.size() ? 0 : i + 1], most_halvings);
    }
    return polygon_.measure(outline_);
}

/// Adds the points that an edge needs between its ends. @param along vector from start to end in the CRS
/// @param a, b longitude and latitude of its ends
// NOLINTNEXTLINE(misc-no-recursion): it ends with the halvings
void GeodesicRingMeasurer::cut(const Position& start, const Position& along, const Position& a,
                               const Position& b, int halvings) {
    const double squared = squared_length(along);
    if (halvings == 0 || squared <= harmless_length_squared_)
        return;
    const auto room = static_cast<double>(max_places_ - std::min(max_places_, outline_.size()));
    if (room < 1)
        return;
    const Position middle = point_along(start, along, 0.5);
    const Position place = locate(middle);
    const double sag = polygon_.sag(a, place, b);
    if (sag <= largest_sag_)
        return;
    const double pieces = std::min(room, std::ceil(std::sqrt(sag / largest_sag_)));
    if (pieces <= 2) {
        outline_.push_back(place);
    } else if (squared <= tile_ * tile_) {  // the bend is constant along the edge
        for (std::int64_t piece = 1; piece < static_cast<std::int64_t>(pieces); ++piece)
            outline_.push_back(locate(point_along(start, along, static_cast<double>(piece) / pieces)));
    } else {
        const Position half{along.x / 2, along.y / 2};
        cut(start, half, a, place, halvings - 1);
        outline_.push_back(place);
        cut(middle, half, place, b, halvings - 1);
    }
}

Geodesy::Measure GeodesicRingMeasurer::ring(std::span<const Position> ring) {
    constexpr double share = 0.8e-7;                     // below the promised 1e-7
    const double finest_sag = 3e-15 * lon_lat_->radius;  // metres; smaller sags are only rounding errors
    if (ring.empty())
        return {};
    const auto* const metric = metrics_.around(ring, [&](const MapTile& tile, double size) {
        return LocalMetric::fit({static_cast<double>(tile.col) * size, static_cast<double>(tile.row) * size},
                                size, *lon_lat_);
    });
    if (metric != nullptr && *metric)
        return (*metric)->ring(ring);
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
    // The tolerance depends on the area, which is unknown at first. Repeat, because a narrow ring may turn
    // out smaller than it seemed.
    const double longest = longest_squared();
    const double* const bend = bends_.around(corners_, [&](const MapTile& tile, double size) {
        return bend_near(tile, size, *lon_lat_, polygon_);
    });
    const double bend_here =
        bend != nullptr ? *bend : std::numeric_limits<double>::infinity();  // then every edge is checked
    for (double believed = std::numeric_limits<double>::infinity(); measure.area_m2 < believed / 2;) {
        believed = measure.area_m2;
        largest_sag_ = std::max(1.5 * share * measure.area_m2 / measure.perimeter_m, finest_sag);
        harmless_length_squared_ = largest_sag_ / bend_here;
        if (longest <= harmless_length_squared_)
            break;
        measure = measure_cut();
    }
    return measure;
}

namespace {

/// Relative to the first position, because differences of large coordinates are exact enough.
Geodesy::Measure planar_ring(std::span<const Position> ring, double metres) {
    double twice_area = 0;
    double perimeter = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i];
        const Position& q = ring[(i + 1) % ring.size()];
        if (!is_finite(p))
            throw InputError("Position " + position_text(p) + " is not finite; check the georeferencing.");
        const Position& o = ring[0];
        twice_area += (p.x - o.x) * (q.y - o.y) - (q.x - o.x) * (p.y - o.y);
        perimeter += std::hypot(q.x - p.x, q.y - p.y);
    }
    return {std::abs(twice_area) / 2 * metres * metres, perimeter * metres};
}

/// Returns some 50 km on the ground, or half a degree, in units of the CRS.
double longest_edge(const Crs::Impl& crs, double radius) {
    if (crs.angular_unit > 0)
        return 0.5 / crs.angular_unit;
    return radius / 128 / (crs.horizontal_unit ? crs.horizontal_unit->metres : 1);
}

}  // namespace

struct Geodesy::Impl {
    std::optional<GeodesicRingMeasurer> geodesic;  ///< empty if planar
    double metres = 1;                             ///< in one unit, if planar
    StopToken stop;
};

Geodesy::Geodesy(const Crs& crs, StopToken stop) : impl_(std::make_unique<Impl>()) {
    impl_->stop = std::move(stop);
    const Crs::Impl& definition = crs.impl();
    if (definition.horizontal_unit)
        impl_->metres = definition.horizontal_unit->metres;
    std::unique_ptr<LonLat> lon_lat = definition.lon_lat ? definition.lon_lat->copy() : nullptr;
    if (!lon_lat)
        return;
    const double step = longest_edge(definition, lon_lat->radius);
    impl_->geodesic.emplace(std::move(lon_lat), definition.name, step, crs.turn(), impl_->stop);
}

Geodesy::Geodesy(Geodesy&&) noexcept = default;
Geodesy& Geodesy::operator=(Geodesy&&) noexcept = default;
Geodesy::~Geodesy() = default;

Geodesy::Measure Geodesy::ring(std::span<const Position> ring) {
    return impl_->geodesic ? impl_->geodesic->ring(ring) : planar_ring(ring, impl_->metres);
}

Geodesy::Measure Geodesy::polygon(const WorldPolygon& polygon) {
    Measure sum = ring(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors) {
        impl_->stop.check();
        const Measure hole = ring(interior);
        sum.area_m2 -= hole.area_m2;
        sum.perimeter_m += hole.perimeter_m;
    }
    sum.area_m2 = std::max(sum.area_m2, 0.0);
    return sum;
}

}  // namespace d2b
