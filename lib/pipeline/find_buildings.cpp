#include "pipeline/find_buildings.hpp"

#include <limits>
#include <utility>

#include "core/progress_span.hpp"
#include "core/stage_clock.hpp"
#include "detect/merge_units.hpp"
#include "detect/unit_seams.hpp"

namespace d2b {
namespace {

void put_into(FoundBuildings& found, UnitMerger::Merged&& merged, double metres) {
    found.buildings = merged.buildings;
    for (const SeenObject& seen : merged.objects)
        found.add(seen.ground / metres, seen.object);
    found.labels.renumber(std::move(merged.number));
}

/// Accumulates the results of units, which arrive row by row.
class UnitSum {
  public:
    UnitSum(const UnitSearch& search, std::int32_t unit_cols, FoundBuildings& found)
        : search_(search), found_(found), seams_(unit_cols) {}

    /// @param col column of the unit in its row
    void add(const Unit& unit, std::int32_t col, FoundInUnit&& here) {
        const StageClock clock(search_.context.report, Stage::detect);
        Executor& threads = *search_.context.threads;
        found_.fit.merge(here.fit);
        found_.slope.merge(here.slope);
        found_.sides.merge(here.sides);
        found_.parcels.merge(here.parcels);
        found_.sampling.merge(here.sampling);
        found_.islands.merge(here.islands);
        const Label more = merger_.add(here.objects);
        UnitEdges edges = edges_of(unit, here.labels);
        edges.add(more);
        seams_.add(col, std::move(edges), merger_);
        found_.labels.append(unit, here.labels, threads, more);
    }
    void finish(const UnitGrid& units) {
        put_into(found_, join_units(merger_, search_.plan, units, search_.frame.cell, search_.context.report),
                 search_.frame.metres);
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

FoundBuildings::FoundBuildings() {
    add(std::numeric_limits<double>::quiet_NaN(), {});
    footprints.back() = {};
}

void FoundBuildings::add(double elevation, const DetectedObject& object) {
    ground.push_back(elevation);
    footprints.push_back(
        {elevation, object.confidence, doubt_name(object.doubt), object.parcel, object.whole});
}

std::int64_t least_cells(const RunPlan& plan, const UnitGrid& units, const CellSize& cell) {
    return units.count() > 1 ? cells_for(plan.building_m2, cell) : 1;
}

UnitMerger::Merged join_units(UnitMerger& merger, const RunPlan& plan, const UnitGrid& units,
                              const CellSize& cell, RunReport& report) {
    UnitMerger::Merged merged = merger.finish(least_cells(plan, units, cell));
    report.count(Reason::building_doubtful,
                 static_cast<std::int64_t>(merged.objects.size()) - merged.buildings);
    if (plan.asked.write.doubtful)
        return merged;
    merged.objects.resize(merged.buildings);
    for (Label& number : merged.number)
        number = number > merged.buildings ? 0 : number;
    return merged;
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
    sum.finish(units);
    context.threads->blocks()->clear();  // no grid is allocated after this point
    return found;
}

}  // namespace d2b
