#include "pipeline/find_buildings.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "detect/corrections.hpp"
#include "detect/detection.hpp"
#include "detect/ground_level.hpp"
#include "detect/scene.hpp"
#include "ground/ground.hpp"

namespace d2b::pipeline {

/// Writes the requested rasters of a unit: terrain, heights above it, and canopy heights. Canopy is
/// everything higher than `min_height` metres that is not a building. Rows are computed while writing.
/// @param unit its own cells are written @param scene covers the unit's extent @throws OutputError
void write_scene_rasters(const Sinks& sinks, const detect::Scene& scene, const detect::Detection& detection,
                         double min_height, const detect::Unit& unit);

namespace {

MetreGrid read_surface(ElevationReader& reader, const Window& seen, double metres, Executor& threads) {
    MetreGrid surface = MetreGrid::unset(seen.rows, seen.cols, threads);
    reader.for_part(seen, [&](const ElevationBand& band) {
        std::ranges::transform(band.elevations, surface.row(band.shape.first_row - seen.row).data(),
                               [&](double z) { return static_cast<float>(z * metres); });
    });
    return surface;
}

constexpr std::int32_t rows_per_write = 256;

/// Writes value(i) for each of the unit's own cells, i being the index in a grid of the unit's extent.
template <typename Value>
void write_values(RasterSink& sink, const detect::Unit& unit, const Value& value) {
    std::vector<float> values;
    for (std::int32_t row = unit.own.row; row < unit.own.end_row(); row += rows_per_write) {
        const Window part{row, unit.own.col, std::min(rows_per_write, unit.own.end_row() - row),
                          unit.own.cols};
        values.clear();
        for (std::int32_t r = part.row; r < part.end_row(); ++r) {
            const auto first = static_cast<std::size_t>(std::int64_t{r - unit.seen.row} * unit.seen.cols +
                                                        (part.col - unit.seen.col));
            for (std::size_t i = first; i < first + static_cast<std::size_t>(part.cols); ++i)
                values.push_back(value(i));
        }
        sink.write(part, values);
    }
}

/// Heights above the ground. The canopy height of a cell without vegetation is 0.
class Heights {
  public:
    Heights(const detect::Scene& scene, const detect::Detection& detection, double min_height)
        : scene_(scene), detection_(detection), least_(static_cast<float>(min_height)) {}

    [[nodiscard]] float height(std::size_t i) const { return scene_.height(i); }
    [[nodiscard]] float canopy(std::size_t i) const {
        const float height = scene_.height(i);
        const bool building = detection_.is_kept_building(detection_.labels.values[i]);
        return !std::isnan(height) && (building || height <= least_) ? 0 : height;
    }

  private:
    const detect::Scene& scene_;
    const detect::Detection& detection_;
    float least_;
};

Executor& threads_of(const UnitSearch& search) {
    return *search.context.threads;
}

/// Reads or estimates the terrain. Cells that the estimate finds far below the ground become NaN in the
/// surface.
MetreGrid terrain_of(const UnitSearch& search, const Window& seen, UnitSurface& unit_surface) {
    MetreGrid& surface = unit_surface.elevations();
    if (search.plan.ground == GroundMode::none)
        return MetreGrid(surface.rows, surface.cols, 0);
    if (search.plan.ground == GroundMode::given)
        return detect::read_grid(*search.sources.terrain, seen, search.frame.metres, search.context);
    const StageClock clock(search.context.report, Stage::ground);
    ground::Terrain terrain = ground::estimate_ground(surface, search.frame.cell, search.plan.asked.ground,
                                                      search.context, {seen.row, seen.col});
    // Cells far below the ground are measurement errors, neither building nor ground.
    unit_surface.mask_flagged(terrain.flags, ground::low_outlier, threads_of(search));
    return std::move(terrain.elevation);
}

/// Clamps a given terrain to the surface, because detection expects heights that are not negative.
void keep_below(const UnitSearch& search, const MetreGrid& surface, MetreGrid& terrain) {
    if (search.plan.ground != GroundMode::given)
        return;
    for_cells(threads_of(search), terrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (terrain.values[i] > surface.values[i])
                terrain.values[i] = surface.values[i];
    });
}

/// Returns the window of a unit's own cells within its extent.
Window core_in_extent(const detect::Unit& unit) {
    return {unit.own.row - unit.seen.row, unit.own.col - unit.seen.col, unit.own.rows, unit.own.cols};
}

std::vector<detect::SeenObject> seen_objects(const detect::Detection& detection,
                                             const std::vector<double>& ground, const Window& own,
                                             Executor& threads) {
    std::vector<detect::SeenObject> seen;
    for (std::size_t i = 0; i < detection.objects.size(); ++i)
        seen.push_back({detection.objects[i], i < detection.buildings, ground[i + 1], 0, 0});
    for_row_bands(threads, own.rows, detection.labels.cols, [&](RowBand band) {
        for (std::int32_t r = own.row + band.begin; r < own.row + band.end; ++r)
            for_equal_runs(detection.labels.row(r).subspan(static_cast<std::size_t>(own.col),
                                                           static_cast<std::size_t>(own.cols)),
                           [&](std::int32_t begin, std::int32_t end, Label label) {
                               std::atomic_ref(seen[label - 1].own_cells)
                                   .fetch_add(end - begin, std::memory_order_relaxed);
                           });
    });
    return seen;
}

/// Cells of a unit that given footprints cover.
class CoveredCells {
  public:
    CoveredCells(std::int32_t rows, std::int32_t cols) : covered_(rows, cols) {}

