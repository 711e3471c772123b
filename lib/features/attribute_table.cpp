#include "features/attribute_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

#include "core/text.hpp"

namespace d2b::features {
namespace {

struct Translation {
    FieldNames names;
    std::string_view own;
    std::string_view other;
};

// Field names of other programs. URock takes the height of a building from ROOF_HEIGHT by default and
// extrudes a block to it, so it gets p90 because the highest point may be a spire. City4CFD configures its
// attribute names; these are those of its own examples. OSM: tags of Simple 3D Buildings.
constexpr std::array translations{
    Translation{FieldNames::urock, "id", "ID_BUILD"},
    Translation{FieldNames::urock, "p90", "ROOF_HEIGHT"},
    Translation{FieldNames::city4cfd, "id", "unique_id"},
    Translation{FieldNames::city4cfd, "num_floors", "floors"},
    Translation{FieldNames::city4cfd, "min_height", "base_height"},
    Translation{FieldNames::osm, "num_floors", "building:levels"},
    Translation{FieldNames::osm, "ground", "ele"},
};

using Unit = AttributeUnit;

FieldValue number(double value) {
    return std::isfinite(value) ? FieldValue{value} : FieldValue{};
}
/// Rounds a measurement in metres to hundredths, because the data are not more accurate.
FieldValue measure(double value) {
    return number(round_to_hundredths(value));
}
/// Rounds an area likewise. A smaller one stays as it is, because nothing has an area of 0: without a CRS the
/// unit may be a degree.
FieldValue area(double square_metres) {
    const FieldValue rounded = measure(square_metres);
    return rounded == FieldValue{0.0} ? number(square_metres) : rounded;
}
/// Returns NULL for 0, which means "no object".
FieldValue id_or_null(std::int64_t id) {
    return id > 0 ? FieldValue{id} : FieldValue{};
}
FieldValue nodata_share(const BuildingRecord& record) {
    const bool is_labelled = !std::isnan(record.confidence) || record.status == OutlineStatus::given;
    if (record.cells == 0 || record.points > record.cells || !is_labelled)
        return {};
    return 1 - static_cast<double>(record.points) / static_cast<double>(record.cells);
}
FieldValue doubt(const BuildingRecord& record) {
    if (record.doubt.empty() || !(record.confidence < sure_confidence))
        return {};
    return std::string(record.doubt);
}
/// Mean width of a building: the side of a square, or twice the width of a long wing, with as much area per
/// wall.
double width_of(const BuildingRecord& record) {
    return record.perimeter_m > 0 ? 4 * record.area_m2 / record.perimeter_m : 0;
}

/// Height of the eaves above the ground in metres; NaN without -roofs.
double eaves_m(const BuildingRecord& record) {
    const double metres = record.height_m / (record.roof - record.ground);  // in a vertical unit
    return record.roof_shape.type.empty() ? std::nan("")
                                          : (record.roof_shape.eave_z - record.ground) * metres;
}

/// True for chimneys and masts, which are more slender than towers with flats.
bool is_slender(const BuildingRecord& record, double height_m) {
    constexpr double slender = 4;
    const double width = width_of(record);
    return width > 0 && height_m > slender * width;
}

/// True for tanks and silos: round, with a domed or conical roof.
bool is_tank(const BuildingRecord& record) {
    constexpr double least_roundness = 0.9;  // 1 for a circle, 0.79 for a square
    return record.roof_shape.type == "domed" &&
           4 * std::numbers::pi * record.area_m2 > least_roundness * record.perimeter_m * record.perimeter_m;
}

/// True for halls: one roof over an area that is wide for daylight, and more than three times as wide as
/// high.
bool is_hall(const BuildingRecord& record, double height_m) {
    constexpr double least_width_m = 30;
    const double width = width_of(record);
    return width >= least_width_m && 3 * height_m < width &&
           height_m - record.heights_m[0] <= record.storey_m && height_m >= 1.5 * record.storey_m;
}

/// True for naves with a spire or a steep roof, and other buildings whose parts differ so much that one
/// number says nothing.
bool is_church(const BuildingRecord& record, double height_m) {
    constexpr double least_storeys = 4;
    constexpr double most_storeys_of_roof = 3;
    const double body_m = record.heights_m[0];
    if (body_m >= least_storeys * record.storey_m && record.height_m >= 2 * body_m)
        return true;
    const std::string_view type = record.roof_shape.type;
    const double rise_m = height_m - eaves_m(record);
    return (type == "gabled" || type == "hipped" || type == "pyramidal") &&
           rise_m > most_storeys_of_roof * record.storey_m && 2 * rise_m > height_m - rise_m;
}

FieldValue floors(const BuildingRecord& record) {
    const double height_m = record.heights_m[3];
    if (!std::isfinite(height_m) || is_slender(record, height_m) || is_tank(record) ||
        is_hall(record, height_m) || is_church(record, height_m))
        return {};
    return std::max<std::int64_t>(1, std::llround(std::min(height_m, 1e6) / record.storey_m));
}

constexpr std::string_view status_words =
    "worst form of more than 5 % of the outline: regularized, simplified (through midpoints of cell borders, "
    "or by -simplify), traced, kept_traced (other forms would be invalid) or repaired; given if the "
    "footprint is one of -footprints";

constexpr std::array building_table{
    Attribute<BuildingRecord>{"id", "Building", FieldType::integer, Unit::none,
                              "number of the building, from 1, in scan order",
                              [](const BuildingRecord& r) -> FieldValue { return r.id; }},
    Attribute<BuildingRecord>{"ground", "Ground", FieldType::real, Unit::vertical,
                              "elevation of the ground: a low percentile of the terrain under and around the "
                              "outline; in the thesis preset the lowest point at most a cell outside it",
                              [](const BuildingRecord& r) { return number(r.ground); }},
    Attribute<BuildingRecord>{"roof", "Roof", FieldType::real, Unit::vertical,
                              "elevation of the highest point",
                              [](const BuildingRecord& r) { return number(r.roof); }},
    Attribute<BuildingRecord>{"height", "Highest point", FieldType::real, Unit::metre,
                              "highest point above ground",
                              [](const BuildingRecord& r) { return measure(r.height_m); }},
    Attribute<BuildingRecord>{"min_height", "Lowest part", FieldType::real, Unit::metre,
                              "height above ground at which the building begins",
                              [](const BuildingRecord&) -> FieldValue { return 0.0; }},
    Attribute<BuildingRecord>{"p50", "Median height", FieldType::real, Unit::metre,
                              "height above ground that half of the points do not exceed",
                              [](const BuildingRecord& r) { return measure(r.heights_m[0]); }},
    Attribute<BuildingRecord>{"p70", "70 % height", FieldType::real, Unit::metre,
                              "height above ground that 70 % of the points do not exceed",
                              [](const BuildingRecord& r) { return measure(r.heights_m[1]); }},
    Attribute<BuildingRecord>{"p90", "90 % height", FieldType::real, Unit::metre,
                              "height above ground that 90 % of the points do not exceed",
                              [](const BuildingRecord& r) { return measure(r.heights_m[2]); }},
    Attribute<BuildingRecord>{"p95", "95 % height", FieldType::real, Unit::metre,
                              "height above ground that 95 % of the points do not exceed",
                              [](const BuildingRecord& r) { return measure(r.heights_m[3]); }},
    Attribute<BuildingRecord>{"num_floors", "Floors", FieldType::integer, Unit::none,
                              "estimate: p95 in storeys of 3 m (-storey_height), at least 1; NULL for halls, "
                              "churches, tanks and chimneys",
                              [](const BuildingRecord& r) { return floors(r); }},
    Attribute<BuildingRecord>{
        "has_parts", "Has parts", FieldType::integer, Unit::none,
        "1 if the stack has more than one contour, else 0",
        [](const BuildingRecord& r) -> FieldValue { return std::int64_t{r.parts > 1 ? 1 : 0}; }},
    Attribute<BuildingRecord>{"n_parts", "Parts", FieldType::integer, Unit::none, "contours of the stack",
                              [](const BuildingRecord& r) -> FieldValue { return r.parts; }},
    Attribute<BuildingRecord>{"n_levels", "Levels", FieldType::integer, Unit::none,
                              "highest level of the stack",
                              [](const BuildingRecord& r) -> FieldValue { return std::int64_t{r.levels}; }},
    Attribute<BuildingRecord>{"n_points", "Points", FieldType::integer, Unit::none, "points of the DEM in it",
                              [](const BuildingRecord& r) -> FieldValue { return r.points; }},
    Attribute<BuildingRecord>{"n_cells", "Cells", FieldType::integer, Unit::none, "cells of the DEM in it",
                              [](const BuildingRecord& r) -> FieldValue { return r.cells; }},
    Attribute<BuildingRecord>{"nodata", "No data", FieldType::real, Unit::none,
                              "share of its cells without a valid point; NULL with -trace points",
                              [](const BuildingRecord& r) { return nodata_share(r); }},
    Attribute<BuildingRecord>{
        "confidence", "Confidence", FieldType::real, Unit::none,
        "certainty that this is a building, 0 to 1; NULL in the thesis preset",
        [](const BuildingRecord& r) { return number(floor_to_hundredths(r.confidence)); }},
    Attribute<BuildingRecord>{"doubt", "Doubt", FieldType::text, Unit::none,
                              "strongest sign against a building, if confidence is below 0.9",
                              [](const BuildingRecord& r) { return doubt(r); }},
    Attribute<BuildingRecord>{
        "at_edge", "At the edge", FieldType::integer, Unit::none,
        "1 if it touches the edge of the used part of the raster, else 0",
        [](const BuildingRecord& r) -> FieldValue { return std::int64_t{r.at_edge ? 1 : 0}; }},
    Attribute<BuildingRecord>{"area_m2", "Area", FieldType::real, Unit::square_metre,
                              "area of the footprint without courtyards, on the ellipsoid if the CRS has one",
                              [](const BuildingRecord& r) { return area(r.area_m2); }},
    Attribute<BuildingRecord>{"volume_m3", "Volume", FieldType::real, Unit::cubic_metre,
                              "volume between its surface and the ground level",
                              [](const BuildingRecord& r) { return measure(r.area_m2 * r.mean_m); }},
    Attribute<BuildingRecord>{"perim_m", "Perimeter", FieldType::real, Unit::metre,
                              "length of all rings, on the ellipsoid if the CRS has one",
                              [](const BuildingRecord& r) { return measure(r.perimeter_m); }},
    Attribute<BuildingRecord>{
        "status", "Outline", FieldType::text, Unit::none, status_words,
        [](const BuildingRecord& r) -> FieldValue { return std::string(status_name(r.status)); }},
    Attribute<BuildingRecord>{"moved_m", "Moved", FieldType::real, Unit::metre,
                              "largest distance between the regularized outline and its trace",
                              [](const BuildingRecord& r) { return measure(r.deviation_m); }},
    Attribute<BuildingRecord>{"area_chg", "Area change", FieldType::real, Unit::none,
                              "relative change of the traced area by straight walls",
                              [](const BuildingRecord& r) { return number(r.area_change); }},
};

constexpr std::array roof_table{
    Attribute<BuildingRecord>{"roof_type", "Roof type", FieldType::text, Unit::none,
                              "flat, shed, gabled, hipped, pyramidal, mansard, domed, complex or unknown; "
                              "this field and the next four only with -roofs",
                              [](const BuildingRecord& r) {
                                  return r.roof_shape.type.empty()
                                             ? FieldValue{}
                                             : FieldValue{std::string(r.roof_shape.type)};
                              }},
    Attribute<BuildingRecord>{
        "flat_m2", "Flat roofs", FieldType::real, Unit::square_metre,
        "area of faces that slope by less than 8 degrees",
        [](const BuildingRecord& r) { return measure(r.roof_shape.flat_share * r.area_m2); }},
    Attribute<BuildingRecord>{"ridge_z", "Ridge", FieldType::real, Unit::vertical,
                              "highest corner of the faces",
                              [](const BuildingRecord& r) { return number(r.roof_shape.ridge_z); }},
    Attribute<BuildingRecord>{"eave_z", "Eaves", FieldType::real, Unit::vertical,
                              "mean of the lowest corners of the faces, weighted by area",
                              [](const BuildingRecord& r) { return number(r.roof_shape.eave_z); }},
    Attribute<BuildingRecord>{"roof_rmse", "Roof error", FieldType::real, Unit::metre,
                              "root mean square distance of the points from the faces",
                              [](const BuildingRecord& r) { return measure(r.roof_shape.rmse_m); }},
};

constexpr std::array fit_table{
    Attribute<BuildingRecord>{
        "seen", "Seen", FieldType::real, Unit::none,
        "share of its cells that rise by -min_height; this field and the next two only with -footprints",
        [](const BuildingRecord& r) { return number(round_to_hundredths(r.seen_share)); }},
    Attribute<BuildingRecord>{
        "tree", "Trees", FieldType::real, Unit::none,
        "share of its cells that look like trees: they rise, are rough or green, and lie at no building that "
        "was found",
        [](const BuildingRecord& r) { return number(round_to_hundredths(r.tree_share)); }},
    Attribute<BuildingRecord>{
        "shift_m", "Shift", FieldType::real, Unit::metre,
        "move, in whole cells and at most 5 m, that brings its edges onto walls; NULL if seen is below 0.3",
        [](const BuildingRecord& r) { return measure(r.shift_m); }},
};

/// True for attributes that given footprints have, too.
constexpr bool suits_given(std::string_view name) {
    return name != "confidence" && name != "doubt" && name != "moved_m" && name != "area_chg";
}

/// True for attributes that need no elevations.
constexpr bool is_of_shape(std::string_view name) {
    return name == "id" || name == "area_m2" || name == "perim_m" || name == "status";
}

constexpr std::array parcel_table{
    Attribute<BuildingRecord>{
        "parcel", "Parcel", FieldType::text, Unit::none,
        "identifier of the -split_by polygon that holds most of it; only with that option, NULL for lines",
        [](const BuildingRecord& r) {
            return r.parcel.empty() ? FieldValue{} : FieldValue{std::string(r.parcel)};
        }},
};

constexpr std::array roof_face_table{
    Attribute<RoofFaceRecord>{"id", "Face", FieldType::integer, Unit::none,
                              "number of the face, from 1, by building",
                              [](const RoofFaceRecord& r) -> FieldValue { return r.id; }},
    Attribute<RoofFaceRecord>{"bldg_id", "Building", FieldType::integer, Unit::none, "id of the building",
                              [](const RoofFaceRecord& r) { return id_or_null(r.building_id); }},
    Attribute<RoofFaceRecord>{
        "part_id", "Part of", FieldType::integer, Unit::none,
        "lowest id of the buildings into which its building was divided; NULL if it was not",
        [](const RoofFaceRecord& r) { return id_or_null(r.whole); }},
    Attribute<RoofFaceRecord>{"slope", "Slope", FieldType::real, Unit::none,
                              "degrees from the horizontal; NULL if doubtful",
                              [](const RoofFaceRecord& r) { return number(round_to_hundredths(r.slope)); }},
    Attribute<RoofFaceRecord>{
        "azimuth", "Azimuth", FieldType::real, Unit::none,
        "direction in which water runs, degrees clockwise from the north of the CRS of the output; NULL "
        "below a slope of 8 degrees",
        [](const RoofFaceRecord& r) { return number(std::fmod(round_to_hundredths(r.azimuth), 360)); }},
    Attribute<RoofFaceRecord>{"area_m2", "Area", FieldType::real, Unit::square_metre, "area in plan",
                              [](const RoofFaceRecord& r) { return area(r.area_m2); }},
    Attribute<RoofFaceRecord>{"roof_m2", "Roof area", FieldType::real, Unit::square_metre,
                              "area along the slope",
                              [](const RoofFaceRecord& r) { return measure(r.roof_m2); }},
    Attribute<RoofFaceRecord>{"z_low", "Lowest corner", FieldType::real, Unit::vertical,
                              "elevation of the lowest corner",
                              [](const RoofFaceRecord& r) { return number(r.lowest); }},
    Attribute<RoofFaceRecord>{"z_high", "Highest corner", FieldType::real, Unit::vertical,
                              "elevation of the highest corner",
                              [](const RoofFaceRecord& r) { return number(r.highest); }},
    Attribute<RoofFaceRecord>{"rmse_m", "Error", FieldType::real, Unit::metre,
                              "root mean square distance of the points from the face, vertically",
                              [](const RoofFaceRecord& r) { return measure(r.rmse_m); }},
    Attribute<RoofFaceRecord>{"n_cells", "Cells", FieldType::integer, Unit::none,
                              "cells of the DEM with a valid point and their centre in it",
                              [](const RoofFaceRecord& r) -> FieldValue { return r.cells; }},
    Attribute<RoofFaceRecord>{
        "kind", "Kind", FieldType::text, Unit::none,
        "flat (below 8 degrees), pitched, or doubtful: too narrow for a slope, far from most of its "
        "points, or level because no plane suits them",
        [](const RoofFaceRecord& r) -> FieldValue { return std::string(r.kind); }},
};

constexpr std::array contour_table{
    Attribute<ContourRecord>{"id", "Contour", FieldType::integer, Unit::none,
                             "number of the contour, from 1 by level, then in scan order",
                             [](const ContourRecord& r) -> FieldValue { return r.id; }},
    Attribute<ContourRecord>{"parent_id", "Stands on", FieldType::integer, Unit::none,
                             "id of the contour one level down that contains it; NULL in level 0",
                             [](const ContourRecord& r) { return id_or_null(r.parent_id); }},
    Attribute<ContourRecord>{"bldg_id", "Building", FieldType::integer, Unit::none,
                             "id of the building; NULL in level 0",
                             [](const ContourRecord& r) { return id_or_null(r.building_id); }},
    Attribute<ContourRecord>{"level", "Level", FieldType::integer, Unit::none,
                             "0 is the root: every valid point",
                             [](const ContourRecord& r) -> FieldValue { return std::int64_t{r.level}; }},
    Attribute<ContourRecord>{"threshold", "Threshold", FieldType::real, Unit::vertical,
                             "the elevation that its points exceed; the minimum in level 0",
                             [](const ContourRecord& r) { return number(r.threshold); }},
    Attribute<ContourRecord>{
        "base", "Base", FieldType::real, Unit::vertical,
        "lower end of this part of the stack: the top of the part below, the ground in level 1",
        [](const ContourRecord& r) { return number(r.base); }},
    Attribute<ContourRecord>{
        "top", "Top", FieldType::real, Unit::vertical,
        "upper end of this part of the stack: tier_z, at most the threshold of the part above",
        [](const ContourRecord& r) { return number(r.top); }},
    Attribute<ContourRecord>{"height", "Height", FieldType::real, Unit::metre,
                             "top of this part above the ground of its building; NULL in level 0",
                             [](const ContourRecord& r) { return number(r.height_m); }},
    Attribute<ContourRecord>{"min_height", "Lowest part", FieldType::real, Unit::metre,
                             "base of this part above the ground of its building; NULL in level 0",
                             [](const ContourRecord& r) { return number(r.min_height_m); }},
    Attribute<ContourRecord>{"tier_z", "Tier", FieldType::real, Unit::vertical,
                             "mean elevation of the points outside its children; NULL if there are none",
                             [](const ContourRecord& r) { return number(r.tier_z); }},
    Attribute<ContourRecord>{"n_points", "Points", FieldType::integer, Unit::none,
                             "points of the DEM in it that exceed its threshold",
                             [](const ContourRecord& r) -> FieldValue { return r.points; }},
    Attribute<ContourRecord>{"elev_min", "Lowest", FieldType::real, Unit::vertical,
                             "lowest elevation of its points",
                             [](const ContourRecord& r) { return number(r.lowest); }},
    Attribute<ContourRecord>{"elev_mean", "Mean", FieldType::real, Unit::vertical,
                             "mean elevation of its points",
                             [](const ContourRecord& r) { return number(r.mean); }},
    Attribute<ContourRecord>{"elev_max", "Highest", FieldType::real, Unit::vertical,
                             "highest elevation of its points",
                             [](const ContourRecord& r) { return number(r.highest); }},
    Attribute<ContourRecord>{
        "confidence", "Confidence", FieldType::real, Unit::none,
        "confidence of its building, 0 to 1; NULL in the thesis preset",
        [](const ContourRecord& r) { return number(floor_to_hundredths(r.confidence)); }},
    Attribute<ContourRecord>{"area_m2", "Area", FieldType::real, Unit::square_metre,
                             "area without holes, on the ellipsoid if the CRS has one",
                             [](const ContourRecord& r) { return number(r.area_m2); }},
    Attribute<ContourRecord>{"perim_m", "Perimeter", FieldType::real, Unit::metre,
                             "length of all rings, on the ellipsoid if the CRS has one",
                             [](const ContourRecord& r) { return number(r.perimeter_m); }},
    Attribute<ContourRecord>{
        "status", "Outline", FieldType::text, Unit::none, status_words,
        [](const ContourRecord& r) -> FieldValue { return std::string(status_name(r.status)); }},
};

std::string unit_name(Unit unit, const std::string& vertical) {
    switch (unit) {
        case Unit::vertical:
            return vertical;
        case Unit::metre:
            return "m";
        case Unit::square_metre:
            return "m2";
        case Unit::cubic_metre:
            return "m3";
        case Unit::none:
            break;
    }
    return "";
}

std::span<const Attribute<BuildingRecord>> all_building_attributes() {
    static const auto all = [] {
        const auto own = building_attributes(true, true);
        std::vector<Attribute<BuildingRecord>> attributes(own.begin(), own.end());
        attributes.insert(attributes.end(), fit_table.begin(), fit_table.end());
        return attributes;
    }();
    return all;
}

constexpr std::array rejected_table{
    Attribute<RejectedRecord>{"id", "Number", FieldType::integer, Unit::none, "number in this layer, from 1",
                              [](const RejectedRecord& r) -> FieldValue { return r.id; }},
    Attribute<RejectedRecord>{
        "reason", "Reason", FieldType::text, Unit::none,
        "contour_short, contour_small, contour_on_dropped, building_not_tall: dropped; hole_short, "
        "hole_small: filled; "
        "outline_kept_traced, polygon_repaired, polygon_lost: written in another form, or not at all",
        [](const RejectedRecord& r) -> FieldValue { return std::string(r.reason); }},
    Attribute<RejectedRecord>{"building", "Building", FieldType::integer, Unit::none,
                              "id of the building that has this traced outline",
                              [](const RejectedRecord& r) { return id_or_null(r.building); }},
    Attribute<RejectedRecord>{"contour", "Contour", FieldType::integer, Unit::none,
                              "id of the contour that has this traced outline",
                              [](const RejectedRecord& r) { return id_or_null(r.contour); }},
    Attribute<RejectedRecord>{"level", "Level", FieldType::integer, Unit::none,
                              "level of the contour, or of the contour with the hole",
                              [](const RejectedRecord& r) -> FieldValue { return std::int64_t{r.level}; }},
    Attribute<RejectedRecord>{"area_m2", "Area", FieldType::real, Unit::square_metre,
                              "area without holes, on the ellipsoid if the CRS has one",
                              [](const RejectedRecord& r) -> FieldValue { return r.area_m2; }},
    Attribute<RejectedRecord>{"perim_m", "Perimeter", FieldType::real, Unit::metre,
                              "length of all rings, on the ellipsoid if the CRS has one",
                              [](const RejectedRecord& r) -> FieldValue { return r.perimeter_m; }},
};

constexpr std::array problem_table{
    Attribute<ProblemRecord>{"id", "Number", FieldType::integer, Unit::none, "number in this layer, from 1",
                             [](const ProblemRecord& r) -> FieldValue { return r.id; }},
    Attribute<ProblemRecord>{
        "kind", "Kind", FieldType::text, Unit::none,
        "surface_corner_cut, surface_notch_filled, flow_touch: corners that touched, and their distance now, "
        "in m; surface_lost: a building that is not in the surface, and its area in m2; flow_wall, flow_gap, "
        "flow_neck: a wall, gap or part of a building that is shorter or narrower than -flow_ready, in m; "
        "flow_angle: a corner that is too sharp, in degrees; flow_crossing: outlines that cross; flow_step: "
        "adjacent roofs that differ by less than -min_wall, in m",
        [](const ProblemRecord& r) -> FieldValue { return std::string(r.kind); }},
    Attribute<ProblemRecord>{"building", "Building", FieldType::integer, Unit::none,
                             "id of the building; the lowest if there are several",
                             [](const ProblemRecord& r) { return id_or_null(r.building); }},
    Attribute<ProblemRecord>{"other", "Other building", FieldType::integer, Unit::none,
                             "id of the next building",
                             [](const ProblemRecord& r) { return id_or_null(r.other); }},
    Attribute<ProblemRecord>{"before", "Size before", FieldType::real, Unit::none,
                             "size in the unit of its kind",
                             [](const ProblemRecord& r) -> FieldValue { return r.before; }},
    Attribute<ProblemRecord>{"after", "Size after", FieldType::real, Unit::none, "the same in the output",
                             [](const ProblemRecord& r) -> FieldValue { return r.after; }},
    Attribute<ProblemRecord>{
        "state", "State", FieldType::text, Unit::none, "changed or left",
        [](const ProblemRecord& r) -> FieldValue { return std::string(r.changed ? "changed" : "left"); }},
};

}  // namespace

std::string_view field_name(FieldNames names, std::string_view own) {
    for (const Translation& translation : translations)
        if (translation.names == names && translation.own == own)
            return translation.other;
    return own;
}

std::span<const Attribute<BuildingRecord>> building_attributes(bool with_roof, bool with_parcel) {
    using Attributes = std::vector<Attribute<BuildingRecord>>;
    const auto table = [](bool roof, bool parcel) {
        Attributes all(building_table.begin(), building_table.end());
        if (roof)
            all.insert(all.end(), roof_table.begin(), roof_table.end());
        if (parcel)
            all.insert(all.end(), parcel_table.begin(), parcel_table.end());
        return all;
    };
    static const std::array<Attributes, 4> tables{table(false, false), table(false, true), table(true, false),
                                                  table(true, true)};
    return tables[(with_roof ? 2U : 0U) + (with_parcel ? 1U : 0U)];
}
std::span<const Attribute<BuildingRecord>> given_attributes(bool with_roof) {
    using Attributes = std::vector<Attribute<BuildingRecord>>;
    const auto table = [](bool roof) {
        Attributes all;
        std::ranges::copy_if(building_table, std::back_inserter(all), suits_given,
                             &Attribute<BuildingRecord>::name);
        if (roof)
            all.insert(all.end(), roof_table.begin(), roof_table.end());
        all.insert(all.end(), fit_table.begin(), fit_table.end());
        return all;
    };
    static const std::array<Attributes, 2> tables{table(false), table(true)};
    return tables[with_roof ? 1U : 0U];
}
std::vector<FieldValue> given_values(const Options& options, const BuildingRecord& record) {
    const std::span<const Attribute<BuildingRecord>> attributes = given_attributes(options);
    std::vector<FieldValue> values = field_values(attributes, record);
    for (std::size_t i = 0; record.points == 0 && i < attributes.size(); ++i)
        if (!is_of_shape(attributes[i].name))
            values[i] = {};
    return values;
}
std::span<const Attribute<RoofFaceRecord>> roof_face_attributes() {
    return roof_face_table;
}
std::span<const Attribute<ContourRecord>> contour_attributes() {
    return contour_table;
}

template <typename Record>
std::vector<FieldSpec> field_specs(std::span<const Attribute<Record>> attributes,
                                   const std::string& vertical_unit, FieldNames names) {
    std::vector<FieldSpec> fields;
    for (const Attribute<Record>& a : attributes) {
        const std::string unit = unit_name(a.unit, vertical_unit);
        fields.push_back({std::string(field_name(names, a.name)),
                          std::string(a.alias) + (unit.empty() ? "" : " (" + unit + ")"), a.type, unit,
                          std::string(a.description)});
    }
    return fields;
}

template std::vector<FieldSpec> field_specs(std::span<const Attribute<BuildingRecord>>, const std::string&,
                                            FieldNames);
template std::vector<FieldSpec> field_specs(std::span<const Attribute<ContourRecord>>, const std::string&,
                                            FieldNames);
template std::vector<FieldSpec> field_specs(std::span<const Attribute<RejectedRecord>>, const std::string&,
                                            FieldNames);
template std::vector<FieldSpec> field_specs(std::span<const Attribute<ProblemRecord>>, const std::string&,
                                            FieldNames);
template std::vector<FieldSpec> field_specs(std::span<const Attribute<RoofFaceRecord>>, const std::string&,
                                            FieldNames);

std::string schema_table(std::span<const FieldSpec> fields) {
    std::string text = "| field | type | unit | meaning |\n|---|---|---|---|\n";
    for (const FieldSpec& field : fields) {
        const char* const type = field.type == FieldType::integer ? "integer"
                                 : field.type == FieldType::real  ? "real"
                                                                  : "text";
        text += "| `" + field.name + "` | " + type + " | " + field.unit + " | " + field.description + " |\n";
    }
    return text;
}

std::string schema_markdown() {
    const auto table = [](const auto& attributes) {
        return schema_table(field_specs(attributes, "vertical unit"));
    };
    return "## buildings\n\n" + table(all_building_attributes()) + "\n## contours\n\n" +
           table(contour_attributes()) + "\n## roofs\n\n" + table(roof_face_attributes()) +
           "\n## rejected\n\n" + table(rejected_attributes()) + "\n## problems\n\n" +
           table(problem_attributes());
}

std::span<const Attribute<RejectedRecord>> rejected_attributes() {
    return rejected_table;
}

std::span<const Attribute<ProblemRecord>> problem_attributes() {
    return problem_table;
}

}  // namespace d2b::features
