#include "pipeline/find_buildings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "attributes/ground_level.hpp"
#include "detect/detection.hpp"
#include "ground/ground.hpp"
#include "pipeline/side_grids.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

MetreGrid surface_of(ElevationReader& reader, const Window& window, double metres) {
    MetreGrid surface(window.rows, window.cols);
    reader.for_each([&](const ElevationBand& band) {
        float* out = surface.values.data() + surface.index(band.shape.first_row - window.row, 0);
        for (const double z : band.elevations)
            *out++ = static_cast<float>(z * metres);
    });
    return surface;
}

/// The terrain that detection stands on: nowhere above the surface.
MetreGrid terrain_below(MetreGrid& surface, const Options& options, const Sources& sources,
                        const CellSize& cell, double metres, Context& context) {
    if (options.ground.mode == GroundMode::none)
        return MetreGrid(surface.rows, surface.cols, 0);
    const Window& window = sources.dem.info().window;
    if (options.ground.mode == GroundMode::given) {
        MetreGrid terrain = read_grid(*sources.terrain, metres, context);
        for (std::size_t i = 0; i < terrain.size(); ++i)
            if (terrain.values[i] > surface.values[i])
                terrain.values[i] = surface.values[i];
        return terrain;
    }
    const StageClock clock(context.report, Stage::ground);
    Terrain terrain = estimate_ground(surface, cell, options.ground, context, {window.row, window.col});
    for (std::size_t i = 0; i < surface.size(); ++i)
        if ((terrain.flags.values[i] & low_outlier) != 0)
            surface.values[i] = unknown;  // far below the ground: neither building nor ground
    return std::move(terrain.elevation);
}

Detection detect(const Scene& scene, const DetectOptions& options, bool keep_doubtful, Context& context) {
    const StageClock clock(context.report, Stage::detect);
    Detection detection = detect_buildings(scene, options, context);
    context.report.count(Reason::building_doubtful,
                         static_cast<std::int64_t>(detection.objects.size()) - detection.buildings);
    if (!keep_doubtful) {
        for (Label& label : detection.labels.values)
            if (label > detection.buildings)
                label = 0;
        detection.objects.resize(detection.buildings);
    }
    return detection;
}

void write_rasters(const Sinks& sinks, const Scene& scene, const Detection& detection, double min_height) {
    if (sinks.ground != nullptr)
        write_grid(*sinks.ground, scene.terrain);
    if (sinks.height == nullptr && sinks.canopy == nullptr)
        return;
    MetreGrid height(scene.surface.rows, scene.surface.cols);
    for (std::size_t i = 0; i < height.size(); ++i)
        height.values[i] = scene.height(i);
    if (sinks.height != nullptr)
        write_grid(*sinks.height, height);
    if (sinks.canopy == nullptr)
        return;
    for (std::size_t i = 0; i < height.size(); ++i) {
        const bool building =
            detection.labels.values[i] != 0 && detection.labels.values[i] <= detection.buildings;
        if (!std::isnan(height.values[i]) && (building || height.values[i] <= static_cast<float>(min_height)))
            height.values[i] = 0;
    }
    write_grid(*sinks.canopy, height);
}

}  // namespace

LabelBand FoundBuildings::band(const BandShape& shape, std::int32_t window_row) const {
    const std::size_t first = labels.index(shape.first_row - window_row, 0);
    const auto begin = labels.values.begin() + static_cast<std::ptrdiff_t>(first);
    return {shape, {begin, begin + static_cast<std::ptrdiff_t>(shape.size())}};
}

FoundBuildings find_buildings(const Options& options, const Sources& sources, const Sinks& sinks,
                              ElevationReader& reader, const CellSize& cell, double metres,
                              Context& context) {
    const Window& window = sources.dem.info().window;
    MetreGrid surface = surface_of(reader, window, metres);
    const MetreGrid terrain = terrain_below(surface, options, sources, cell, metres, context);
    const Mask allowed = sources.mask == nullptr ? Mask() : read_mask(*sources.mask, context);
    const MetreGrid ndvi = sources.ndvi == nullptr ? MetreGrid() : read_grid(*sources.ndvi, 1, context);
    const Scene scene{surface, terrain, cell, sources.mask == nullptr ? nullptr : &allowed,
                      sources.ndvi == nullptr ? nullptr : &ndvi};
    Detection detection = detect(scene, options.detect, options.write.doubtful, context);
    write_rasters(sinks, scene, detection, options.detect.min_height);

    const StageClock clock(context.report, Stage::attributes);
    FoundBuildings found;
    found.buildings = detection.buildings;
    found.ground = ground_levels(terrain, detection.labels, static_cast<Label>(detection.objects.size()));
    found.footprints.emplace_back();
    for (std::size_t i = 0; i < detection.objects.size(); ++i) {
        double& ground = found.ground[i + 1];
        ground /= metres;
        found.footprints.push_back(
            {ground, detection.objects[i].confidence, doubt_name(detection.objects[i].doubt)});
    }
    found.labels = std::move(detection.labels);
    return found;
}

}  // namespace d2b