    void add(const Grid<Label>& footprints, Executor& threads) {
        for_cells(threads, footprints, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (footprints.values[i] != 0)
                    covered_.values[i] = 1;
        });
    }
    /// Counts the cells of objects. @param own core of the unit within its extent
    void count(const Grid<Label>& objects, const Window& own, std::vector<detect::SeenObject>& seen) const {
        for (std::int32_t r = own.row; r < own.end_row(); ++r) {
            const auto in_core = [&](const auto& row) {
                return row.subspan(static_cast<std::size_t>(own.col), static_cast<std::size_t>(own.cols));
            };
            const auto covered = in_core(covered_.row(r));
            for_equal_runs(in_core(objects.row(r)), [&](std::int32_t begin, std::int32_t end, Label label) {
                seen[label - 1].covered += std::count(covered.begin() + begin, covered.begin() + end, 1);
            });
        }
    }

  private:
    Mask covered_;
};

/// Counts rejected or cut-off objects whose first cell belongs to the unit, so that each is counted once.
void count_rejected(const detect::RejectedObjects& rejected, const Window& own, RunReport& report) {
    const auto is_own = [&](const detect::FirstCell& cell) {
        return cell.row >= own.row && cell.row < own.end_row() && cell.col >= own.col &&
               cell.col < own.end_col();
    };
    report.count(Reason::building_small, std::ranges::count_if(rejected.small, is_own));
    report.count(Reason::building_low, std::ranges::count_if(rejected.low, is_own));
    report.count(Reason::part_merged, std::ranges::count_if(rejected.parts, is_own));
    for (const detect::CutCrown& crown : rejected.crowns)
        if (is_own(crown.first)) {
            report.count(Reason::crown_cut);
            report.count(Reason::crown_cells, crown.cells);
        }
}

/// Objects of a unit, with the scene and the detection that hold them.
struct SearchedUnit {
    const detect::Scene& scene;
    const detect::Detection& detection;
    const detect::Unit& unit;
    double min_height;
};

/// Measures given footprints, and how far they cover the objects that were found.
void see_given(const GivenFootprints& given, const SearchedUnit& searched, FoundInUnit& found,
               Executor& threads) {
    const Window own = core_in_extent(searched.unit);
    CoveredCells covered(searched.unit.seen.rows, searched.unit.seen.cols);
    for (std::size_t layer = 0; layer < given.layers.size(); ++layer) {
        Grid<Label> labels = given.labels(layer, searched.unit.seen, threads);
        covered.add(labels, threads);
        found.footprints.push_back(detect::see_footprints(searched.scene, searched.detection, labels, own,
                                                          searched.min_height, threads));
    }
    covered.count(searched.detection.labels, own, found.objects);
}

void store_merged(FoundBuildings& found, detect::UnitMerger::Merged&& merged, double metres) {
    found.buildings = merged.buildings;
    for (const detect::SeenObject& seen : merged.objects)
        found.add({seen.ground / metres, seen.object.confidence,
                   detect::counter_evidence_name(seen.object.doubt), seen.object.parcel, seen.object.whole});
    found.labels.renumber(std::move(merged.number));
}

/// Accumulates the results of units, which arrive row by row.
class UnitCollector {
  public:
    UnitCollector(const UnitSearch& search, std::int32_t unit_cols, FoundBuildings& found)
        : search_(search), found_(found), seams_(unit_cols) {}

