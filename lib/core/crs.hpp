#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/stop_request.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A unit of length.
struct LengthUnit {
    std::string name;   ///< "metre", "foot", "US survey foot", ...
    double metres = 1;  ///< metres in one unit
};

/// A coordinate reference system, read with PROJ. A value: copies share one immutable definition.
/// Not for use by two threads at a time.
class Crs {
  public:
    enum class Kind { none, projected, geographic, local, other };

    /// No CRS at all.
    Crs();
    /// @param text WKT of any version, an authority code ("EPSG:25832", compounds "EPSG:25832+7837"),
    ///        PROJJSON, a PROJ string or a name; "" gives no CRS. A bare name counts only if it is the whole
    ///        name, but for case, spaces and punctuation.
    /// @throws OptionError with PROJ's reason where it is none of these
    explicit Crs(std::string_view text);

    [[nodiscard]] Kind kind() const;
    [[nodiscard]] std::string name() const;  ///< "" for none
    [[nodiscard]] std::string wkt() const;   ///< WKT2:2019, "" for none
    /// "https://www.opengis.net/def/crs/EPSG/0/7415", of the whole, with its heights; "" where neither the
    /// CRS nor PROJ's database has a code of an authority for it.
    [[nodiscard]] std::string url() const;
    /// The same of its horizontal part.
    [[nodiscard]] std::string horizontal_url() const;
    /// Of the horizontal axes; empty where they are angles, or there is no CRS.
    [[nodiscard]] std::optional<LengthUnit> horizontal_unit() const;
    /// Units of the horizontal axes in a full circle of longitude; 0 where they are lengths, or there is no
    /// CRS.
    [[nodiscard]] double turn() const;
    /// Of the vertical part of a compound CRS or of the height axis of a 3D one; empty where there is none.
    [[nodiscard]] std::optional<LengthUnit> vertical_unit() const;
    /// Whether places have a longitude and a latitude on an ellipsoid (so that areas are geodesic). False
    /// also where PROJ does not know the projection.
    [[nodiscard]] bool on_ellipsoid() const;

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::shared_ptr<const Impl> impl_;
};

/// A raster needs a plane: projected, geographic or local coordinates, or none.
/// @param option that gave the CRS ("-a_srs EPSG:5773"), "" where it is the raster's own @param input its
/// name
/// @throws OptionError, or InputError where no option gave it
void require_plane(const Crs& crs, const std::string& option, const std::string& input);

/// What is probably meant by a code without its authority: "EPSG:4326" for "4326", "4326+5773" or "epsg4326";
/// "" for all else.
[[nodiscard]] std::string code_meant_by(std::string_view text);

/// From one CRS to another with PROJ, axes in GIS order on both sides. The vertical parts of compound CRSs
/// are ignored: heights are not transformed.
class CoordinateTransform {
  public:
    /// @param area positions (of `from`) that span the area of interest; PROJ picks the best operation for it
    /// @throws OptionError where there is no operation between the two
    CoordinateTransform(const Crs& from, const Crs& to, std::span<const Position> area);
    CoordinateTransform(CoordinateTransform&&) noexcept;
    CoordinateTransform& operator=(CoordinateTransform&&) noexcept;
    ~CoordinateTransform();

    /// In place. @throws InputError naming the first position that has no image; all positions are unchanged
    /// then
    void apply(std::span<Position> positions);
    /// In place; what has no image becomes infinite or NaN. @return whether all have one
    [[nodiscard]] bool try_apply(std::span<Position> positions);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Areas and lengths on the ellipsoid of a CRS with GeographicLib; planar where the CRS has none (local
/// coordinates, no CRS) or PROJ does not know its projection, in the square of its horizontal unit turned
/// into metres, or in plain units. Edges are straight in the CRS: long ones are densified until what remains
/// is below 1e-7 of the area. In a geographic CRS, edges of more than half a turn of longitude go the short
/// way round, across the antimeridian.
class Geodesy {
  public:
    /// @param stop asked between rings and within long ones: they end with a Cancelled
    explicit Geodesy(const Crs& crs, StopRequest stop = {});
    Geodesy(Geodesy&&) noexcept;
    Geodesy& operator=(Geodesy&&) noexcept;
    ~Geodesy();

    struct Measure {
        double area_m2 = 0;  ///< never negative, whatever the orientation
        double perimeter_m = 0;
    };
    [[nodiscard]] bool geodesic() const;
    /// One ring, not closed by a repeated position. @throws InputError where a position has no longitude and
    /// latitude
    [[nodiscard]] Measure ring(std::span<const Position> ring);
    /// Exterior less interiors; the perimeter counts all rings.
    [[nodiscard]] Measure polygon(const WorldPolygon& polygon);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Of the PROJ that is linked: "9.1.1".
[[nodiscard]] std::string proj_version();
/// Of the GeographicLib that was compiled with, which does not tell at run time: "2.1.2".
[[nodiscard]] std::string geographiclib_version();

}  // namespace d2b
