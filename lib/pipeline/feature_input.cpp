#include "pipeline/feature_input.hpp"

#include <utility>

#include "core/stage_clock.hpp"
#include "features/contour_drawer.hpp"
#include "pipeline/provenance.hpp"

namespace d2b {

FeatureInput feature_input(const RunSetup& setup, const ToDraw& what, const RunReport& report,
                           std::function<StackError(const DrawnStack&)> compare, BuildingRecords* kept) {
    return {setup.plan,
            setup.georeference,
            setup.crs,
            setup.target,
            what.contours,
            what.outliner,
            setup.layers,
            make_provenance(setup.plan, setup.dem, setup.crs, setup.target, report),
            setup.dem.window,
            what.buildings,
            setup.cell_m(),
            what.fixed,
            std::move(compare),
            what.parcels,
            kept};
}

OutlineReach reach_of(const ContourList& contours, const RunSetup& setup, Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return reach_of(contours, setup.plan, setup.georeference, setup.crs, setup.target, setup.dem.window,
                    setup.cell_m(), context.threads->stop());
}

Outliner draw_outlines(const ContourList& contours, const RunSetup& setup, Context& context) {
    return draw_outlines(contours, setup.plan, setup.georeference, setup.crs, setup.target, setup.dem.window,
                         setup.cell_m(), context);
}

}  // namespace d2b
