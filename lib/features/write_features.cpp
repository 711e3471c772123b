#include "features/write_features.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "attributes/attribute_table.hpp"
#include "core/stage_clock.hpp"
#include "diagnose/odd_heights.hpp"
#include "diagnose/traced_doubt.hpp"
#include "diagnose/words.hpp"
#include "features/invalid_warnings.hpp"
#include "features/layer_specs.hpp"
#include "features/layer_styles.hpp"
#include "features/polygon_maker.hpp"
#include "features/rejected_layer.hpp"
#include "features/target_frame.hpp"
#include "features/torn_warnings.hpp"

namespace d2b {
namespace {

/// What is known of a contour, and what is drawn of it: nothing where its layer was not asked for.
struct Drawn {
    ContourRecord record;
    PointStats own;
    BuildingRecord building_record;  ///< of level 1 alone
    std::optional<FeaturePolygon> building;
    std::optional<FeaturePolygon> contour;
};

/// Draws on all threads, and hands features to the layers that were asked for.
class FeatureWriter {
  public:
    FeatureWriter(const FeatureInput& input, RecordMaker& records, FeatureSink& sink, Context& context);

    void begin();
    /// @param thread that this runs on
    [[nodiscard]] Drawn draw(std::size_t contour, std::size_t thread);
    void add(std::size_t contour, Drawn&& drawn);
    void finish();

  private:
    [[nodiscard]] std::optional<std::size_t> building_layer(std::size_t contour) const {
        return is_doubtful(contour) ? doubtful_layer_ : buildings_layer_;
    }
    [[nodiscard]] bool is_doubtful(std::size_t contour) const {
        return input_.contours.head(contour).label > input_.buildings;
    }
    void count(std::size_t contour, const Drawn& drawn);
    void add_building(std::size_t contour, Drawn& drawn);
    /// @return whether it is in its layer
    bool add_contour(std::size_t contour, Drawn& drawn);
    void warn_of_traced();
    template <typename Record>
    void write(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
               FeaturePolygon&& made, double threshold);

