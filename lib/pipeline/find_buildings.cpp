#include "pipeline/find_buildings.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>

#include "core/progress_span.hpp"
#include "core/row_bands.hpp"
#include "core/stage_clock.hpp"
#include "detect/detection.hpp"
#include "detect/ground_level.hpp"
#include "detect/merge_strips.hpp"
#include "detect/side_grids.hpp"
#include "ground/ground.hpp"
#include "pipeline/scene_rasters.hpp"

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

/// What the strips of a run have in common.
struct Job {
    const RunPlan& plan;
    const Sources& sources;
    const Sinks& sinks;
    ElevationReader& reader;
    CellSize cell;
    double metres;  ///< in one vertical unit
    Context& context;

    [[nodiscard]] const Window& window() const { return sources.dem.info().window; }
    [[nodiscard]] Executor& threads() const { return *context.threads; }
};

MetreGrid surface_of(const Job& job, RowBand rows) {
    const Window& window = job.window();
    MetreGrid surface(rows.end - rows.begin, window.cols, 0, job.threads());
    const std::int32_t first = window.row + rows.begin;
    job.reader.for_rows(first, window.row + rows.end, [&](const ElevationBand& band) {
        const std::int32_t begin = std::max(band.shape.first_row, first);
        const std::int32_t end = std::min(band.shape.first_row + band.shape.rows, window.row + rows.end);
        for (std::int32_t row = begin; row < end; ++row)
            std::ranges::transform(band.row(row - band.shape.first_row), surface.row(row - first).data(),
                                   [&](double z) { return static_cast<float>(z * job.metres); });
    });
    return surface;
}

/// The terrain as it is given or estimated. Where that finds a cell to be far below the ground, the surface
/// is not known.
MetreGrid terrain_of(const Job& job, RowBand rows, MetreGrid& surface) {
    if (job.plan.ground == GroundMode::none)
        return MetreGrid(surface.rows, surface.cols, 0);
    if (job.plan.ground == GroundMode::given)
        return read_grid(*job.sources.terrain, rows, job.metres, job.context);
    const StageClock clock(job.context.report, Stage::ground);
    const Window& window = job.window();
    Terrain terrain = estimate_ground(surface, job.cell, job.plan.asked.ground, job.context,
                                      {window.row + rows.begin, window.col});
    for_cells(job.threads(), surface, [&](Cells cells) {
        for (std::size_t i = cells.begin; i < cells.end; ++i)
            if ((terrain.flags.values[i] & low_outlier) != 0)
                surface.values[i] = unknown;  // far below the ground: neither building nor ground
    });
    return std::move(terrain.elevation);
}

/// The terrain that detection stands on is nowhere above the surface.
void keep_below(const Job& job, const MetreGrid& surface, MetreGrid& terrain) {
    if (job.plan.ground != GroundMode::given)
        return;
    for_cells(job.threads(), terrain, [&](Cells cells) {
        for (std::size_t i = cells.begin; i < cells.end; ++i)
            if (terrain.values[i] > surface.values[i])
                terrain.values[i] = surface.values[i];
    });
}

/// What stands in a strip.
struct StripFound {
    Grid<Label> labels;
    std::vector<SeenObject> objects;  ///< by label - 1
};

std::vector<SeenObject> seen_objects(const Detection& detection, const std::vector<double>& ground,
                                     RowBand own, Executor& threads) {
    std::vector<SeenObject> seen;
    for (std::size_t i = 0; i < detection.objects.size(); ++i)
        seen.push_back({detection.objects[i], i < detection.buildings, ground[i + 1], 0});
    for_row_bands(threads, own.end - own.begin, detection.labels.cols, [&](RowBand band) {
        for (std::int32_t r = own.begin + band.begin; r < own.begin + band.end; ++r)
            for_label_runs(detection.labels.row(r), [&](std::int32_t begin, std::int32_t end, Label label) {
                std::atomic_ref(seen[label - 1].own_cells).fetch_add(end - begin, std::memory_order_relaxed);
            });
    });
    return seen;
}

/// What options left out whose first cells lie in rows.
void count_left_out(const LeftOut& left_out, RowBand own, RunReport& report) {
    const auto count = [&](const std::vector<std::int32_t>& rows, Reason reason) {
        report.count(reason, std::ranges::count_if(
                                 rows, [&](std::int32_t r) { return r >= own.begin && r < own.end; }));
    };
    count(left_out.small, Reason::building_small);
    count(left_out.low, Reason::building_low);
}

