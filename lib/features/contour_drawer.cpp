#include "features/contour_drawer.hpp"

#include "core/stage_clock.hpp"

namespace d2b {
namespace {

/// True if the stack error is measured on the drawn outlines. Not for the thesis preset: its outlines are
/// drawn as traced, so the traced sums suffice, and reading the raster a second time may be expensive.
bool measures_drawn(const RunPlan& plan) {
    return plan.detects_buildings() && plan.trace == TraceMode::cells && plan.layers != Layers::buildings;
}

OutlineRules outline_rules(const RunPlan& plan, const Crs& target_crs, double cell_size_m) {
    return {plan.walls, plan.wall_tolerance(cell_size_m), plan.asked.outline.wall_inset,
            plan.asked.outline.simplify, target_crs.kind() != Crs::Kind::none};
}

}  // namespace

OutlineReach reach_of(const ContourList& contours, const RunPlan& plan, const Georeference& georeference,
                      const Crs& crs, const Crs& target_crs, const Window& window, double cell_size_m,
                      const StopRequest& stop) {
    return outline_reach(contours, outline_rules(plan, target_crs, cell_size_m), georeference,
                         x_stretch(georeference, crs, window), stop);
}

Outliner draw_outlines(const ContourList& contours, const RunPlan& plan, const Georeference& georeference,
                       const Crs& crs, const Crs& target_crs, const Window& window, double cell_size_m,
                       Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return make_outliner(contours, outline_rules(plan, target_crs, cell_size_m), georeference, crs, window,
                         context);
}

void add_to_stack(const DrawnContour& drawn, const LayerPlaces& places, DrawnStack& stack) {
    if (drawn.building && !drawn.building->parts.empty() && places.buildings && !drawn.is_doubtful)
        stack.add_building(drawn.building->cells);
    if (!drawn.contour || drawn.contour->parts.empty())
        return;
    if (!places.buildings && drawn.record.level == 1)
        stack.add_building(drawn.contour->cells);
    stack.add_contour(drawn.contour->cells, {drawn.record.tier_z, drawn.record.mean, drawn.record.level});
}

ContourDrawer::ContourDrawer(const FeatureInput& input, const RecordMaker& records, Context& context)
    : input_(input),
      records_(records),
      children_(input.plan.asked.outline.disjoint ? ContourChildren(input.contours) : ContourChildren()),
      with_cells_(measures_drawn(input.plan)) {
    const PolygonTerms terms{input.plan.asked.outline,
                             input.georeference,
                             input.crs,
                             input.target_crs,
                             input.window,
                             input.outliner,
                             children_,
                             context.threads->stop(),
                             with_cells_};
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        makers_.emplace_back(terms);
}

DrawnContour ContourDrawer::draw(std::size_t contour, std::size_t thread) {
    PolygonMaker& maker = makers_[thread];
    const ContourHead& head = input_.contours.head(contour);
    DrawnContour drawn{head.key, head.parent, head.building, input_.is_doubtful(contour), {}, {}, {}, {},
                       {},       {}};
    const bool is_building = head.key.level == 1;
    {
        const StageClock clock(maker.tally(), Stage::attributes);
        const StoredContours::Stored stored = input_.contours.fetch_stored(contour);
        drawn.record = records_.contour(contour, stored.contour);
        drawn.own = drawn.whole = stored.contour.own;
        drawn.whole.merge(stored.contour.above);
        if (is_building)
            drawn.building_record = records_.building(contour, stored.contour, drawn.record, stored.roof);
    }
    const LayerPlaces& places = input_.layers.places;
    if (is_building)
        draw_building(contour, maker, drawn);
    if (!places.contours || input_.is_doubtful(contour))
        return drawn;
    if (input_.plan.asked.outline.disjoint)
        drawn.contour = maker.tier(contour);
    else
        drawn.contour =
            drawn.building && !input_.outliner.has_own_footprints() ? *drawn.building : maker.whole(contour);
    return drawn;
}

/// Restores the counters if the building is in no layer, because only written outlines are reported.
void ContourDrawer::draw_building(std::size_t contour, PolygonMaker& maker, DrawnContour& drawn) const {
    const bool is_doubtful = input_.is_doubtful(contour);
    const bool is_written = input_.layers.places.of_building(is_doubtful).has_value();
    if (!is_written && (is_doubtful || input_.kept == nullptr))
        return;
    const auto counted = maker.tally().dropped;
    drawn.building = maker.footprint(contour);
    if (!is_written)
        maker.tally().dropped = counted;
}

}  // namespace d2b