    /// @param col column of the unit in its row
    void add(const detect::Unit& unit, std::int32_t col, FoundInUnit&& here) {
        const StageClock clock(search_.context.report, Stage::detect);
        Executor& threads = *search_.context.threads;
        found_.scene.merge(here.scene);
        found_.effective.insert(here.effective.begin(), here.effective.end());
        const Label more = merger_.add(here.objects);
        detect::UnitEdges edges = detect::edges_of(unit, here.labels);
        edges.add(more);
        seams_.add(col, std::move(edges), merger_);
        found_.labels.append(unit, here.labels, threads, more);
    }
    void finish(const detect::UnitGrid& units) {
        store_merged(
            found_,
            merge_found_units(merger_, search_.plan, units, search_.frame.cell, search_.context.report),
            search_.frame.metres);
    }

  private:
    const UnitSearch& search_;
    FoundBuildings& found_;
    detect::UnitMerger merger_;
    detect::UnitSeams seams_;
};

}  // namespace

UnitSurface::UnitSurface(ElevationReader& reader, const Window& seen, double metres, Executor& threads)
    : reader_(reader) {
    if (metres == 1)
        elevations_ = reader.lend(seen);
    is_borrowed_ = elevations_.size() > 0;
    if (!is_borrowed_)
        elevations_ = read_surface(reader, seen, metres, threads);
}

UnitSurface::~UnitSurface() {
    if (!is_borrowed_)
        return;
    for (const MaskedCell& taken : masked_cells_)
        elevations_.values[taken.cell] = taken.elevation;
    reader_.take_back(std::move(elevations_));
}

void UnitSurface::mask_flagged(const Grid<std::uint8_t>& flags, std::uint8_t flag, Executor& threads) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    std::mutex mutex;
    for_cells(threads, flags, [&](std::size_t begin, std::size_t end) {
        std::vector<MaskedCell> here;
        for (std::size_t i = begin; i < end; ++i)
            if ((flags.values[i] & flag) != 0)
                here.push_back({i, std::exchange(elevations_.values[i], unknown)});
        const std::lock_guard lock(mutex);
        masked_cells_.insert(masked_cells_.end(), here.begin(), here.end());
    });
}

void write_scene_rasters(const Sinks& sinks, const detect::Scene& scene, const detect::Detection& detection,
                         double min_height, const detect::Unit& unit) {
    const Heights heights(scene, detection, min_height);
    if (sinks.ground != nullptr)
        write_values(*sinks.ground, unit, [&](std::size_t i) { return scene.terrain.values[i]; });
    if (sinks.height != nullptr)
        write_values(*sinks.height, unit, [&](std::size_t i) { return heights.height(i); });
    if (sinks.canopy != nullptr)
        write_values(*sinks.canopy, unit, [&](std::size_t i) { return heights.canopy(i); });
}