/// @param found gets what is seen of the ground and of what accompanies the DEM
/// @param quality of the surface, known from the first strip with enough roofs on
StripFound find_in_strip(const Job& job, const Strip& strip, FoundBuildings& found,
                         std::optional<SurfaceQuality>& quality) {
    const RowBand own{strip.own.begin - strip.seen.begin, strip.own.end - strip.seen.begin};
    MetreGrid surface = surface_of(job, strip.seen);
    MetreGrid terrain = terrain_of(job, strip.seen, surface);
    add_fit(surface, terrain, own, found.fit, job.threads());
    add_slope(terrain, job.cell, strip.seen.begin, own, found.slope);
    keep_below(job, surface, terrain);
    Mask allowed;
    MetreGrid ndvi;
    Scene scene{surface, terrain, job.cell};
    if (job.sources.mask != nullptr) {
        allowed = read_mask(*job.sources.mask, strip.seen, job.context);
        scene.allowed = &allowed;
        found.sides.mask = found.sides.mask || meets(surface, allowed, own);
    }
    if (job.sources.ndvi != nullptr) {
        ndvi = read_grid(*job.sources.ndvi, strip.seen, 1, job.context);
        scene.greenness = &ndvi;
        found.sides.ndvi = found.sides.ndvi || meets(surface, ndvi, own);
    }
    Detection detection = [&] {
        const StageClock clock(job.context.report, Stage::detect);
        return detect_buildings(scene, job.plan.asked.detect, job.plan.building_m2, job.context, quality);
    }();
    count_left_out(detection.left_out, own, job.context.report);
    write_scene_rasters(job.sinks, scene, detection, job.plan.asked.detect.min_height, own);
    const StageClock clock(job.context.report, Stage::attributes);
    const std::vector<double> ground =
        ground_levels(terrain, detection.labels, static_cast<Label>(detection.objects.size()), job.threads());
    std::vector<SeenObject> objects = seen_objects(detection, ground, own, job.threads());
    return {std::move(detection.labels), std::move(objects)};
}

void add_to_labels(Grid<Label>& labels, Label more, Executor& threads) {
    if (more == 0)
        return;
    for_cells(threads, labels, [&](Cells cells) {
        for (std::size_t i = cells.begin; i < cells.end; ++i)
            labels.values[i] += labels.values[i] != 0 ? more : 0;
    });
}

/// The two rows on both sides of the seam under a strip, as that strip saw them.
using SeamRows = std::array<std::vector<Label>, 2>;

SeamRows rows_at(const Grid<Label>& labels, std::int32_t seam) {
    SeamRows rows;
    for (const std::int32_t side : {0, 1})
        if (seam > 0 && seam < labels.rows)
            rows[static_cast<std::size_t>(side)].assign(labels.row(seam - 1 + side).begin(),
                                                        labels.row(seam - 1 + side).end());
    return rows;
}

void put_into(FoundBuildings& found, StripMerger::Merged&& merged, bool keep_doubtful, double metres,
              RunReport& report) {
    found.buildings = merged.buildings;
    report.count(Reason::building_doubtful,
                 static_cast<std::int64_t>(merged.objects.size()) - found.buildings);
    if (!keep_doubtful) {
        merged.objects.resize(merged.buildings);
        for (Label& number : merged.number)
            number = number > merged.buildings ? 0 : number;
    }
    found.ground.push_back(std::numeric_limits<double>::quiet_NaN());
    found.footprints.emplace_back();
    for (const SeenObject& seen : merged.objects) {
        found.ground.push_back(seen.ground / metres);
        found.footprints.push_back(
            {found.ground.back(), seen.object.confidence, doubt_name(seen.object.doubt)});
    }
    found.labels.renumber(std::move(merged.number));
}

}  // namespace

FoundBuildings find_buildings(const RunPlan& plan, const Sources& sources, const Sinks& sinks,
                              ElevationReader& reader, const CellSize& cell, double metres, Context& context,
                              const StripSize& size) {
    // What stands at a seam is seen whole by both strips, and so is the ground around it.
    constexpr double widths_around = 5;
    const Options& options = plan.asked;
    const Job job{plan, sources, sinks, reader, cell, metres, context};
    const std::vector<Strip> strips =
        strips_of(job.window(), cell, widths_around * options.ground.max_building_width, size);
    FoundBuildings found;
    found.labels = LabelRows(context.make_spool());
    found.fit = GroundFit(options.detect.min_height);
    found.sides = {true, sources.mask == nullptr, sources.ndvi == nullptr};
    StripMerger merger;
    SeamRows above;
    std::optional<SurfaceQuality> quality;
    for (const Strip& strip : strips) {
        const ProgressSpan span(context, static_cast<double>(strip.own.begin) / job.window().rows,
                                static_cast<double>(strip.own.end) / job.window().rows);
        StripFound here = find_in_strip(job, strip, found, quality);
        const StageClock clock(context.report, Stage::detect);
        add_to_labels(here.labels, merger.add(here.objects), job.threads());
        const SeamRows upper_seam = rows_at(here.labels, strip.own.begin - strip.seen.begin);
        for (std::size_t side = 0; side < above.size(); ++side)
            merger.compare(above[side], upper_seam[side]);
        above = rows_at(here.labels, strip.own.end - strip.seen.begin);
        found.labels.append(here.labels,
                            {strip.own.begin - strip.seen.begin, strip.own.end - strip.seen.begin},
                            job.threads());
    }
    if (plan.ground == GroundMode::given)
        context.report.count(Reason::terrain_outside_range, sources.terrain->cells_outside_range());
    found.sides.terrain = plan.ground != GroundMode::given || found.fit.cells() > 0;
    put_into(found, merger.finish(strips.size() > 1 ? cells_for(plan.building_m2, cell) : 1),
             options.write.doubtful, metres, context.report);
    return found;
}

}  // namespace d2b
