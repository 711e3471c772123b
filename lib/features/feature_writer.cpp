#include "features/feature_writer.hpp"

#include <algorithm>
#include <cmath>

#include "core/height_text.hpp"
#include "diagnose/warnings.hpp"
#include "features/reprojection.hpp"
#include "outline/arc_graph.hpp"

namespace d2b::features {
namespace {

constexpr std::int64_t max_invalid_named = 10;

std::string outcome(const FeaturePolygon& made) {
    if (made.parts.empty())
        return "it is not written";
    return made.status == OutlineStatus::repaired ? "a repaired one is written"
                                                  : "it is written as it was traced";
}

constexpr std::int64_t max_splits_named = 10;

std::string_view name_of(Reason reason) {
    return reason_names[static_cast<std::size_t>(reason)];
}

std::optional<Reason> reason_of(const FeaturePolygon& made) {
    if (made.status == OutlineStatus::kept_traced)
        return Reason::outline_kept_traced;
    if (made.status == OutlineStatus::repaired)
        return made.parts.empty() ? Reason::polygon_lost : Reason::polygon_repaired;
    return {};
}

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

/// Counts buildings that an option could improve, for the advice after the run.
void count_advisable(const BuildingRecord& record, RunReport& report) {
    constexpr double certain = 0.9;
    const auto& heights = record.heights_m;
    report.uncertain += record.confidence < certain ? 1 : 0;
    report.buildings_m2 += record.area_m2;
    if (has_several_roofs(heights[0], heights[p90_share])) {
        ++report.uneven;
        report.uneven_m2 += record.area_m2;
    }
}

}  // namespace

void InvalidWarnings::note(const std::string& kind, std::int64_t id, const FeaturePolygon& made) {
    if (made.invalid_reason.empty() || ++count_ > max_invalid_named)
        return;
    context_.warn(kind + " " + std::to_string(id) + " would not have been a valid polygon (" +
                  made.invalid_reason + "); " + outcome(made) + ".");
}

void InvalidWarnings::finish() {
    if (count_ > max_invalid_named)
        context_.warn(std::to_string(count_ - max_invalid_named) +
                      " more features would not have been valid polygons; -write_rejected writes them all, "
                      "with the reason.");
}

void ProjectionSplitWarnings::note(const std::string& kind, std::int64_t id, const FeaturePolygon& made) {
    if (!made.split_by_projection || ++count_ > max_splits_named)
        return;
    names_ += (names_.empty() ? "" : ", ") + kind + " " + std::to_string(id);
}

void ProjectionSplitWarnings::finish(const std::string& target, Context& context) const {
    if (count_ == 0)
        return;
    const RunReport& report = context.report;
    if (report.buildings + report.contours + report.doubtful == 0)
        throw split_by_projection_error(report.input, target);
    std::string text = (count_ == 1 ? "1 feature is" : std::to_string(count_) + " features are") +
                       " left out, because '" + target + "' splits or distorts " +
                       (count_ == 1 ? "it" : "them") + ": " + names_;
    if (count_ > max_splits_named)
        text += " and " + std::to_string(count_ - max_splits_named) + " more";
    context.warn(text + "; choose a -t_srs that suits the area.");
}

void RejectedLayer::note(std::size_t contour, LayerRole role, std::int64_t id, const FeaturePolygon& made) {
    const auto reason = reason_of(made);
    if (!reason)
        return;
    // A building and its contour of level 1 share one record.
    if (changed_.empty() || changed_.back().contour != contour ||
        changed_.back().record.reason != name_of(*reason)) {
        RejectedRecord record;
        record.reason = name_of(*reason);
        record.level = input_.contours.head(contour).key.level;
        changed_.push_back({contour, record});
    }
    RejectedRecord& record = changed_.back().record;
    (role == LayerRole::contours ? record.contour : record.building) = id;
}

RejectedLayer::Drawn RejectedLayer::draw(std::size_t i, PolygonMaker& maker) const {
    const auto rejected = input_.contours.rejected();
    Drawn drawn;
    if (i < rejected.size()) {
        drawn.record.reason = name_of(rejected[i].reason);
        drawn.record.level = rejected[i].key.level;
        drawn.made = maker.as_traced(input_.contours.fetch(rejected[i]));
    } else {
        const Changed& changed = changed_[i - rejected.size()];
        drawn.record = changed.record;
        drawn.made = maker.as_traced(contours::traced_polygon(input_.contours.fetch(changed.contour)));
    }
    drawn.record.area_m2 = drawn.made.measure.area_m2;
    drawn.record.perimeter_m = drawn.made.measure.perimeter_m;
    return drawn;
}

void RejectedLayer::write(std::vector<PolygonMaker>& makers, FeatureSink& sink, RoundedPolygons* rounded,
                          Context& context) const {
    std::int64_t id = sink.first_id();
    draw_in_order(
        *context.threads, input_.contours.rejected().size() + changed_.size(),
        [&](std::size_t i, std::size_t thread) { return draw(i, makers[thread]); },
        [&](std::size_t, Drawn&& drawn) {
            const StageClock clock(context.report, Stage::write);
            drawn.record.id = id++;
            if (drawn.made.parts.empty())
                return;
            if (rounded != nullptr)
                rounded->round(LayerRole::rejected, 0,
                               "feature " + std::to_string(drawn.record.id) + " of the rejected",
                               drawn.made.parts);
            sink.add(layer_, {field_values(rejected_attributes(), drawn.record), std::move(drawn.made.parts),
                              0, drawn.record});
        });
}

FeatureWriter::FeatureWriter(const FeatureInput& input, const RecordBuilder& records, FeatureSink& sink,
                             Context& context)
    : input_(input),
      sink_(sink),
      context_(context),
      cell_m_(input.setup.cell_m()),
      drawer_(input, records, context),
      invalid_(context) {
    if (drawer_.returns_cells())
        stack_.emplace(context.make_spool(), input.setup.dem.window);
}

void FeatureWriter::begin() {
    std::vector<LayerSpec> layers = input_.setup.layers.layers;
    if (CoordinateRounding rounding = sink_.rounding(); rounding.to != CoordinateRounding::To::nothing)
        rounded_.emplace(std::move(rounding), !input_.setup.plan.asked.outline.disjoint,
                         context_.threads->stop());
    if (indices().rejected)
        rejected_.emplace(input_, *indices().rejected);
    if (indices().roofs)
        roofs_.emplace(*indices().roofs, input_.roofs != nullptr && input_.roofs->are_level(), sink_,
                       context_);
    give_styles(layers, input_, context_.report.units.vertical_metres);
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(layers, make_provenance(input_.setup, context_.report));
    next_id_ = next_building_ = next_face_ = sink_.first_id();
}

void FeatureWriter::round(LayerRole layer, std::int64_t id, std::int64_t parent_id, FeaturePolygon& made) {
    const char* const what = layer == LayerRole::buildings ? "building " : "contour ";
    if (!rounded_ || !rounded_->round(layer, parent_id, what + std::to_string(id), made.parts))
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

BuildingIds FeatureWriter::assign_building(DrawnContour& drawn) {
    BuildingIds ids{next_building_++, 0, next_face_};
    BuildingRecord& record = drawn.building_record;
    record.id = ids.id;
    // Ids ascend, so the first part that is seen has the lowest one.
    if (std::ranges::binary_search(input_.divided, record.whole))
        ids.whole = first_parts_.try_emplace(record.whole, ids.id).first->second;
    record.whole = ids.whole;
    next_face_ = number_faces(drawn.faces, record, next_face_);
    return ids;
}

void FeatureWriter::assign_ids(AssignedIds& numbers, DrawnContour& drawn) {
    drawn.record.id = next_id_++;
    if (drawn.record.level == 1)
        numbers.buildings.push_back(assign_building(drawn));
    drawn.record.building_id =
        drawn.building_index < 0 ? 0 : numbers.buildings[static_cast<std::size_t>(drawn.building_index)].id;
    drawn.record.parent_id =
        drawn.parent < 0 ? 0 : numbers.written[static_cast<std::size_t>(drawn.parent - numbers.before)];
}

void FeatureWriter::count(const DrawnContour& drawn) {
    if (drawn.is_low_confidence || input_.setup.plan.asked.write.has_footprints())
        return;  // footprints have contours of their own
    LevelReport& level = context_.report.levels[static_cast<std::size_t>(drawn.record.level)];
    ++level.contours;
    level.points += drawn.record.points;
    if (drawn.record.level > 0)
        rmse_.add(drawn.own, input_.fixed);
    if (drawn.record.level > 0 && input_.with_cuts)
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

void FeatureWriter::measure_building(DrawnContour& drawn) {
    BuildingRecord& record = drawn.building_record;
    const FeaturePolygon& made = *drawn.building;
    take_measures(made, record);
    record.deviation_m = made.deviation / std::sqrt(input_.setup.georeference.cell_area()) * cell_m_;
    record.area_change = made.area_change;
    record.storey_m = input_.setup.plan.asked.write.storey_height;
    if (input_.parcels != nullptr)
        record.parcel = input_.parcels->name(record.parcel_number);
}

void FeatureWriter::add_building(std::size_t contour, DrawnContour& drawn) {
    FeaturePolygon& made = *drawn.building;
    const bool doubtful = drawn.is_low_confidence;
    measure_building(drawn);
    if (input_.building_records != nullptr && !doubtful && !made.parts.empty())
        input_.building_records->put(drawn.building_index, drawn.building_record);
    if (!indices().building_layer(doubtful))
        return;
    invalid_.note("Building", drawn.building_record.id, made);
    split_warnings_.note("building", drawn.building_record.id, made);
    if (rejected_)
        rejected_->note(contour, LayerRole::buildings, drawn.building_record.id, made);
    if (made.parts.empty())
        return;
    round(LayerRole::buildings, drawn.building_record.id, 0, made);
    drawn.building_record.status = made.status;
    ++(doubtful ? context_.report.doubtful : context_.report.buildings);
    if (!doubtful)
        add_length(made, context_.report.building_outlines);
    if (!indices().contours)
        context_.report.vertices += vertices_of(made.parts);
    BuildingRecord& record = drawn.building_record;
    if (!doubtful) {
        count_advisable(record, context_.report);
        implausible_heights_.note(record, drawn.record);
    }
    write(*indices().building_layer(doubtful), building_attributes(input_.setup.plan.asked), record,
          std::move(made), drawn.record.threshold);
    if (roofs_)
        roofs_->add(std::move(drawn.faces));
}

bool FeatureWriter::add_contour(std::size_t contour, DrawnContour& drawn) {
    invalid_.note("Contour", drawn.record.id, *drawn.contour);
    split_warnings_.note("contour", drawn.record.id, *drawn.contour);
    // A contour that is fully covered by its children has no band of its own.
    if (rejected_)
        rejected_->note(contour, LayerRole::contours, drawn.record.id, *drawn.contour);
    if (drawn.contour->parts.empty())
        return false;
    round(LayerRole::contours, drawn.record.id, drawn.record.parent_id, *drawn.contour);
    ++context_.report.contours;
    add_length(*drawn.contour, context_.report.contour_outlines);
    context_.report.vertices += vertices_of(drawn.contour->parts);
    take_measures(*drawn.contour, drawn.record);
    write(*indices().contours, contour_attributes(), drawn.record, std::move(*drawn.contour),
          drawn.record.threshold);
    return true;
}

std::int64_t FeatureWriter::add_with_ids(std::size_t contour, DrawnContour&& drawn) {
    count(drawn);
    if (stack_)
        add_to_stack(drawn, indices(), *stack_);
    if (drawn.building)
        add_building(contour, drawn);
    const bool written = drawn.contour && add_contour(contour, drawn);
    return written ? drawn.record.id : drawn.record.parent_id;
}

void FeatureWriter::warn_of_traced() {
    const RunPlan& plan = input_.setup.plan;
    if (plan.walls == Walls::off && !(plan.asked.outline.simplify > 0))
        return;  // traced outlines were asked for
    const RunReport& report = context_.report;
    // The lines at which parcels cut houses need not be walls.
    const bool walls = plan.walls != Walls::off && !plan.asked.detect.is_split_by();
    diagnose::warn_unless_empty(
        diagnose::traced_warning(report.building_outlines, report.contour_outlines, walls, cell_m_),
        context_);
}

std::optional<DrawnStack> FeatureWriter::finish() {
    invalid_.finish();
    for (const std::string& warning : implausible_heights_.warnings())
        context_.warn(warning);
    warn_of_traced();
    split_warnings_.finish(display_name(input_.setup.target, input_.setup.plan.asked.outline.target_crs),
                           context_);
    if (roofs_)
        roofs_->finish();
    if (rejected_)
        rejected_->write(drawer_.makers(), sink_, rounded_ ? &*rounded_ : nullptr, context_);
    if (rounded_)
        rounded_->finish();
    for (PolygonMaker& maker : drawer_.makers())
        context_.report.merge(maker.tally());
    const double metres = context_.report.units.vertical_metres;
    context_.report.stack_rmse_m = rmse_.value() * metres;
    for (const StackRmse& rmse : cut_rmses_)
        context_.report.cuts.push_back(
            {static_cast<std::int32_t>(context_.report.cuts.size()) + 1, rmse.value() * metres});
    return std::move(stack_);
}

}  // namespace d2b::features
