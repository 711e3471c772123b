#include "pipeline/find_buildings.hpp"

#include <limits>
#include <utility>

#include "core/progress_span.hpp"
#include "core/row_bands.hpp"
#include "core/stage_clock.hpp"
#include "detect/merge_units.hpp"
#include "detect/unit_seams.hpp"

namespace d2b {
namespace {

void add_to_labels(Grid<Label>& labels, Label more, Executor& threads) {
    if (more == 0)
        return;
    for_cells(threads, labels, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            labels.values[i] += labels.values[i] != 0 ? more : 0;
    });
}

void put_into(FoundBuildings& found, UnitMerger::Merged&& merged, bool keep_doubtful, double metres,
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

/// Puts together what is found in units, which come row by row.
class UnitSum {
  public:
    UnitSum(const UnitSearch& search, std::int32_t unit_cols, FoundBuildings& found)
        : search_(search), found_(found), seams_(unit_cols) {}

    /// @param col place of the unit in its row
    void add(const Unit& unit, std::int32_t col, FoundInUnit&& here) {
        const StageClock clock(search_.context.report, Stage::detect);
        Executor& threads = *search_.context.threads;
        found_.fit.merge(here.fit);
        found_.slope.merge(here.slope);
        found_.sides.merge(here.sides);
        add_to_labels(here.labels, merger_.add(here.objects), threads);
        seams_.add(unit, col, here.labels, merger_);
        found_.labels.append(unit, here.labels, threads);
    }
    /// @param least_cells of what is no sliver
    void finish(std::int64_t least_cells) {
        put_into(found_, merger_.finish(least_cells), search_.plan.asked.write.doubtful, search_.frame.metres,
                 search_.context.report);
    }

  private:
    const UnitSearch& search_;
    FoundBuildings& found_;
    UnitMerger merger_;
    UnitSeams seams_;
};

}  // namespace

UnitGrid unit_grid(const RunPlan& plan, const Window& window, const CellSize& cell, const UnitSize& size) {
    return {window, cell, widths_around * plan.asked.ground.max_building_width, size};
}

FoundBuildings find_buildings(const UnitSearch& search, const UnitSize& size) {
    const RunPlan& plan = search.plan;
    const UnitFrame& frame = search.frame;
    Context& context = search.context;
    const UnitGrid units = unit_grid(plan, frame.window, frame.cell, size);
    FoundBuildings found;
    found.labels = LabelRows(context.make_spool(), frame.window);
    found.fit = GroundFit(plan.asked.detect.min_height);
    found.sides = {false, false, false};
    UnitSum sum(search, units.cols(), found);
    const auto all = static_cast<double>(frame.window.points());
    double done = 0;  // points
    for (std::int32_t row = 0; row < units.rows(); ++row)
        for (std::int32_t col = 0; col < units.cols(); ++col) {
            const Unit unit = units.unit(row, col);
            const double before = std::exchange(done, done + static_cast<double>(unit.own.points()));
            const ProgressSpan span(context, before / all, done / all);
            sum.add(unit, col, find_in_unit(search, unit));
        }
    if (plan.ground == GroundMode::given)
        context.report.count(Reason::terrain_outside_range, search.sources.terrain->cells_outside_range());
    sum.finish(units.count() > 1 ? cells_for(plan.building_m2, frame.cell) : 1);
    return found;
}

}  // namespace d2b
