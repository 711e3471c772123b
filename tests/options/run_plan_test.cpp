#include "options/run_plan.hpp"

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b::test {
namespace {

Options of(Preset preset) {
    Options options;
    options.preset = preset;
    return options;
}

RunPlan plan_of(const Options& options, Layers layers = Layers::both) {
    return make_run_plan(options, layers);
}

std::string refusal(const Options& options, Layers layers) {
    try {
        static_cast<void>(make_run_plan(options, layers));
    } catch (const OptionError& error) {
        return error.what();
    }
    return "(not refused)";
}

TEST(RunPlan, BuildingsIsTheDefault) {
    EXPECT_TRUE(detects_buildings(Options{}));
    EXPECT_FALSE(detects_buildings(of(Preset::thesis)));
}

TEST(RunPlan, OfBuildingsDecidesWhatIsNotGiven) {
    const RunPlan plan = plan_of(of(Preset::buildings));
    EXPECT_EQ(plan.ground, GroundMode::automatic);
    EXPECT_EQ(plan.levels, LevelSource::natural);
    EXPECT_EQ(plan.detail, 0.5);
    EXPECT_EQ(plan.trace, TraceMode::cells);
    EXPECT_EQ(plan.walls, Walls::automatic);
    EXPECT_EQ(plan.building_m2, 30);
    EXPECT_EQ(plan.contour_m2, 0);  // tiers may be smaller
}

TEST(RunPlan, OfTheThesisDecidesWhatIsNotGiven) {
    const RunPlan plan = plan_of(of(Preset::thesis));
    EXPECT_EQ(plan.ground, GroundMode::none);
    EXPECT_EQ(plan.levels, LevelSource::global);
    EXPECT_EQ(plan.detail, 0);
    EXPECT_EQ(plan.trace, TraceMode::points);
    EXPECT_EQ(plan.walls, Walls::off);
    EXPECT_EQ(plan.contour_m2, 0);
}

TEST(RunPlan, LeavesWhatIsGiven) {
    Options options = of(Preset::buildings);
    options.ground.mode = GroundMode::given;
    options.levels.source = LevelSource::global;
    options.trace.mode = TraceMode::points;
    options.outline.walls = Walls::right;
    options.filter.min_area_m2 = 12;
    RunPlan plan = plan_of(options);
    EXPECT_EQ(plan.ground, GroundMode::given);
    EXPECT_EQ(plan.levels, LevelSource::global);
    EXPECT_EQ(plan.trace, TraceMode::points);
    EXPECT_EQ(plan.walls, Walls::right);
    EXPECT_EQ(plan.building_m2, 12);
    EXPECT_EQ(plan.contour_m2, 0);

    options = of(Preset::thesis);
    options.trace.mode = TraceMode::cells;
    options.outline.walls = Walls::free;
    options.filter.min_area_m2 = 12;
    plan = plan_of(options);
    EXPECT_EQ(plan.trace, TraceMode::cells);
    EXPECT_EQ(plan.walls, Walls::free);
    EXPECT_EQ(plan.contour_m2, 12);
    EXPECT_EQ(plan.asked.filter.min_area_m2, 12);
}

TEST(RunPlan, SimplifiedOutlinesHaveNoStraightWalls) {
    Options options;
    options.outline.simplify = 0.5;
    EXPECT_EQ(plan_of(options).walls, Walls::off);
}

/// No wall leaves its trace by more than 1.25 m unless that is asked for.
TEST(RunPlan, WallsMayLeaveTheirTraceByCellsOrMetres) {
    Options options;
    EXPECT_EQ(plan_of(options).wall_tolerance(0.5), 1.5);
    EXPECT_EQ(plan_of(options).wall_tolerance(1), 1.25);
    EXPECT_EQ(plan_of(options).wall_tolerance(2.5), 1);  // no slanted wall lies nearer to its staircase
    EXPECT_EQ(plan_of(options).wall_tolerance(0), 1.5);  // nobody knows how large cells are
    options.outline.wall_tolerance = 3;
    EXPECT_EQ(plan_of(options).wall_tolerance(2.5), 3);
}

TEST(RunPlan, SettlesAllThatWasOpen) {
    const Options thesis = plan_of(of(Preset::thesis), Layers::contours).resolved();
    EXPECT_EQ(thesis.ground.mode, GroundMode::none);
    EXPECT_EQ(thesis.levels.source, LevelSource::global);
    EXPECT_EQ(thesis.trace.mode, TraceMode::points);
    EXPECT_EQ(thesis.outline.walls, Walls::off);
    EXPECT_EQ(thesis.filter.min_area_m2, 0);
    EXPECT_EQ(thesis.write.layers, Layers::contours);
    EXPECT_EQ(plan_of(of(Preset::buildings)).resolved().filter.min_area_m2, 30);
}

/// A format that holds one layer gets the buildings alone.
TEST(RunPlan, RefusesWhatStandsInLayersThatAreNotWritten) {
    Options options;
    options.outline.disjoint = true;
    for (const Layers layers : {Layers::both, Layers::contours})
        EXPECT_EQ(refusal(options, layers), "(not refused)");
    EXPECT_EQ(
        refusal(options, Layers::buildings),
        "-disjoint has no effect where the buildings alone are written; use -layers contours, or a format "
        "that holds both layers, such as GeoPackage.");
    options = {};
    options.write.fields = FieldNames::osm;
    EXPECT_EQ(
        refusal(options, Layers::contours),
        "-fields has no effect where the contours alone are written; only fields of buildings have other "
        "names.");
    options.write.doubtful = true;
    EXPECT_EQ(refusal(options, Layers::contours), "(not refused)");
}

}  // namespace
}  // namespace d2b::test
