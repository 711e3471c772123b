#include "features/emit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "attributes/attribute_table.hpp"
#include "core/stage_clock.hpp"
#include "diagnose/traced_doubt.hpp"
#include "diagnose/words.hpp"
#include "features/layer_specs.hpp"
#include "features/layer_styles.hpp"
#include "features/odd_heights.hpp"
#include "features/placer.hpp"
#include "features/rejected_layer.hpp"
#include "features/target_frame.hpp"
#include "features/torn_features.hpp"
#include "features/troubles.hpp"
#include "options/preset.hpp"

namespace d2b {
namespace {

/// What is known of a contour, and what is drawn of it: nothing where its layer was not asked for.
struct Drawn {
    ContourRecord record;
    PointStats own;
    BuildingRecord building_record;  ///< of level 1 alone
    std::optional<Placed> building;
    std::optional<Placed> contour;
};

/// Draws on all threads, and hands features to the layers that were asked for.
class Emitter {
  public:
    Emitter(const Emission& emission, RecordMaker& records, FeatureSink& sink, Context& context);

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
        return emission_.contours.head(contour).label > emission_.buildings;
    }
    void count(std::size_t contour, const Drawn& drawn);
    void add_building(std::size_t contour, Drawn& drawn);
    /// @return whether it is in its layer
    bool add_contour(std::size_t contour, Drawn& drawn);
    void measure(const Placed& placed);
    template <typename Record>
    void write(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
               Placed&& placed, double threshold);

