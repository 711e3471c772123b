#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Feature with polygons.
struct PolygonFeature {
    std::vector<WorldPolygon> polygons;  ///< rings in their original orientation
    std::optional<double> height;        ///< value of the height field; nothing if it is NULL
    bool open_ring = false;              ///< a ring did not end at its start; it is closed here
};

/// Layer of polygons in memory.
struct PolygonLayer {
    std::string dataset;  ///< name given by the user
    std::string name;
    std::string crs_wkt;       ///< WKT2:2019; empty if there is none
    std::string height_field;  ///< name of the field found; "" if there is none
    std::vector<PolygonFeature> features;
};

/// Measures how much polygons look like buildings: those that touch the region, whole, without vertices that
/// are within 5 cm of a line.
struct ShapeScore {
    std::size_t polygons = 0;
    std::size_t corners = 0;
    double corners_per_building = 0;         ///< corners / polygons
    double right_share = 0;                  ///< share of corners within 3 degrees of 90 or 270
    double sharp45_share = 0;                ///< share of corners whose walls enclose less than 45 degrees
    double along_share = 0;                  ///< share of length along or across the main direction
    std::optional<double> short_edge_share;  ///< share of edges below two cells; nullopt: cells unknown
};

/// Measures of one side, within the region.
struct SideScore {
    std::size_t features = 0;  ///< all, also outside of the region
    std::size_t invalid = 0;   ///< number of all features that are invalid
    std::size_t vertices =
        0;  ///< vertices of features that touch the region; the reference's after simplification
    double area_m2 = 0;
    std::size_t objects = 0;          ///< features not below the smallest size
    std::size_t objects_covered = 0;  ///< objects covered at least half by the other side
    ShapeScore shape;
};

/// Errors of heights, found minus reference.
struct HeightErrors {
    std::size_t pairs = 0;
    double mean = 0;
    double rms = 0;
    double median_absolute = 0;
};

/// Angles between the main directions of matching objects, modulo 90 degrees.
struct DirectionErrors {
    std::size_t pairs = 0;
    double median_deg = 0;
    double p90_deg = 0;
};

/// Agreement of detected footprints with a reference. Ratios with a zero denominator are 0.
struct Score {
    SideScore found;
    SideScore reference;
    double shared_m2 = 0;
    double completeness = 0;              ///< recall: share of the reference's area that was found
    double correctness = 0;               ///< precision: share of the found area that is in the reference
    double iou = 0;                       ///< intersection over union of the areas
    double object_completeness = 0;       ///< share of the reference's objects that are covered
    double object_correctness = 0;        ///< share of the found objects that are covered
    double outline_m = 0;                 ///< length of the found outline
    double outline_near_m = 0;            ///< length of it within the limit of the reference's outline
    std::optional<double> outline_rms_m;  ///< distance over that length
    double overlap = 0;             ///< area covered at least twice / area covered, for all found features
    double vertex_ratio = 0;        ///< found / reference
    std::size_t pairs = 0;          ///< number of matching objects
    std::optional<double> polis_m;  ///< PoLiS distance (Avbelj et al. 2015), mean over the pairs
    std::optional<HeightErrors> heights;        ///< only pairs in which both have a height
    std::optional<DirectionErrors> directions;  ///< only pairs of objects below 400 m2
};

/// Input of a comparison.
struct ScoreRequest {
    std::string found;
    std::string reference;         ///< "" if it is not a dataset
    std::string layer;             ///< layer of `found`; "": "buildings", otherwise the first with geometries
    std::string reference_layer;   ///< "": "blocks_dissolved", otherwise as above
    std::string height_field;      ///< field of the reference; "": "height", "Height" or "roof_h", if any
    std::string area_of_interest;  ///< a layer of the reference, or a dataset; "": the layer "aoi", if any
    std::string dem;               ///< excludes everything outside of its valid cells; "": no limit
    double min_object_m2 = 50;
    std::string roof_types;  ///< of compare_roofs(): dataset with types of the reference's roofs; "": the
                             ///< reference
};

