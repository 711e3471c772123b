#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"
#include "read/gdal_setup.hpp"
#include "read/polygon_layer.hpp"
#include "score/limits.hpp"
#include "score/measure.hpp"
#include "score/score.hpp"

namespace d2b::score {
namespace {

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

Extent extent_of(const Side& side) {
    return {side.name, side.crs, box_of_all(side.score.areas)};
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
    std::vector<Limit> limits = limits_of(request, warnings);
    Side found = side_of(found_layer, overlay, warnings);
    Side reference = side_of(reference_layer, overlay, warnings);
    const MeasurePlane plane =
        common_plane(request, limits, extent_of(found), extent_of(reference), warnings);
    for (Side* side : {&found, &reference})
        transform_to(plane, side->crs, side->name, side->score.areas, LongEdges::keep, warnings);

    ScoreOptions options;
    options.region = region_of(limits, plane, extent_of(found), extent_of(reference), overlay, warnings);
    options.metres = plane.metres;
    options.cell_m = cell_size(limits, plane, warnings);
    options.min_object_m2 = request.min_object_m2;
    ScoreRun run{found_layer.name,
                 reference_layer.name,
                 reference_layer.height_field,
                 plane.name(),
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
