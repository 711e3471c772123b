#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Vertex of a surface, in steps of its grid: x to the east, y to the north, z up. Integers, because
/// equal vertices must compare equal; a SurfaceFrame converts them to coordinates.
struct SurfacePoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    friend auto operator<=>(const SurfacePoint&, const SurfacePoint&) = default;
};

/// Orientation of a face: up, sideways, down.
enum class FaceKind { roof, wall, ground };

/// Planar polygon of indices into SurfacePart::points; the first is not repeated. Seen from outside, the
/// exterior is counter-clockwise and the interiors are clockwise.
struct SurfaceFace {
    FaceKind kind = FaceKind::roof;
    std::vector<std::uint32_t> exterior;
    std::vector<std::vector<std::uint32_t>> interiors;
    std::int32_t roof = -1;  ///< index into SurfaceBuilding::roofs; -1: not a plane of a roof
};

/// Plane of a roof.
struct SurfaceRoofPlane {
    double slope = 0;    ///< degrees
    double azimuth = 0;  ///< direction in which water runs, degrees clockwise from the north of the CRS; NaN
                         ///< if it is nearly level
};

/// Counter-clockwise seen from outside, never degenerate.
struct SurfaceTriangle {
    FaceKind kind = FaceKind::roof;
    std::array<std::uint32_t, 3> corners{};  ///< indices into SurfacePart::points
};

/// Tier of a stack: vertical walls and a flat roof, standing on its parent.
struct SurfaceTier {
    std::int32_t level = 1;
    std::int32_t parent = -1;  ///< index of the tier below, which comes first; -1: the ground
    std::int64_t top = 0;      ///< z of its roof
    /// Rings of the roof, first point not repeated: the exterior counter-clockwise seen from above, then the
    /// interiors clockwise. Tiers standing on it are not cut out.
    std::vector<std::vector<SurfacePoint>> rings;
};

/// Building in a closed surface.
struct SurfaceBuilding {
    std::int64_t id = 0;
    std::int64_t whole = 0;          ///< lowest id among the parts of a divided building; 0: not divided
    std::vector<FieldValue> values;  ///< one per field of SurfaceMeta::fields
    std::vector<SurfaceFace> faces;  ///< SurfaceForm::solids; in SurfaceForm::tiers those of slanted roofs
    std::vector<SurfaceRoofPlane> roofs;     ///< only SurfaceForm::solids of SurfaceOf::roofs
    std::vector<SurfaceTriangle> triangles;  ///< only SurfaceForm::shell
    std::int64_t base = 0;                   ///< only SurfaceForm::tiers: z of the bottom
    std::int64_t roof = 0;                   ///< only SurfaceForm::tiers: z of the flat roof as one block
    std::vector<SurfaceTier> tiers;          ///< only SurfaceForm::tiers
};

/// Representation of buildings in a format.
enum class SurfaceForm {
    solids,  ///< one polyhedron per building
    shell,   ///< touching buildings merged, without the walls between them, as triangles
    tiers    ///< polygons of the stack, and of slanted roofs, per building; the reader adds walls
};

/// Closed surface: each edge is traversed once in each direction, in the whole part and in each connected
/// component.
struct SurfacePart {
    std::vector<SurfacePoint> points;        ///< distinct; in SurfaceForm::tiers those of slanted roofs
    std::vector<SurfaceBuilding> buildings;  ///< ascending ids; exactly one in SurfaceForm::solids and tiers
};

/// Converts grid steps to coordinates.
struct SurfaceFrame {
    std::array<double, 3> scale{1, 1,
                                1};  ///< size of a step; x and y in units of the CRS, z in the vertical unit
    std::array<double, 3> translate{};  ///< coordinates of the point 0, 0, 0, in the same units
    double horizontal_metres = 1;       ///< metres in a unit of the CRS
    double vertical_metres = 1;         ///< metres in a vertical unit
    std::array<double, 3> origin{};     ///< local origin in whole metres

    /// Returns coordinates in the units of the CRS and of its heights.
    [[nodiscard]] std::array<double, 3> coordinates(const SurfacePoint& point) const {
        return {translate[0] + static_cast<double>(point.x) * scale[0],
                translate[1] + static_cast<double>(point.y) * scale[1],
                translate[2] + static_cast<double>(point.z) * scale[2]};
    }
    /// Returns metres from the origin.
    [[nodiscard]] std::array<double, 3> local(const SurfacePoint& point) const {
        const std::array<double, 3> at = coordinates(point);
        return {at[0] * horizontal_metres - origin[0], at[1] * horizontal_metres - origin[1],
                at[2] * vertical_metres - origin[2]};
    }
};

/// Metadata of a surface.
struct SurfaceMeta {
    SurfaceFrame frame;
    std::string lod;                ///< level of detail after Biljecki et al. (2016): "1.2", "1.3" or
                                    ///< "2.2"
    std::vector<FieldSpec> fields;  ///< fields of a building; the first is its number
    std::string vertical_unit;      ///< name; "" if unknown
    Provenance provenance;          ///< includes the CRS of the coordinates; "" for none
    /// Corners of the DEM's window in the CRS, from the start of its first row, along the column first.
    std::array<Position, 4> corners{};
    LayerStyle block_style = {};  ///< style of a building as one block
    LayerStyle tier_style = {};   ///< style of a tier, whose height is that of its roof above the base
    std::vector<std::string> first_fields{};  ///< most relevant fields of a building, by name
    /// Field of texts: a page shows the buildings of one of them at a time, at first those of the last; "":
    /// all.
    std::string alternatives{};
};

/// Receives the surface of the buildings: a file (see open_auxiliary_sinks()), or a list in a program or
/// test.
///
/// Call order: optionally rehearse(); begin(); add() in an order that depends only on the input; prepare() or
/// finish(). All calls come from the thread that called run(). A sink destroyed before prepare() or finish()
/// leaves the destination unchanged.
class SurfaceSink {
  public:
    SurfaceSink() = default;
    SurfaceSink(const SurfaceSink&) = delete;
    SurfaceSink& operator=(const SurfaceSink&) = delete;
    virtual ~SurfaceSink() = default;

    /// Returns the representation that add() must receive.
    [[nodiscard]] virtual SurfaceForm form() const = 0;
    /// Preflight check, called before the work begins. @param meta without fields, metadata and the height of
    /// the origin, which are not known yet @throws OptionError, OutputError if the destination cannot hold
    /// such coordinates
    virtual void preflight(const SurfaceMeta& /*meta*/) {}
    /// @throws OutputError
    virtual void begin(const SurfaceMeta& meta) = 0;
    /// @param part a building, or a block of touching ones @throws OutputError
    virtual void add(const SurfacePart& part) = 0;
    /// Called when no later part touches an earlier one.
    virtual void end_group() {}
    /// Receives the report of the run before prepare() or finish().
    virtual void take_report(const RunReport& /*report*/) {}
    /// Makes the result visible, all of it or nothing; also if there were no parts. @throws OutputError
    virtual void finish() = 0;
    /// Same as FeatureSink::prepare().
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// Returns warnings since the last call, one sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
