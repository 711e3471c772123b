#include "score/limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/polygon_layer.hpp"

namespace d2b::score {
namespace {

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

}  // namespace

std::vector<Limit> limits_of(const ScoreRequest& request, Warnings& warnings) {
    std::vector<Limit> limits;
    for (auto& limit : {area_of_interest(request, warnings), raster_with_data(request, warnings)})
        if (limit)
            limits.push_back(*limit);
    return limits;
}

MeasurePlane common_plane(const ScoreRequest& request, std::span<const Limit> limits, const Extent& found,
                          const Extent& reference, Warnings& warnings) {
    if (!request.dem.empty() && limits.back().crs.kind() != Crs::Kind::none)
        return measure_plane(limits.back().crs, box_of(limits.back().area), warnings);
    const Extent& side = reference.crs.kind() == Crs::Kind::none ? found : reference;
    return measure_plane(side.crs, side.box, warnings);
}

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

std::optional<Polygons> region_of(std::vector<Limit>& limits, const MeasurePlane& plane, const Extent& found,
                                  const Extent& reference, Overlay& overlay, Warnings& warnings) {
    check_meets("'" + found.name + "'", found.box, "'" + reference.name + "'", reference.box);
    std::optional<Polygons> region;
    for (Limit& limit : limits) {
        transform_to(plane, limit.crs, limit.name, std::span(&limit.area, 1), LongEdges::divide, warnings);
        for (const Extent* side : {&found, &reference})
            check_meets("'" + side->name + "'", side->box, limit.what, box_of(limit.area));
        const Polygons area = overlay.repaired_union(limit.area);
        region = region ? overlay.intersection(*region, area) : area;
    }
    if (region && region->empty())
        throw InputError("The area of interest has no cell of '" + limits.back().name +
                         "' with data; check both files.");
    return region;
}

}  // namespace d2b::score
