#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/stop_token.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Unit of length.
struct LengthUnit {
    std::string name;   ///< "metre", "foot", "US survey foot", ...
    double metres = 1;  ///< metres in one unit
};

/// Coordinate reference system, read with PROJ. A value type: copies share one immutable definition. Not
/// thread-safe.
class Crs {
  public:
    enum class Kind { none, projected, geographic, local, other };

    /// Constructs the absence of a CRS.
    Crs();
    /// @param text WKT of any version, an authority code ("EPSG:25832", compounds "EPSG:25832+7837"),
    /// PROJJSON, a PROJ string or a name; "" gives no CRS. A bare name must be the whole name, except for
    /// case, spaces and punctuation.
    /// @throws OptionError with PROJ's reason if it is none of these
    explicit Crs(std::string_view text);

    [[nodiscard]] Kind kind() const;
    [[nodiscard]] std::string name() const;  ///< "" if there is no CRS
    [[nodiscard]] std::string wkt() const;   ///< WKT2:2019; "" if there is no CRS
    /// Returns the OGC URL of the whole CRS with its heights, e.g.
    /// "https://www.opengis.net/def/crs/EPSG/0/7415"; "" if neither the CRS nor PROJ's database has an
    /// authority code for it.
    [[nodiscard]] std::string url() const;
    /// Returns the OGC URL of the horizontal part.
    [[nodiscard]] std::string horizontal_url() const;
    /// Returns the unit of the horizontal axes; empty if they are angles or there is no CRS.
    [[nodiscard]] std::optional<LengthUnit> horizontal_unit() const;
    /// Returns a full circle of longitude in units of the horizontal axes; 0 if they are lengths or there is
    /// no CRS.
    [[nodiscard]] double turn() const;
    /// Returns the unit of the vertical part of a compound CRS or of the height axis of a 3D CRS, if there is
    /// one.
    [[nodiscard]] std::optional<LengthUnit> vertical_unit() const;
    /// Returns true if positions have longitude and latitude on an ellipsoid, so that areas are geodesic.
    /// False also if PROJ does not know the projection.
    [[nodiscard]] bool on_ellipsoid() const;

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::shared_ptr<const Impl> impl_;
};

/// Checks that a CRS suits a raster: projected, geographic or local, or none. @param option that gave the CRS
/// ("-a_srs EPSG:5773"), "" if it is the raster's own @param input name of the raster @throws OptionError, or
/// InputError if no option gave the CRS
void require_plane(const Crs& crs, const std::string& option, const std::string& input);

/// Guesses the intended code if the authority is missing: "EPSG:4326" for "4326", "4326+5773" or "epsg4326";
/// otherwise "".
[[nodiscard]] std::string guess_epsg_code(std::string_view text);

/// Returns the smallest range that holds all longitudes: the circle without its widest gap. If the first is
/// east of the second, the range crosses the antimeridian. @param places x is a longitude; not empty
/// @param turn full circle in their unit
[[nodiscard]] std::pair<double, double> longitude_range(std::span<const Position> places, double turn);

/// Transforms positions between CRSs with PROJ, axes in GIS order on both sides. The vertical parts of
/// compound CRSs are ignored: heights are not transformed.
class CoordinateTransform {
  public:
    /// @param area positions (in `from`) that span the area of interest, from which PROJ picks the best
    /// operation @throws OptionError if there is no operation between the two
    CoordinateTransform(const Crs& from, const Crs& to, std::span<const Position> area);
    CoordinateTransform(CoordinateTransform&&) noexcept;
    CoordinateTransform& operator=(CoordinateTransform&&) noexcept;
    ~CoordinateTransform();

    /// Transforms in place. @throws InputError naming the first position that cannot be transformed; all
    /// positions are unchanged then
    void apply(std::span<Position> positions);
    /// Transforms in place; positions that cannot be transformed become infinite or NaN. @return true if all
    /// could
    [[nodiscard]] bool try_apply(std::span<Position> positions);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Measures areas and lengths on the ellipsoid of a CRS with GeographicLib.
///
/// Planar if the CRS has no ellipsoid (local coordinates, no CRS) or PROJ does not know its projection: then
/// in square metres by its horizontal unit, or in plain units. Edges are straight in the CRS: long ones are
/// densified until the error is below 1e-7 of the area. In a geographic CRS, edges of more than half a turn
/// of longitude take the short way, across the antimeridian. Not thread-safe.
class Geodesy {
  public:
    /// @param stop checked between rings and within long ones, which then throw Cancelled
    explicit Geodesy(const Crs& crs, StopToken stop = {});
    Geodesy(Geodesy&&) noexcept;
    Geodesy& operator=(Geodesy&&) noexcept;
    ~Geodesy();

    struct Measure {
        double area_m2 = 0;  ///< never negative, whatever the orientation
        double perimeter_m = 0;
    };
    /// Measures one ring, whose first position is not repeated. @throws InputError if a position has no
    /// longitude and latitude
    [[nodiscard]] Measure ring(std::span<const Position> ring);
    /// Returns the area of the exterior minus the interiors; the perimeter counts all rings.
    [[nodiscard]] Measure polygon(const WorldPolygon& polygon);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns the version of the linked PROJ, e.g. "9.1.1".
[[nodiscard]] std::string proj_version();
/// Returns the GeographicLib version compiled with, e.g. "2.1.2", because it cannot be queried at run time.
[[nodiscard]] std::string geographiclib_version();

}  // namespace d2b
