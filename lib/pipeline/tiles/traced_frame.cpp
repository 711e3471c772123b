#include "pipeline/tiles/traced_frame.hpp"

#include "diagnose/strange_values.hpp"
#include "pipeline/report_run.hpp"

namespace d2b {

TracedFrame traced_frame(const TileRun& run, const FoundFacts& facts, Context& context) {
    const ElevationStatistics& statistics = facts.survey.statistics;
    const RunPlan& decided = run.setup().plan;
    TracedFrame traced{plan_global_levels(statistics, decided.asked.levels, decided.levels, context), {}};
    traced.frame = {run.window(), traced.plan.level_count(), statistics.fixed_point(), statistics.range()};
    return traced;
}

FoundFacts tell_frame(TileRun& run, FeatureSink& features) {
    Context& context = run.context();
    FoundFacts facts = run.load_frame();
    report_strange_values(facts.survey.strange, facts.survey.statistics.moments.n, run.undeclared(),
                          run.setup().dem, run.setup().plan.asked.read, context);
    for (const std::string& text : facts.warnings)
        context.warn(text);
    pass_warnings(run.sources(), {features}, context);
    return facts;
}

}  // namespace d2b
