#include "pipeline/find_buildings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "attributes/ground_level.hpp"
#include "core/row_bands.hpp"
#include "detect/detection.hpp"
#include "ground/ground.hpp"
#include "pipeline/scene_rasters.hpp"
#include "pipeline/side_grids.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A part of a whole grid: the same indices.
struct Cells {
    std::size_t begin;
    std::size_t end;
};

/// Calls work(cells) for bands of a grid, on all threads.
template <typename T, typename Work>
void for_cells(Executor& threads, const Grid<T>& grid, const Work& work) {
    for_row_bands(threads, grid.rows, grid.cols, [&](RowBand band) {
        work(Cells{grid.index(band.begin, 0), grid.index(band.end, 0)});
    });
}

MetreGrid surface_of(ElevationReader& reader, const Window& window, double metres, Executor& threads) {
    MetreGrid surface(window.rows, window.cols, 0, threads);
    reader.for_each(
        [&](std::size_t, const ElevationBand& band, Tally&) {
            float* out = surface.row(band.shape.first_row - window.row).data();
            for (std::size_t i = 0; i < band.elevations.size(); ++i)
                out[i] = static_cast<float>(band.elevations[i] * metres);
            return true;
        },
        [](const ElevationBand&, bool) {});
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
        for_cells(*context.threads, terrain, [&](Cells cells) {
            for (std::size_t i = cells.begin; i < cells.end; ++i)
                if (terrain.values[i] > surface.values[i])
                    terrain.values[i] = surface.values[i];
        });
        return terrain;
    }
    const StageClock clock(context.report, Stage::ground);
    Terrain terrain = estimate_ground(surface, cell, options.ground, context, {window.row, window.col});
    for_cells(*context.threads, surface, [&](Cells cells) {
        for (std::size_t i = cells.begin; i < cells.end; ++i)
            if ((terrain.flags.values[i] & low_outlier) != 0)
                surface.values[i] = unknown;  // far below the ground: neither building nor ground
    });
    return std::move(terrain.elevation);
}

Detection detect(const Scene& scene, const DetectOptions& options, bool keep_doubtful, Context& context) {
    const StageClock clock(context.report, Stage::detect);
    Detection detection = detect_buildings(scene, options, context);
    context.report.count(Reason::building_doubtful,
                         static_cast<std::int64_t>(detection.objects.size()) - detection.buildings);
    if (!keep_doubtful) {
        for_cells(*context.threads, detection.labels, [&](Cells cells) {
            for (std::size_t i = cells.begin; i < cells.end; ++i)
                if (detection.labels.values[i] > detection.buildings)
                    detection.labels.values[i] = 0;
        });
        detection.objects.resize(detection.buildings);
    }
    return detection;
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
    MetreGrid surface = surface_of(reader, window, metres, *context.threads);
    const MetreGrid terrain = terrain_below(surface, options, sources, cell, metres, context);
    const Mask allowed = sources.mask == nullptr ? Mask() : read_mask(*sources.mask, context);
    const MetreGrid ndvi = sources.ndvi == nullptr ? MetreGrid() : read_grid(*sources.ndvi, 1, context);
    const Scene scene{surface, terrain, cell, sources.mask == nullptr ? nullptr : &allowed,
                      sources.ndvi == nullptr ? nullptr : &ndvi};
    Detection detection = detect(scene, options.detect, options.write.doubtful, context);
    write_scene_rasters(sinks, scene, detection, options.detect.min_height);

    const StageClock clock(context.report, Stage::attributes);
    FoundBuildings found;
    found.buildings = detection.buildings;
    found.ground = ground_levels(terrain, detection.labels, static_cast<Label>(detection.objects.size()),
                                 *context.threads);
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