    const Emission& emission_;
    RecordMaker& records_;
    FeatureSink& sink_;
    Context& context_;
    Outliner outliner_;
    Children children_;
    StackRmse rmse_;
    std::vector<Placer> placers_;           // one a thread
    std::vector<std::int64_t> written_id_;  // what stands on a contour that is not written stands on this
    std::optional<std::size_t> buildings_layer_;
    std::optional<std::size_t> contours_layer_;
    std::optional<std::size_t> doubtful_layer_;
    std::optional<RejectedLayer> rejected_;
    Troubles troubles_;
    OddHeights odd_heights_;
    TornFeatures torn_;
};

Outliner timed_outliner(const Emission& emission, Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return make_outliner(emission.contours, emission.options.outline, emission.georeference, emission.crs,
                         emission.window, context);
}

Emitter::Emitter(const Emission& emission, RecordMaker& records, FeatureSink& sink, Context& context)
    : emission_(emission),
      records_(records),
      sink_(sink),
      context_(context),
      outliner_(timed_outliner(emission, context)),
      children_(emission.options.outline.disjoint ? Children(emission.contours) : Children()),
      written_id_(emission.contours.size(), 0),
      troubles_(context),
      odd_heights_(context) {
    const Placement placement{emission.options.outline,
                              emission.georeference,
                              emission.crs,
                              emission.target_crs,
                              emission.window,
                              outliner_,
                              children_,
                              context.threads->stop()};
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        placers_.emplace_back(placement);
}

void Emitter::begin() {
    auto [layers, places] = layer_specs(
        emission_.options,
        {context_.report.input, emission_.vertical_unit, emission_.target_crs.kind() != Crs::Kind::none},
        sink_);
    buildings_layer_ = places.buildings;
    contours_layer_ = places.contours;
    doubtful_layer_ = places.doubtful;
    if (places.rejected)
        rejected_.emplace(emission_, *places.rejected);
    give_styles(layers, places, emission_, context_.report.units.vertical_metres);
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(layers, emission_.provenance);
    records_.number_from(sink_.first_id());
}

Drawn Emitter::draw(std::size_t contour, std::size_t thread) {
    Placer& placer = placers_[thread];
    Drawn drawn;
    const bool is_building = emission_.contours.head(contour).key.level == 1;
    {
        const StageClock clock(placer.tally(), Stage::attributes);
        const StoredContours::Stored stored = emission_.contours.fetch_stored(contour);
        drawn.record = records_.contour(contour, stored.contour);
        drawn.own = stored.contour.own;
        if (is_building)
            drawn.building_record = records_.building(contour, stored.contour, drawn.record, stored.roof);
    }
    if (is_building && building_layer(contour))
        drawn.building = placer.footprint(contour);
    if (!contours_layer_ || is_doubtful(contour))
        return drawn;
    if (emission_.options.outline.disjoint)
        drawn.contour = placer.tier(contour);
    else
        drawn.contour =
            drawn.building && !outliner_.has_own_footprints() ? *drawn.building : placer.whole(contour);
    return drawn;
}

template <typename Record>
void Emitter::write(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
                    Placed&& placed, double threshold) {
    record.area_m2 = placed.measure.area_m2;
    record.perimeter_m = placed.measure.perimeter_m;
    record.status = placed.status;
    const StageClock clock(context_.report, Stage::write);
    sink_.add(layer, {field_values(attributes, record), std::move(placed.parts), threshold});
}

void Emitter::count(std::size_t contour, const Drawn& drawn) {
    if (is_doubtful(contour))
        return;
    LevelReport& level = context_.report.levels[static_cast<std::size_t>(drawn.record.level)];
    ++level.contours;
    level.points += drawn.record.points;
    if (drawn.record.level > 0)
        rmse_.add(drawn.own, emission_.fixed);
}

/// How much of a building's outline stays as it was traced.
void Emitter::measure(const Placed& placed) {
    context_.report.outlines_m += placed.measure.perimeter_m;
    context_.report.kept_traced_m += placed.kept_traced * placed.measure.perimeter_m;
}

void Emitter::add_building(std::size_t contour, Drawn& drawn) {
    Placed& placed = *drawn.building;
    troubles_.note("Building", drawn.building_record.id, placed);
    torn_.note("building", drawn.building_record.id, placed);
    if (rejected_)
        rejected_->note(contour, LayerRole::buildings, drawn.building_record.id, placed);
    if (placed.parts.empty())
        return;
    ++(is_doubtful(contour) ? context_.report.doubtful : context_.report.buildings);
    if (!is_doubtful(contour))
        measure(placed);
    if (!contours_layer_)
        context_.report.vertices += vertices_of(placed.parts);
    BuildingRecord& record = drawn.building_record;
    record.deviation_m =
        placed.deviation / std::sqrt(emission_.georeference.cell_area()) * emission_.cell_size_m;
    record.area_change = placed.area_change;
    if (detects_buildings(emission_.options) && !is_doubtful(contour))
        odd_heights_.note(record, drawn.record);
    write(*building_layer(contour), building_attributes(), record, std::move(placed), drawn.record.threshold);
}

bool Emitter::add_contour(std::size_t contour, Drawn& drawn) {
    troubles_.note("Contour", drawn.record.id, *drawn.contour);
    torn_.note("contour", drawn.record.id, *drawn.contour);
    // A contour that its children cover whole has no band of its own.
    if (rejected_)
        rejected_->note(contour, LayerRole::contours, drawn.record.id, *drawn.contour);
    if (drawn.contour->parts.empty())
        return false;
    ++context_.report.contours;
    context_.report.vertices += vertices_of(drawn.contour->parts);
    write(*contours_layer_, contour_attributes(), drawn.record, std::move(*drawn.contour),
          drawn.record.threshold);
    return true;
}

void Emitter::add(std::size_t contour, Drawn&& drawn) {
    count(contour, drawn);
    const std::int64_t parent = emission_.contours.head(contour).parent;
    drawn.record.parent_id = parent < 0 ? 0 : written_id_[static_cast<std::size_t>(parent)];
    if (drawn.building)
        add_building(contour, drawn);
    const bool written = drawn.contour && add_contour(contour, drawn);
    written_id_[contour] = written ? drawn.record.id : drawn.record.parent_id;
}

void Emitter::finish() {
    troubles_.finish();
    odd_heights_.finish();
    if (const std::string traced = traced_doubt(context_.report, emission_.cell_size_m); !traced.empty())
        context_.warn(as_sentence(traced));
    torn_.finish(spoken_name(emission_.target_crs, emission_.options.outline.target_crs), context_);
    if (rejected_)
        rejected_->write(placers_, sink_, context_);
    for (Placer& placer : placers_)
        context_.report.merge(placer.tally());
    context_.report.stack_rmse_m = rmse_.value() * context_.report.units.vertical_metres;
}

}  // namespace

void emit(const Emission& emission, RecordMaker& records, FeatureSink& sink, Context& context) {
    constexpr std::size_t piece = 64;  // contours that a thread draws at a time
    Emitter emitter(emission, records, sink, context);
    emitter.begin();
    const std::size_t count = emission.contours.size();
    context.threads->in_order(
        (count + piece - 1) / piece,
        [&](std::size_t k, std::size_t thread) {
            std::vector<Drawn> drawn;
            for (std::size_t i = k * piece; i < std::min(count, (k + 1) * piece); ++i)
                drawn.push_back(emitter.draw(i, thread));
            return drawn;
        },
        [&](std::size_t k, std::vector<Drawn> drawn) {
            for (std::size_t i = 0; i < drawn.size(); ++i)
                emitter.add(k * piece + i, std::move(drawn[i]));
            context.progress(static_cast<double>(k * piece) / static_cast<double>(count));
        });
    emitter.finish();
}

}  // namespace d2b