FoundInUnit find_in_unit(const UnitSearch& search, const detect::Unit& unit) {
    const Options& options = search.plan.asked;
    const Sources& sources = search.sources;
    const UnitFrame& frame = search.frame;
    Context& context = search.context;
    Executor& threads = threads_of(search);
    const Window own = core_in_extent(unit);
    FoundInUnit found{{}, {}, detect::SceneStatistics(options.detect.min_height)};
    detect::SceneStatistics& statistics = found.scene;
    UnitSurface unit_surface(search.reader, unit.seen, frame.metres, threads);
    const MetreGrid& surface = unit_surface.elevations();
    detect::add_islands(surface, frame.cell, own, search.plan.building_m2, options.ground.max_building_width,
                        statistics.islands, threads);
    MetreGrid terrain = terrain_of(search, unit.seen, unit_surface);
    statistics.add_ground(surface, terrain, frame.cell, unit.seen.row - frame.window.row, own, threads);
    statistics.sides.terrain = search.plan.ground != GroundMode::given || statistics.fit.cells() > 0;
    keep_below(search, surface, terrain);
    Mask allowed;
    MetreGrid ndvi;
    detect::Scene scene{surface, terrain, frame.cell};
    if (search.plan.ground == GroundMode::automatic)
        scene.longest_swallowed = 2 * options.ground.max_building_width;
    if (sources.mask != nullptr) {
        allowed = detect::read_mask(*sources.mask, unit.seen, context);
        scene.allowed = &allowed;
    }
    if (sources.ndvi != nullptr) {
        ndvi = detect::read_grid(*sources.ndvi, unit.seen, 1, context);
        scene.greenness = &ndvi;
    }
    detect::ParcelGrid parcels;
    if (sources.parcels != nullptr) {
        parcels = detect::ParcelGrid(surface.rows, surface.cols);
        sources.parcels->read(unit.seen, parcels.values);
        scene.parcels = &parcels;
    }
    std::vector<detect::SceneCorrection> corrections;
    if (sources.corrections != nullptr) {
        corrections = detect::corrections_in(sources.corrections->corrections(), unit.seen);
        scene.corrections = corrections;
    }
    detect::Detection detection = [&] {
        const StageClock clock(context.report, Stage::detect);
        return detect::detect_buildings(scene, options.detect, search.plan.building_m2, context);
    }();
    detect::mark_denied(scene, detection, threads);
    if (sources.exclusion != nullptr)
        detect::mark_left_out(detect::read_mask(*sources.exclusion, unit.seen, context),
                              detect::LeftOut::excluded, detection, threads);
    found.effective = detect::effective_corrections(scene, detection, own);
    statistics.add_buildings(scene, detection, own, threads);
    count_rejected(detection.rejected, own, context.report);
    write_scene_rasters(search.sinks, scene, detection, options.detect.min_height, unit);
    const StageClock clock(context.report, Stage::attributes);
    const std::vector<double> ground = detect::ground_levels(
        terrain, detection.labels, static_cast<Label>(detection.objects.size()), threads);
    found.objects = seen_objects(detection, ground, own, threads);
    if (search.given != nullptr)
        see_given(*search.given, {scene, detection, unit, options.detect.min_height}, found, threads);
    found.labels = std::move(detection.labels);
    return found;
}

detect::UnitGrid unit_grid(const RunPlan& plan, const Window& window, const CellSize& cell,
                           const detect::UnitSize& size) {
    return {window, cell, halo_widths * plan.asked.ground.max_building_width, size};
}

std::int64_t min_cells(const RunPlan& plan, const detect::UnitGrid& units, const CellSize& cell) {
    return units.count() > 1 ? detect::cells_covering(plan.building_m2, cell) : 1;
}

detect::UnitMerger::Merged merge_found_units(detect::UnitMerger& merger, const RunPlan& plan,
                                             const detect::UnitGrid& units, const CellSize& cell,
                                             RunReport& report) {
    detect::UnitMerger::Merged merged = merger.finish(min_cells(plan, units, cell));
    report.count(Reason::building_doubtful, merged.doubtful);
    report.count(Reason::building_excluded, merged.excluded);
    report.count(Reason::building_denied, merged.denied);
    if (plan.asked.write.doubtful)
        return merged;
    merged.objects.resize(merged.buildings);
    for (Label& number : merged.number)
        number = number > merged.buildings ? 0 : number;
    return merged;
}

FoundBuildings find_buildings(const UnitSearch& search, const detect::UnitSize& size) {
    const RunPlan& plan = search.plan;
    const UnitFrame& frame = search.frame;
    Context& context = search.context;
    const detect::UnitGrid units = unit_grid(plan, frame.window, frame.cell, size);
    FoundBuildings found;
    found.labels = detect::LabelRows(context.make_spool(), frame.window);
    found.scene = detect::SceneStatistics(plan.asked.detect.min_height);
    UnitCollector sum(search, units.cols(), found);
    const auto all = static_cast<double>(frame.window.points());
    double done = 0;  // points
    for (std::int32_t row = 0; row < units.rows(); ++row)
        for (std::int32_t col = 0; col < units.cols(); ++col) {
            const detect::Unit unit = units.unit(row, col);
            const double before = std::exchange(done, done + static_cast<double>(unit.own.points()));
            const ProgressSpan span(context, before / all, done / all);
            FoundInUnit here = find_in_unit(search, unit);
            for (std::size_t layer = 0; layer < here.footprints.size(); ++layer)
                for (const detect::SeenFootprint& seen : here.footprints[layer])
                    search.given->add(search.given->layers[layer].footprints[seen.label], seen, frame.metres);
            sum.add(unit, col, std::move(here));
        }
    if (plan.ground == GroundMode::given)
        context.report.count(Reason::terrain_outside_range, search.sources.terrain->cells_outside_range());
    sum.finish(units);
    context.threads->blocks()->clear();  // no grid is allocated after this point
    return found;
}

}  // namespace d2b::pipeline
