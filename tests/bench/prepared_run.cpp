#include "prepared_run.hpp"

#include <algorithm>
#include <utility>

#include "contours/building_levels.hpp"
#include "contours/level_plan.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"
#include "detect/detection.hpp"
#include "elevations/elevation_reader.hpp"
#include "features/reprojection.hpp"
#include "support/memory_io.hpp"

namespace d2b::bench {

namespace {

RunPlan plan_of(const std::string& dem, Preset preset) {
    Options options;
    options.preset = preset;
    options.read.source = dem;
    return make_run_plan(options, Layers::both);
}

class ContourVector : public ContourSink {
  public:
    explicit ContourVector(std::vector<FinishedContour>& list) : contours_(list) {}
    std::int64_t take(FinishedContour&& finished) override {
        contours_.push_back(std::move(finished));
        return static_cast<std::int64_t>(contours_.size()) - 1;
    }

  private:
    std::vector<FinishedContour>& contours_;
};

}  // namespace

PreparedRun::PreparedRun(const std::string& dem, Preset preset)
    : decided(plan_of(dem, preset)),
      source(open_dem(decided.asked.read)),
      crs(source->info().crs_wkt),
      georeference(source->info().transform, decided.trace),
      area(make_square_area(georeference, crs,
                            lattice_frame({0, 0, source->info().rows, source->info().cols}, decided.trace))),
      cell(cell_steps(source->info().window, georeference, crs)) {
    context.threads = std::make_unique<Executor>(2);
    read();
    find();
    make_levels();
    ContourVector list(traced);
    trace(list);
    contours = filter(std::vector<FinishedContour>(traced));
}

std::int64_t PreparedRun::points() const {
    return std::int64_t{source->info().window.rows} * source->info().window.cols;
}

void PreparedRun::read() {
    ElevationReader reader(*source, context);
    reader.for_each_with_halo(
        rows_above(decided.trace), [](ElevationBand halo, const ElevationBand&, Tally&) { return halo; },
        [this](const ElevationBand& band, ElevationBand halo) {
            bands.emplace_back().elevations = std::make_shared<ElevationBand>(band);
            above.emplace_back().elevations = std::make_shared<ElevationBand>(std::move(halo));
        });
}

MetreGrid PreparedRun::surface() const {
    MetreGrid grid(source->info().window.rows, source->info().window.cols);
    for (const Rows& band : bands)
        std::transform(band.elevations->elevations.begin(), band.elevations->elevations.end(),
                       grid.row(band.shape().first_row).data(),
                       [](double z) { return static_cast<float>(z); });
    return grid;
}

void PreparedRun::find() {
    if (decided.detects_buildings()) {
        test::MemorySink nothing;
        ElevationReader reader(*source, context);
        found = find_buildings(
            {decided, {*source}, {nothing}, reader, {source->info().window, cell, 1}, context});
    }
    for (std::vector<Rows>* all : {&bands, &above})
        for (Rows& rows : *all)
            rows.labels = found.footprints.empty() ? detect_one_label(*rows.elevations, context)
                                                   : found.band(rows.shape());
}

void PreparedRun::make_levels() {
    ElevationStatistics statistics;
    for (const Rows& band : bands)
        statistics.add(band.elevations->elevations);
    plan = plan_global_levels(statistics, decided.asked.levels, decided.levels, context);
    if (!found.footprints.empty()) {
        constexpr double metres = 1;
        BuildingStatistics buildings(found.count(), statistics.fixed_point(),
                                     decided.levels == LevelSource::natural ? metres : 0);
        for (const Rows& band : bands)
            buildings.add(constant_runs(*band.elevations, band.labels));
        plan =
            plan_building_levels(buildings, found.ground, plan, decided.asked.levels, decided.levels, metres);
    }
    frame = {source->info().window, plan.level_count(), statistics.fixed_point(), statistics.range()};
    for (std::vector<Rows>* all : {&bands, &above})
        for (Rows& rows : *all)
            rows.levels = quantise<std::uint8_t>(*rows.elevations, rows.labels, plan);
}

void PreparedRun::trace(ContourSink& sink) const {
    Tracer tracer(frame, decided.trace, sink);
    for (std::size_t i = 0; i < bands.size(); ++i)
        tracer.trace(split_into_runs(frame, decided.trace, above[i], bands[i]));
}

std::unique_ptr<StoredContours> PreparedRun::filter(std::vector<FinishedContour>&& finished) {
    const NoiseRules noise{decided.asked.filter.noise_factor, decided.contour_m2,
                           decided.detects_buildings()};
    ContourArchive store({noise, area, frame.range, frame.fixed, found.footprints.empty()},
                         std::make_unique<MemorySpool>(), context);
    // The store's names differ from the list's because it drops contours that the list keeps.
    std::vector<std::int64_t> names;
    for (FinishedContour& one : finished) {
        std::erase_if(one.children, [&](std::int64_t i) { return names[static_cast<std::size_t>(i)] < 0; });
        for (std::int64_t& name : one.children)
            name = names[static_cast<std::size_t>(name)];
        names.push_back(store.take(std::move(one)));
    }
    return store.finish();
}

}  // namespace d2b::bench
