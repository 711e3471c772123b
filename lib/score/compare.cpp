#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/score.hpp"
#include "geometry/box_tree.hpp"
#include "read/gdal_setup.hpp"
#include "read/polygon_layer.hpp"
#include "score/measure.hpp"
#include "score/score.hpp"

namespace d2b::score {
namespace {

/// Polygons that limit the area measured.
struct Limit {
    std::string name;  ///< name of the dataset
    std::string what;  ///< description for messages
    Crs crs;
    Polygons area;
    Polygons cell = {};  ///< of a raster: one cell in its middle
};

Polygons all_polygons(std::vector<PolygonFeature> footprints) {
    Polygons polygons;
    for (PolygonFeature& feature : footprints)
        std::ranges::move(feature.polygons, std::back_inserter(polygons));
    return polygons;
}

std::optional<Limit> area_of_interest(const ScoreRequest& request, Warnings& warnings) {
    reading::LayerChoice choice{request.reference, "aoi", {}, {}, {}};
    const std::vector<std::string> layers = request.reference.empty()
                                                ? std::vector<std::string>()
                                                : reading::layer_names(request.reference, warnings);
    const auto has = [&](const std::string& name) { return std::ranges::find(layers, name) != layers.end(); };
    if (!request.area_of_interest.empty()) {
        choice.layer = request.area_of_interest;
        if (!has(choice.layer))
            choice = {request.area_of_interest, {}, {}, {}, {}};
    } else if (!has("aoi")) {
        return std::nullopt;
    }
    PolygonLayer layer = reading::read_polygon_layer(choice, warnings);
    const std::string what = "the area of interest, layer '" + layer.name + "' of '" + layer.dataset + "',";
    if (layer.features.empty())
        throw InputError("The" + what.substr(3) + " has no polygons; give another one with -aoi.");
    return Limit{layer.dataset, what, Crs(layer.crs_wkt), all_polygons(std::move(layer.features))};
}

std::optional<Limit> raster_with_data(const ScoreRequest& request, Warnings& warnings) {
    if (request.dem.empty())
        return std::nullopt;
    reading::ValidCells cells = reading::valid_cells(request.dem, warnings);
    return Limit{request.dem,
                 "the part of '" + request.dem + "' that has data",
                 Crs(cells.crs_wkt),
                 std::move(cells.polygons),
                 {{std::move(cells.middle_cell), {}}}};
}

/// Returns the shorter side of a cell in metres, because an edge along two cells is not short; nothing
/// without a raster.
std::optional<double> cell_size(std::vector<Limit>& limits, const MeasurePlane& plane, Warnings& warnings) {
    if (limits.empty() || limits.back().cell.empty())
        return std::nullopt;
    Limit& raster = limits.back();
    transform_to(plane, raster.crs, raster.name, std::span(&raster.cell, 1), LongEdges::keep, warnings);
    const WorldRing& cell = raster.cell.front().exterior;
    const auto side = [&](std::size_t i) {
        return std::hypot(cell[i + 1].x - cell[i].x, cell[i + 1].y - cell[i].y);
    };
    return std::min(side(0), side(1)) * plane.metres;
}

/// One side of the comparison, before and after its transformation to the plane.
struct Side {
    std::string name;
    Crs crs;
    ScoreSide score;
};

Side side_of(const PolygonLayer& layer, Overlay& overlay, Warnings& warnings) {
    if (layer.features.empty())
        warnings.add("The layer '" + layer.name + "' of '" + layer.dataset + "' has no polygons.");
    return {layer.dataset, Crs(layer.crs_wkt), score_side(layer.features, overlay)};
}

std::string extent(const Box& box) {
    return number_text(box.left) + " " + number_text(box.low) + " to " + number_text(box.right) + " " +
           number_text(box.high);
}

/// Disjoint extents indicate a wrong file or CRS.
void check_meets(const std::string& a, const Box& box_a, const std::string& b, const Box& box_b) {
    if (box_a.empty() || box_b.empty() || box_a.intersects(box_b))
        return;
    throw InputError(a + " (" + extent(box_a) + ") and " + b + " (" + extent(box_b) +
                     ") do not meet; check the files and their coordinate reference systems.");
}

/// Intersection of all limits.
std::optional<Polygons> region_of(std::vector<Limit>& limits, const MeasurePlane& plane, const Side& found,
                                  const Side& reference, Overlay& overlay, Warnings& warnings) {
    std::optional<Polygons> region;
    for (Limit& limit : limits) {
        transform_to(plane, limit.crs, limit.name, std::span(&limit.area, 1), LongEdges::divide, warnings);
        for (const Side* side : {&found, &reference})
            check_meets("'" + side->name + "'", box_of_all(side->score.areas), limit.what,
                        box_of(limit.area));
        const Polygons area = overlay.repaired_union(limit.area);
        region = region ? overlay.intersection(*region, area) : area;
    }
    if (region && region->empty())
        throw InputError("The area of interest has no cell of '" + limits.back().name +
                         "' with data; check both files.");
    return region;
}

reading::LayerChoice found_choice(const ScoreRequest& request) {
    return {request.found, request.layer, {"buildings"}, {}, {"height"}};
}

reading::LayerChoice reference_choice(const ScoreRequest& request) {
    return {request.reference,
            request.reference_layer,
            {"blocks_dissolved", "buildings"},
            request.height_field,
            {"height", "Height", "roof_h"}};
}

ScoreRun score_layers(const ScoreRequest& request, const PolygonLayer& found_layer,
                      const PolygonLayer& reference_layer, Warnings& warnings) {
    Overlay overlay;
    std::vector<Limit> limits;
    for (auto& limit : {area_of_interest(request, warnings), raster_with_data(request, warnings)})
        if (limit)
            limits.push_back(*limit);
    Side found = side_of(found_layer, overlay, warnings);
    Side reference = side_of(reference_layer, overlay, warnings);

    const bool by_raster = !request.dem.empty() && limits.back().crs.kind() != Crs::Kind::none;
    const bool by_found = reference.crs.kind() == Crs::Kind::none && !by_raster;
    const Crs& crs = by_raster ? limits.back().crs : by_found ? found.crs : reference.crs;
    const Box box = by_raster ? box_of(limits.back().area)
                              : box_of_all(by_found ? found.score.areas : reference.score.areas);
    const MeasurePlane plane = measure_plane(crs, box, warnings);
    for (Side* side : {&found, &reference})
        transform_to(plane, side->crs, side->name, side->score.areas, LongEdges::keep, warnings);
    check_meets("'" + found.name + "'", box_of_all(found.score.areas), "'" + reference.name + "'",
                box_of_all(reference.score.areas));

    ScoreOptions options;
    options.region = region_of(limits, plane, found, reference, overlay, warnings);
    options.metres = plane.metres;
    options.cell_m = cell_size(limits, plane, warnings);
    options.min_object_m2 = request.min_object_m2;
    ScoreRun run{found_layer.name,
                 reference_layer.name,
                 reference_layer.height_field,
                 plane.local ? "local transverse Mercator projection" : plane.crs.name(),
                 plane.metres,
                 options.region.has_value(),
                 options.cell_m,
                 {}};
    run.score = score(std::move(found.score), std::move(reference.score), options);
    return run;
}

}  // namespace
}  // namespace d2b::score

namespace d2b {

ScoreRun compare_layers(const ScoreRequest& request, const PolygonLayer* found, const PolygonLayer* reference,
                        const Callbacks& callbacks) {
    reading::register_formats();
    Warnings warnings(callbacks.on_warning);
    ScoreRequest with_limits = request;
    PolygonLayer read_found;
    if (found == nullptr)
        read_found = reading::read_polygon_layer(score::found_choice(request), warnings);
    PolygonLayer read_reference;
    if (reference == nullptr)
        read_reference = reading::read_polygon_layer(score::reference_choice(request), warnings);
    else
        with_limits.reference.clear();  // datasets in memory have no layer with an area of interest
    return score::score_layers(with_limits, found != nullptr ? *found : read_found,
                               reference != nullptr ? *reference : read_reference, warnings);
}

ScoreRun compare_datasets(const ScoreRequest& request, const Callbacks& callbacks) {
    return compare_layers(request, nullptr, nullptr, callbacks);
}

}  // namespace d2b