/// Compared layers and the result.
struct ScoreRun {
    std::string found_layer;
    std::string reference_layer;
    std::string reference_height_field;  ///< "" if there is none
    std::string crs;                     ///< CRS of the measurement; "" if there is none
    double metres = 1;                   ///< metres in one unit of it
    bool limited = false;                ///< by an area of interest or a raster
    std::optional<double> cell_m;  ///< shorter side of a cell of the raster, in metres; nullopt without one
    Score score;
};

/// Brings two layers of footprints to one CRS and compares them. Warns if a side is empty. @param found,
/// reference in memory; if null, the one named in the request, which is ignored otherwise @throws InputError:
/// one cannot be read, or they do not overlap. @throws OptionError: no such layer or field
[[nodiscard]] ScoreRun compare_layers(const ScoreRequest& request, const PolygonLayer* found,
                                      const PolygonLayer* reference, const Callbacks& callbacks = {});

/// Reads two layers of footprints, brings them to one CRS and compares them. Warns if a side is empty.
/// @throws InputError: one cannot be read, or they do not overlap. @throws OptionError: no such layer or
/// field
[[nodiscard]] ScoreRun compare_datasets(const ScoreRequest& request, const Callbacks& callbacks = {});

/// Errors of an angle, weighted by area: those not exceeded on a half and on nine tenths of it.
struct AngleErrors {
    double median_deg = 0;
    double p90_deg = 0;
};

/// Agreement of roof planes with a reference. Areas are those in plan, within the region. Ratios with a zero
/// denominator are 0.
struct RoofScore {
    std::size_t found_faces = 0;      ///< all, also outside of the region
    std::size_t reference_faces = 0;  ///< same
    double found_m2 = 0;
    double reference_m2 = 0;
    double shared_m2 = 0;      ///< of the reference, inside found faces
    double covered = 0;        ///< shared / reference
    double angles_right = 0;   ///< share of the shared area with slope within 5 and azimuth within 10 degrees
    double overlap = 0;        ///< area covered by several found faces / area covered
    double without_slope = 0;  ///< share of the shared area on which the found faces have no slope
    std::optional<AngleErrors> slope;    ///< where both have a slope
    std::optional<AngleErrors> azimuth;  ///< where both have an azimuth and are 8 degrees or steeper
    double heights_right =
        0;  ///< share of the shared area with elevation within 1 m and slope within 5 degrees
    double heights_iou = 0;     ///< that area / area in either
    std::size_t buildings = 0;  ///< of the reference, with a type, not below the smallest size
    std::size_t compared = 0;   ///< of these, covered at least half by one found building
    std::size_t right = 0;      ///< of these, with the type of that building
    double type_right = 0;      ///< right / compared
    std::size_t pairs = 0;      ///< of those compared, with an IoU of at least 0.5
    std::size_t pairs_right = 0;
    double pair_type_right = 0;  ///< pairs_right / pairs
    /// number of buildings compared, by the reference's type and the found type
    std::map<std::string, std::map<std::string, std::size_t>> types;
};

/// Compared layers of roof planes and the result.
struct RoofScoreRun {
    std::string found_layer;
    std::string reference_layer;
    std::string crs;       ///< CRS of the measurement; "" if there is none
    double metres = 1;     ///< metres in one unit of it
    bool limited = false;  ///< by an area of interest or a raster
    RoofScore score;
};

/// Reads two layers of roof planes (`roofs`, or as the request names them) with the buildings under them,
/// brings them to one CRS and compares them. Warns if a side is empty. @throws InputError: one cannot be
/// read, has no elevations, or they do not overlap. @throws OptionError: no such layer or field
[[nodiscard]] RoofScoreRun compare_roofs(const ScoreRequest& request, const Callbacks& callbacks = {});

}  // namespace d2b
