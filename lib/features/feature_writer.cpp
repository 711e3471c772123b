#include "features/feature_writer.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/stage_clock.hpp"
#include "diagnose/traced_doubt.hpp"
#include "diagnose/warn_of.hpp"
#include "features/layer_styles.hpp"
#include "features/target_frame.hpp"

namespace d2b {
namespace {

/// Splits the perimeter by shares, which are known only for the polygon as a whole.
void add_length(const FeaturePolygon& made, OutlineLength& sum) {
    const double length = made.measure.perimeter_m;
    const double traced = made.status == OutlineStatus::traced ? length : made.kept_traced * length;
    const double simplified = std::min(made.simplified * length, length - traced);
    sum.fitted += length - traced - simplified;
    sum.simplified += simplified;
    sum.traced += traced;
}

template <typename Record>
void take_measures(const FeaturePolygon& made, Record& record) {
    record.area_m2 = made.measure.area_m2;
    record.perimeter_m = made.measure.perimeter_m;
    record.status = made.status;
}

}  // namespace

FeatureWriter::FeatureWriter(const FeatureInput& input, const RecordMaker& records, FeatureSink& sink,
                             Context& context)
    : input_(input), sink_(sink), context_(context), drawer_(input, records, context), invalid_(context) {
    if (drawer_.gives_cells())
        stack_.emplace(context.make_spool(), input.window);
}

void FeatureWriter::begin() {
    std::vector<LayerSpec> layers = input_.layers.layers;
    if (CoordinateRounding rounding = sink_.rounding(); rounding.to != CoordinateRounding::To::nothing)
        rounded_.emplace(std::move(rounding), !input_.plan.asked.outline.disjoint, context_.threads->stop());
    if (places().rejected)
        rejected_.emplace(input_, *places().rejected);
    give_styles(layers, input_, context_.report.units.vertical_metres);
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(layers, input_.provenance);
    next_id_ = next_building_ = sink_.first_id();
}

void FeatureWriter::round(RoundedPolygons::Layer layer, std::int64_t id, std::int64_t parent_id,
                          FeaturePolygon& made) {
    const char* const what = layer == RoundedPolygons::Layer::buildings ? "building " : "contour ";
    if (!rounded_ || !rounded_->round(layer, id, parent_id, what + std::to_string(id), made.parts))
        return;
    made.status = OutlineStatus::repaired;
    context_.report.count(Reason::polygon_repaired);
}

template <typename Record>
void FeatureWriter::write(std::size_t layer, std::span<const Attribute<Record>> attributes,
                          const Record& record, FeaturePolygon&& made, double threshold) {
    const StageClock clock(context_.report, Stage::write);
    sink_.add(layer, {field_values(attributes, record), std::move(made.parts), threshold, record});
}

void FeatureWriter::number(GivenNumbers& numbers, DrawnContour& drawn) {
    drawn.record.id = next_id_++;
    if (drawn.record.level == 1)
        numbers.buildings.push_back(next_building_++);
    drawn.record.building_id =
        drawn.building_place < 0 ? 0 : numbers.buildings[static_cast<std::size_t>(drawn.building_place)];
    drawn.building_record.id = drawn.record.building_id;
    drawn.record.parent_id =
        drawn.parent < 0 ? 0 : numbers.written[static_cast<std::size_t>(drawn.parent - numbers.before)];
}

void FeatureWriter::count(const DrawnContour& drawn) {
    if (drawn.is_doubtful)
        return;
    LevelReport& level = context_.report.levels[static_cast<std::size_t>(drawn.record.level)];
    ++level.contours;
    level.points += drawn.record.points;
    if (drawn.record.level > 0)
        rmse_.add(drawn.own, input_.fixed);
    if (drawn.record.level > 0 && input_.compare_cuts)
        add_to_cuts(drawn);
}

/// Requires contours in ascending order of levels.
void FeatureWriter::add_to_cuts(const DrawnContour& drawn) {
    const auto level = static_cast<std::size_t>(drawn.record.level);
    while (cut_rmses_.size() < level)
        cut_rmses_.push_back(rmse_below_);
    cut_rmses_[level - 1].add(drawn.whole, input_.fixed);
    rmse_below_.add(drawn.own, input_.fixed);
}

void FeatureWriter::measure_cuts() {
    const double metres = context_.report.units.vertical_metres;
    const auto levels = static_cast<std::int32_t>(cut_rmses_.size());
    std::vector<double> rmses;
    if (stack_)
        for (const StackError& error : input_.compare_cuts(*stack_, levels))
            rmses.push_back(error.rms(input_.fixed));
    else
        for (const StackRmse& rmse : cut_rmses_)
            rmses.push_back(rmse.value());
    for (const double rmse : rmses)
        context_.report.cuts.push_back(
            {static_cast<std::int32_t>(context_.report.cuts.size()) + 1, rmse * metres});
}

void FeatureWriter::measure_building(DrawnContour& drawn) {
    BuildingRecord& record = drawn.building_record;
    const FeaturePolygon& made = *drawn.building;
    take_measures(made, record);
    record.deviation_m = made.deviation / std::sqrt(input_.georeference.cell_area()) * input_.cell_size_m;
    record.area_change = made.area_change;
    if (input_.parcels != nullptr)
        record.parcel = input_.parcels->name(record.parcel_number);
}

void FeatureWriter::add_building(std::size_t contour, DrawnContour& drawn) {
    FeaturePolygon& made = *drawn.building;
    const bool doubtful = drawn.is_doubtful;
    measure_building(drawn);
    if (input_.kept != nullptr && !doubtful && !made.parts.empty())
        input_.kept->put(drawn.building_place, drawn.building_record);
    if (!places().of_building(doubtful))
        return;
    invalid_.note("Building", drawn.building_record.id, made);
    torn_.note("building", drawn.building_record.id, made);
    if (rejected_)
        rejected_->note(contour, LayerRole::buildings, drawn.building_record.id, made);
    if (made.parts.empty())
        return;
    round(RoundedPolygons::Layer::buildings, drawn.building_record.id, 0, made);
    drawn.building_record.status = made.status;
    ++(doubtful ? context_.report.doubtful : context_.report.buildings);
    if (!doubtful)
        add_length(made, context_.report.building_outlines);
    if (!places().contours)
        context_.report.vertices += vertices_of(made.parts);
    BuildingRecord& record = drawn.building_record;
    if (!doubtful)
        odd_heights_.note(record, drawn.record);
    write(*places().of_building(doubtful), building_attributes(input_.plan.asked.detect.is_split_by()),
          record, std::move(made), drawn.record.threshold);
}

bool FeatureWriter::add_contour(std::size_t contour, DrawnContour& drawn) {
    invalid_.note("Contour", drawn.record.id, *drawn.contour);
    torn_.note("contour", drawn.record.id, *drawn.contour);
    // A contour that is fully covered by its children has no band of its own.
    if (rejected_)
        rejected_->note(contour, LayerRole::contours, drawn.record.id, *drawn.contour);
    if (drawn.contour->parts.empty())
        return false;
    round(RoundedPolygons::Layer::contours, drawn.record.id, drawn.record.parent_id, *drawn.contour);
    ++context_.report.contours;
    add_length(*drawn.contour, context_.report.contour_outlines);
    context_.report.vertices += vertices_of(drawn.contour->parts);
    take_measures(*drawn.contour, drawn.record);
    write(*places().contours, contour_attributes(), drawn.record, std::move(*drawn.contour),
          drawn.record.threshold);
    return true;
}

void FeatureWriter::add_numbered(GivenNumbers& numbers, std::size_t contour, DrawnContour&& drawn) {
    count(drawn);
    if (stack_)
        add_to_stack(drawn, places(), *stack_);
    if (drawn.building)
        add_building(contour, drawn);
    const bool written = drawn.contour && add_contour(contour, drawn);
    numbers.written.push_back(written ? drawn.record.id : drawn.record.parent_id);
}

void FeatureWriter::warn_of_traced() {
    const RunPlan& plan = input_.plan;
    if (plan.walls == Walls::off && !(plan.asked.outline.simplify > 0))
        return;  // traced outlines were asked for
    const RunReport& report = context_.report;
    warn_of(traced_doubt(report.building_outlines, report.contour_outlines, input_.cell_size_m), context_);
}

void FeatureWriter::finish() {
    invalid_.finish();
    for (const std::string& warning : odd_heights_.warnings())
        context_.warn(warning);
    warn_of_traced();
    torn_.finish(spoken_name(input_.target_crs, input_.plan.asked.outline.target_crs), context_);
    if (rejected_)
        rejected_->write(drawer_.makers(), sink_, rounded_ ? &*rounded_ : nullptr, context_);
    if (rounded_)
        rounded_->finish();
    for (PolygonMaker& maker : drawer_.makers())
        context_.report.merge(maker.tally());
    const double rmse = stack_ ? input_.compare(*stack_).rms(input_.fixed) : rmse_.value();
    context_.report.stack_rmse_m = rmse * context_.report.units.vertical_metres;
    if (input_.compare_cuts)
        measure_cuts();
}

}  // namespace d2b