    const FeatureInput& input_;
    RecordMaker& records_;
    FeatureSink& sink_;
    Context& context_;
    Outliner outliner_;
    ContourChildren children_;
    StackRmse rmse_;                        // of the contours as they were traced
    std::optional<DrawnStack> stack_;       // where they are drawn otherwise
    std::vector<PolygonMaker> makers_;      // one a thread
    std::vector<std::int64_t> written_id_;  // what stands on a contour that is not written stands on this
    std::optional<std::size_t> buildings_layer_;
    std::optional<std::size_t> contours_layer_;
    std::optional<std::size_t> doubtful_layer_;
    std::optional<RejectedLayer> rejected_;
    InvalidWarnings invalid_;
    OddHeights odd_heights_;
    TornWarnings torn_;
};

/// By what is known of the whole of a polygon.
void add_length(const FeaturePolygon& made, OutlineLength& sum) {
    const double length = made.measure.perimeter_m;
    const double traced = made.status == OutlineStatus::traced ? length : made.kept_traced * length;
    (made.status == OutlineStatus::simplified ? sum.simplified : sum.fitted) += length - traced;
    sum.traced += traced;
}

/// Whether the stack is measured as it is drawn. The thesis's, which is drawn as it was traced, may be of a
/// raster of any size, which would have to be read once more.
bool measures_drawn(const RunPlan& plan) {
    return plan.detects_buildings() && plan.trace == TraceMode::cells && plan.layers != Layers::buildings;
}

Outliner timed_outliner(const FeatureInput& input, Context& context) {
    const StageClock clock(context.report, Stage::outline);
    const RunPlan& plan = input.plan;
    const OutlineRules rules{plan.walls, plan.wall_tolerance(input.cell_size_m), plan.asked.outline.simplify,
                             input.target_crs.kind() != Crs::Kind::none};
    return make_outliner(input.contours, rules, input.georeference, input.crs, input.window, context);
}

FeatureWriter::FeatureWriter(const FeatureInput& input, RecordMaker& records, FeatureSink& sink,
                             Context& context)
    : input_(input),
      records_(records),
      sink_(sink),
      context_(context),
      outliner_(timed_outliner(input, context)),
      children_(input.plan.asked.outline.disjoint ? ContourChildren(input.contours) : ContourChildren()),
      written_id_(input.contours.size(), 0),
      invalid_(context) {
    PolygonTerms terms{input.plan.asked.outline,
                       input.georeference,
                       input.crs,
                       input.target_crs,
                       input.window,
                       outliner_,
                       children_,
                       context.threads->stop()};
    if (measures_drawn(input.plan)) {
        stack_.emplace(context.make_spool(), input.window);
        terms.with_cells = true;
    }
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        makers_.emplace_back(terms);
}

void FeatureWriter::begin() {
    auto [layers, places] = layer_specs(
        input_.plan,
        {context_.report.input, input_.vertical_unit, input_.target_crs.kind() != Crs::Kind::none}, sink_);
    buildings_layer_ = places.buildings;
    contours_layer_ = places.contours;
    doubtful_layer_ = places.doubtful;
    if (places.rejected)
        rejected_.emplace(input_, *places.rejected);
    give_styles(layers, places, input_, context_.report.units.vertical_metres);
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(layers, input_.provenance);
    records_.number_from(sink_.first_id());
}

Drawn FeatureWriter::draw(std::size_t contour, std::size_t thread) {
    PolygonMaker& maker = makers_[thread];
    Drawn drawn;
    const bool is_building = input_.contours.head(contour).key.level == 1;
    {
        const StageClock clock(maker.tally(), Stage::attributes);
        const StoredContours::Stored stored = input_.contours.fetch_stored(contour);
        drawn.record = records_.contour(contour, stored.contour);
        drawn.own = stored.contour.own;
        if (is_building)
            drawn.building_record = records_.building(contour, stored.contour, drawn.record, stored.roof);
    }
    if (is_building && building_layer(contour))
        drawn.building = maker.footprint(contour);
    if (!contours_layer_ || is_doubtful(contour))
        return drawn;
    if (input_.plan.asked.outline.disjoint)
        drawn.contour = maker.tier(contour);
    else
        drawn.contour =
            drawn.building && !outliner_.has_own_footprints() ? *drawn.building : maker.whole(contour);
    return drawn;
}

template <typename Record>
void FeatureWriter::write(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
                          FeaturePolygon&& made, double threshold) {
    record.area_m2 = made.measure.area_m2;
    record.perimeter_m = made.measure.perimeter_m;
    record.status = made.status;
    const StageClock clock(context_.report, Stage::write);
    sink_.add(layer, {field_values(attributes, record), std::move(made.parts), threshold, record});
}

void FeatureWriter::count(std::size_t contour, const Drawn& drawn) {
    if (is_doubtful(contour))
        return;
    LevelReport& level = context_.report.levels[static_cast<std::size_t>(drawn.record.level)];
    ++level.contours;
    level.points += drawn.record.points;
    if (drawn.record.level > 0)
        rmse_.add(drawn.own, input_.fixed);
}

void FeatureWriter::add_building(std::size_t contour, Drawn& drawn) {
    FeaturePolygon& made = *drawn.building;
    invalid_.note("Building", drawn.building_record.id, made);
    torn_.note("building", drawn.building_record.id, made);
    if (rejected_)
        rejected_->note(contour, LayerRole::buildings, drawn.building_record.id, made);
    if (made.parts.empty())
        return;
    ++(is_doubtful(contour) ? context_.report.doubtful : context_.report.buildings);
    if (!is_doubtful(contour))
        add_length(made, context_.report.building_outlines);
    if (!contours_layer_)
        context_.report.vertices += vertices_of(made.parts);
    if (stack_ && !is_doubtful(contour))
        stack_->add_building(made.cells);
    BuildingRecord& record = drawn.building_record;
    record.deviation_m = made.deviation / std::sqrt(input_.georeference.cell_area()) * input_.cell_size_m;
    record.area_change = made.area_change;
    if (input_.plan.detects_buildings() && !is_doubtful(contour))
        odd_heights_.note(record, drawn.record);
    write(*building_layer(contour), building_attributes(), record, std::move(made), drawn.record.threshold);
}

bool FeatureWriter::add_contour(std::size_t contour, Drawn& drawn) {
    invalid_.note("Contour", drawn.record.id, *drawn.contour);
    torn_.note("contour", drawn.record.id, *drawn.contour);
    // A contour that its children cover whole has no band of its own.
    if (rejected_)
        rejected_->note(contour, LayerRole::contours, drawn.record.id, *drawn.contour);
    if (drawn.contour->parts.empty())
        return false;
    ++context_.report.contours;
    add_length(*drawn.contour, context_.report.contour_outlines);
    if (stack_ && !buildings_layer_ && drawn.record.level == 1)
        stack_->add_building(drawn.contour->cells);
    if (stack_)
        stack_->add_contour(drawn.contour->cells, drawn.record.tier_z);
    context_.report.vertices += vertices_of(drawn.contour->parts);
    write(*contours_layer_, contour_attributes(), drawn.record, std::move(*drawn.contour),
          drawn.record.threshold);
    return true;
}

void FeatureWriter::add(std::size_t contour, Drawn&& drawn) {
    count(contour, drawn);
    const std::int64_t parent = input_.contours.head(contour).parent;
    drawn.record.parent_id = parent < 0 ? 0 : written_id_[static_cast<std::size_t>(parent)];
    if (drawn.building)
        add_building(contour, drawn);
    const bool written = drawn.contour && add_contour(contour, drawn);
    written_id_[contour] = written ? drawn.record.id : drawn.record.parent_id;
}

void FeatureWriter::warn_of_traced() {
    const RunPlan& plan = input_.plan;
    if (plan.walls == Walls::off && !(plan.asked.outline.simplify > 0))
        return;  // as it was asked for
    const RunReport& report = context_.report;
    if (const std::string traced =
            traced_doubt(report.building_outlines, report.contour_outlines, input_.cell_size_m);
        !traced.empty())
        context_.warn(as_sentence(traced));
}

void FeatureWriter::finish() {
    invalid_.finish();
    for (const std::string& warning : odd_heights_.warnings())
        context_.warn(warning);
    warn_of_traced();
    torn_.finish(spoken_name(input_.target_crs, input_.plan.asked.outline.target_crs), context_);
    if (rejected_)
        rejected_->write(makers_, sink_, context_);
    for (PolygonMaker& maker : makers_)
        context_.report.merge(maker.tally());
    const double rmse = stack_ ? input_.compare(*stack_).rms(input_.fixed) : rmse_.value();
    context_.report.stack_rmse_m = rmse * context_.report.units.vertical_metres;
}

}  // namespace

void write_features(const FeatureInput& input, RecordMaker& records, FeatureSink& sink, Context& context) {
    constexpr std::size_t piece = 64;  // contours that a thread draws at a time
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    const std::size_t count = input.contours.size();
    context.threads->in_order(
        (count + piece - 1) / piece,
        [&](std::size_t k, std::size_t thread) {
            std::vector<Drawn> drawn;
            for (std::size_t i = k * piece; i < std::min(count, (k + 1) * piece); ++i)
                drawn.push_back(writer.draw(i, thread));
            return drawn;
        },
        [&](std::size_t k, std::vector<Drawn> drawn) {
            for (std::size_t i = 0; i < drawn.size(); ++i)
                writer.add(k * piece + i, std::move(drawn[i]));
            context.progress(static_cast<double>(k * piece) / static_cast<double>(count));
        });
    writer.finish();
}

}  // namespace d2b
