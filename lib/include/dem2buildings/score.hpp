#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// A feature with polygons.
struct PolygonFeature {
    std::vector<WorldPolygon> polygons;  ///< rings run as they ran in the file
    std::optional<double> height;        ///< of the field that was asked for; nothing where it is NULL
    bool open_ring = false;              ///< a ring did not end where it began; it is closed here
};

/// A layer of polygons, with all of it in memory.
struct PolygonLayer {
    std::string dataset;  ///< as the user gave it
    std::string name;
    std::string crs_wkt;       ///< WKT2:2019, empty where there is none
    std::string height_field;  ///< that was found; "" where there is none
    std::vector<PolygonFeature> features;
};

/// Of one side, within the region.
struct SideScore {
    std::size_t features = 0;  ///< all, also outside of the region
    std::size_t invalid = 0;   ///< of all features
    std::size_t vertices = 0;  ///< of features that touch the region; the reference's are simplified before
    double area_m2 = 0;
    std::size_t objects = 0;          ///< not smaller than the smallest
    std::size_t objects_covered = 0;  ///< by the other side, at least half of each
};

/// Of heights, found less reference.
struct HeightErrors {
    std::size_t pairs = 0;
    double mean = 0;
    double rms = 0;
    double median_absolute = 0;
};

/// How well found footprints agree with a reference. A share of nothing is 0.
struct Score {
    SideScore found;
    SideScore reference;
    double shared_m2 = 0;
    double completeness = 0;              ///< share of the reference's area that was found
    double correctness = 0;               ///< share of the found area that is in the reference
    double iou = 0;                       ///< shared area / area of both together
    double object_completeness = 0;       ///< share of the reference's objects that are covered
    double object_correctness = 0;        ///< share of the found objects that are covered
    double outline_m = 0;                 ///< length of the found outline
    double outline_near_m = 0;            ///< of that, within the limit of the reference's outline
    std::optional<double> outline_rms_m;  ///< over that
    double overlap = 0;             ///< area covered twice or more / area covered, of all found features
    double vertex_ratio = 0;        ///< found / reference
    std::size_t pairs = 0;          ///< of objects that match
    std::optional<double> polis_m;  ///< mean over the pairs
    std::optional<HeightErrors> heights;  ///< over the pairs where both have a height
};

/// What is compared with what.
struct ScoreRequest {
    std::string found;
    std::string reference;         ///< "" where it is no dataset
    std::string layer;             ///< of found; "": "buildings", else the first with geometries
    std::string reference_layer;   ///< "": "blocks_dissolved", else as above
    std::string height_field;      ///< of the reference; "": "height", "Height" or "roof_h", if any
    std::string area_of_interest;  ///< a layer of the reference, or a dataset; "": the layer "aoi", if any
    std::string dem;               ///< what is outside of its cells with data is left out; "": nothing is
    double min_object_m2 = 50;
};

/// What was compared with what, and the result.
struct ScoreRun {
    std::string found_layer;
    std::string reference_layer;
    std::string reference_height_field;  ///< "" for none
    std::string crs;                     ///< in which it was measured; "" for none
    double metres = 1;                   ///< in one unit of it
    bool limited = false;                ///< by an area of interest or a raster
    Score score;
};

/// Brings two layers of footprints to one CRS and measures. Warns where a side is empty.
/// @param found, reference in memory; null: the request's, which else are not looked at
/// @throws InputError: one cannot be read, or they do not meet. @throws OptionError: no such layer or field
[[nodiscard]] ScoreRun compare_layers(const ScoreRequest& request, const PolygonLayer* found,
                                      const PolygonLayer* reference, const Callbacks& callbacks = {});

/// Reads two layers of footprints, brings them to one CRS and measures. Warns where a side is empty.
/// @throws InputError: one cannot be read, or they do not meet. @throws OptionError: no such layer or field
[[nodiscard]] ScoreRun compare_datasets(const ScoreRequest& request, const Callbacks& callbacks = {});

}  // namespace d2b
