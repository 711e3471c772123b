#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// A corner of a surface, in whole steps of its grid: x to the east, y to the north, z up. Equal corners are
/// equal numbers; a SurfaceFrame makes coordinates of them.
struct SurfacePoint {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;

    friend auto operator<=>(const SurfacePoint&, const SurfacePoint&) = default;
};

/// Which way a face looks: up, sideways, down.
enum class FaceKind { roof, wall, ground };

/// A plane polygon; indices into SurfacePart::points, the first is not repeated. Seen from outside the
/// exterior runs counter-clockwise and the interiors run clockwise.
struct SurfaceFace {
    FaceKind kind = FaceKind::roof;
    std::vector<std::uint32_t> exterior;
    std::vector<std::vector<std::uint32_t>> interiors;
};

/// Counter-clockwise seen from outside, and never without area.
struct SurfaceTriangle {
    FaceKind kind = FaceKind::roof;
    std::array<std::uint32_t, 3> corners{};  ///< indices into SurfacePart::points
};

/// A part of a stack: upright walls around a flat roof, from what it stands on.
struct SurfaceTier {
    std::int32_t level = 1;
    std::int32_t parent = -1;  ///< place of the tier that it stands on, which comes before it; -1: the ground
    std::int64_t top = 0;      ///< z of its roof
    /// Corners of the roof, the first is not repeated; the exterior counter-clockwise seen from above, then
    /// the interiors clockwise. What stands on it is not cut out.
    std::vector<std::vector<SurfacePoint>> rings;
};

/// What a building has of a closed surface.
struct SurfaceBuilding {
    std::int64_t id = 0;
    std::int64_t whole = 0;  ///< of a part of a divided building, the lowest id of its parts; 0: not divided
    std::vector<FieldValue> values;          ///< one a field of SurfaceMeta::fields
    std::vector<SurfaceFace> faces;          ///< of SurfaceForm::solids
    std::vector<SurfaceTriangle> triangles;  ///< of SurfaceForm::shell
    std::int64_t base = 0;                   ///< of SurfaceForm::tiers: z that it stands at ...
    std::int64_t roof = 0;                   ///< ... and of its flat roof, where it is one block
    std::vector<SurfaceTier> tiers;          ///< of SurfaceForm::tiers
};

/// What a format holds.
enum class SurfaceForm {
    solids,  ///< each building for itself, its faces as polygons
    shell,   ///< touching buildings as one, without walls where both stand, in triangles
    tiers    ///< each building as the polygons of its stack; walls are for whoever draws them
};

/// A closed surface: of all its buildings together every edge is passed once each way, and so is every edge
/// of what hangs together.
struct SurfacePart {
    std::vector<SurfacePoint> points;        ///< distinct; each is used; none of SurfaceForm::tiers
    std::vector<SurfaceBuilding> buildings;  ///< ascending ids; one of SurfaceForm::solids and tiers
};

/// What turns steps into coordinates.
struct SurfaceFrame {
    std::array<double, 3> scale{1, 1, 1};  ///< a step; x and y in units of the CRS, z in the vertical unit
    std::array<double, 3> translate{};     ///< coordinates of the point 0, 0, 0, in the same units
    double horizontal_metres = 1;          ///< in a unit of the CRS
    double vertical_metres = 1;            ///< in a vertical unit
    std::array<double, 3> origin{};        ///< of local coordinates: whole metres

    /// In the units of the CRS and of its heights.
    [[nodiscard]] std::array<double, 3> coordinates(const SurfacePoint& point) const {
        return {translate[0] + static_cast<double>(point.x) * scale[0],
                translate[1] + static_cast<double>(point.y) * scale[1],
                translate[2] + static_cast<double>(point.z) * scale[2]};
    }
    /// In metres from the origin.
    [[nodiscard]] std::array<double, 3> local(const SurfacePoint& point) const {
        const std::array<double, 3> at = coordinates(point);
        return {at[0] * horizontal_metres - origin[0], at[1] * horizontal_metres - origin[1],
                at[2] * vertical_metres - origin[2]};
    }
};

/// What a surface says of itself.
struct SurfaceMeta {
    SurfaceFrame frame;
    std::string lod;                ///< level of detail after Biljecki et al. (2016): "1.2" or "1.3"
    std::vector<FieldSpec> fields;  ///< of a building; the first is its number
    std::string vertical_unit;      ///< its name; "" where nothing says what it is
    Provenance provenance;          ///< with the CRS of the coordinates; "" for none
    /// Of the DEM's window, in the CRS: where its first row begins, then around it, along the column first.
    std::array<Position, 4> corners{};
    LayerStyle block_style = {};              ///< of a building as one block; by names of the fields
    LayerStyle tier_style = {};               ///< of a tier, whose height is that of its roof above the base
    std::vector<std::string> first_fields{};  ///< what most want to know of a building; names of the fields
};

/// Where the surface of the buildings goes: a file (write/), or a list in tests and in other programs.
/// May be asked whether it takes what will come; then begin, then add in an order that depends on the input
/// alone, then prepare or finish; all of it from the thread that called run(). A sink that is destroyed
/// before that leaves the destination as it was.
class SurfaceSink {
  public:
    SurfaceSink() = default;
    SurfaceSink(const SurfaceSink&) = delete;
    SurfaceSink& operator=(const SurfaceSink&) = delete;
    virtual ~SurfaceSink() = default;

    /// What add() is to get.
    [[nodiscard]] virtual SurfaceForm form() const = 0;
    /// Asked before the work begins. @param meta its fields, metadata and the height of the origin are not
    /// known yet @throws OptionError, OutputError where the destination cannot hold such coordinates
    virtual void rehearse(const SurfaceMeta& /*meta*/) {}
    /// @throws OutputError
    virtual void begin(const SurfaceMeta& meta) = 0;
    /// @param part a building, or a block of touching ones @throws OutputError
    virtual void add(const SurfacePart& part) = 0;
    /// Called when no part that comes later touches those that came before.
    virtual void end_group() {}
    /// Told before prepare() or finish() what the run has done.
    virtual void take_report(const RunReport& /*report*/) {}
    /// Makes the result visible, all of it or nothing; of no part at all as well. @throws OutputError
    virtual void finish() = 0;
    /// As FeatureSink::prepare().
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// What it has noticed since the last call, a sentence each, for the run to warn of.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
