#include "pipeline/report_run.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

#include "diagnose/search_warnings.hpp"
#include "diagnose/warnings.hpp"

namespace d2b::pipeline {

features::StackError measure_stack(const features::DrawnStack& stack, const FixedPoint& fixed,
                                   ElevationReader& reader) {
    features::StackError error;
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::attributes);
            return stack.error(band, fixed);
        },
        [&](const ElevationBand&, const features::StackError& of_band) { error.merge(of_band); });
    return error;
}

void report_stack_errors(const features::DrawnStack& stack, const FixedPoint& fixed, ElevationReader& reader,
                         RunReport& report) {
    const double metres = report.units.vertical_metres;
    report.stack_rmse_m = measure_stack(stack, fixed, reader).rms(fixed) * metres;
    if (report.cuts.empty())
        return;
    std::vector<features::StackError> errors(report.cuts.size());
    reader.for_each(
        [&](const ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::attributes);
            return stack.errors_by_level(band, fixed, static_cast<std::int32_t>(errors.size()));
        },
        [&](const ElevationBand&, const std::vector<features::StackError>& of_band) {
            for (std::size_t i = 0; i < errors.size(); ++i)
                errors[i].merge(of_band[i]);
        });
    for (std::size_t i = 0; i < errors.size(); ++i)
        report.cuts[i].rmse_m = errors[i].rms(fixed) * metres;
}

namespace {

constexpr double no_threshold = std::numeric_limits<double>::quiet_NaN();

/// @param from may be null
template <typename From>
void move_warnings(From* from, std::vector<std::string>& all) {
    if (from != nullptr)
        std::ranges::move(from->take_warnings(), std::back_inserter(all));
}

/// Names the first few corrections.
class NamedCorrections {
  public:
    void add(const Correction& correction) {
        constexpr std::int64_t most_named = 5;
        if (++count_ <= most_named)
            names_ += (names_.empty() ? "" : ", ") + correction.name + " ('" +
                      std::string(correction_names[static_cast<std::size_t>(correction.kind)]) + "')";
        else if (count_ == most_named + 1)
            names_ += " and others";
    }
    [[nodiscard]] std::int64_t count() const { return count_; }
    [[nodiscard]] std::string text() const {
        return std::to_string(count_) + (count_ == 1 ? " correction" : " corrections");
    }
    [[nodiscard]] const std::string& names() const { return names_; }

  private:
    std::int64_t count_ = 0;
    std::string names_;
};

}  // namespace

std::vector<std::string> take_warnings(const Sources& sources) {
    std::vector<std::string> all;
    for (DemSource* source : {&sources.dem, sources.terrain, sources.mask, sources.ndvi, sources.exclusion})
        move_warnings(source, all);
    move_warnings(sources.parcels, all);
    move_warnings(sources.footprints, all);
    move_warnings(sources.corrections, all);
    return all;
}

std::vector<std::string> take_warnings(const Sinks& sinks) {
    std::vector<std::string> all;
    move_warnings(&sinks.features, all);
    for (SurfaceSink* surface : sinks.surfaces)
        move_warnings(surface, all);
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy, sinks.elevations})
        move_warnings(raster, all);
    return all;
}

void pass_warnings(const Sources& sources, const Sinks& sinks, Context& context) {
    for (const std::string& text : take_warnings(sources))
        context.warn(text);
    for (const std::string& text : take_warnings(sinks))
        context.warn(text);
}

void report_levels(const contours::LevelPlan& plan, int levels, RunReport& report) {
    for (int level = 0; level < levels; ++level)
        report.levels.push_back(
            {level, plan.footprints && level > 0 ? no_threshold : plan.threshold(1, level), 0, 0});
}

std::size_t buildings_up_to(Label last, const contours::ContourList& contours) {
    std::size_t buildings = 0;
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (contours.head(i).key.level == 1 && contours.head(i).label <= last)
            ++buildings;
    return buildings;
}

void warn_of_result(const features::RunSetup& setup, const contours::LevelPlan& plan, std::size_t buildings,
                    const detect::SceneStatistics* scene, const DemSource* terrain, Context& context) {
    RunReport& report = context.report;
    diagnose::warn_unless_empty(diagnose::explain_empty_result(plan, buildings, setup.dem, report), context);
    if (scene == nullptr)
        return;
    if (setup.plan.asked.detect.is_split_by())
        report.parcels = detect::parcel_report(scene->parcels, setup.cell);
    report.sampling = detect::sampling_report(scene->sampling, report.units.vertical_metres);
    diagnose::warn_about_search(
        {setup.dem, setup.plan, report, *scene, setup.cell, setup.crs.kind() != Crs::Kind::none,
         terrain != nullptr ? terrain->share_outside() : 0, buildings},
        buildings > 0, context);
}

void report_corrections(const CorrectionSource* source, const std::set<std::size_t>& effective,
                        const std::string& dataset, Context& context) {
    if (source == nullptr)
        return;
    CorrectionReport report;
    NamedCorrections idle;
    NamedCorrections outside;
    const std::vector<Correction>& all = source->corrections();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const CorrectionKind kind = all[i].kind;
        ++(kind == CorrectionKind::building      ? report.building
           : kind == CorrectionKind::no_building ? report.no_building
                                                 : report.cut);
        if (all[i].is_outside())
            outside.add(all[i]);
        else if (!effective.contains(i))
            idle.add(all[i]);
    }
    report.outside = outside.count();
    report.without_effect = idle.count();
    report.unusable = source->unusable();
    if (idle.count() > 0)
        context.warn(idle.text() + " of '" + dataset + "' had no effect: " + idle.names() +
                     "; nothing is there that could be changed, or a cut does not go through or cuts off "
                     "too little.");
    if (outside.count() > 0)
        context.warn(outside.text() + " of '" + dataset + (outside.count() == 1 ? "' lies" : "' lie") +
                     " outside of the raster, or between the centres of its cells: " + outside.names() + ".");
    context.report.corrections = report;
}

void prepare_sinks(const Sinks& sinks, CommitList& commit, Context& context) {
    const StageClock clock(context.report, Stage::write);
    for (RasterSink* raster : {sinks.ground, sinks.height, sinks.canopy, sinks.elevations})
        if (raster != nullptr)
            raster->prepare(commit);
    for (SurfaceSink* surface : sinks.surfaces) {
        surface->take_report(context.report);
        surface->prepare(commit);
    }
    sinks.features.take_report(context.report);
    sinks.features.prepare(commit);
    context.check_stop();  // the run can no longer be cancelled
}

}  // namespace d2b::pipeline
