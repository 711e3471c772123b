#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "pipeline/made_town.hpp"
#include "surface/surface_check.hpp"

namespace d2b::test {
namespace {

/// The made town, into surfaces of both forms.
struct SurfaceRun {
    explicit SurfaceRun(Options options, int threads = 1) {
        MemorySource source = MadeTown::source(MadeTown::surface());
        place_in_utm(source, 1);
        options.run.threads = threads;
        options.write.surfaces = {"s.obj"};  // what says more of it asks for one
        report = run(options, {source}, {sink, nullptr, nullptr, nullptr, nullptr, {&shell, &solids}});
    }

    MemorySink sink;
    MemorySurface shell;
    MemorySurface solids{SurfaceForm::solids};
    RunReport report;
};

TEST(Surfaces, bothFormsAreClosed) {
    Options options;
    options.detect.split_height = 3;
    for (const SurfaceOf of : {SurfaceOf::buildings, SurfaceOf::contours}) {
        options.write.surface_of = of;
        const SurfaceRun town(options);
        EXPECT_TRUE(town.shell.finished);
        EXPECT_TRUE(town.solids.finished);
        EXPECT_EQ(fault_of(town.shell.parts), "");
        ASSERT_EQ(town.solids.parts.size(), 4U);  // the tower stands apart from its podium
        for (const SurfacePart& solid : town.solids.parts)
            EXPECT_EQ(fault_of({&solid, 1}), "");
        EXPECT_EQ(town.shell.parts.size(), 3U);
        EXPECT_TRUE(twice_plan_area(town.shell.parts, FaceKind::roof) ==
                    twice_plan_area(town.solids.parts, FaceKind::roof));
        ASSERT_TRUE(town.report.surface);
        EXPECT_EQ(town.report.surface->blocks, 3);
        EXPECT_EQ(town.report.surface->buildings, 4);
        EXPECT_EQ(town.solids.meta.lod, "1.3");
    }
}

/// A building has the values of its fields, and stands where its record says.
TEST(Surfaces, haveTheFieldsOfTheLayer) {
    const SurfaceRun town{Options()};
    EXPECT_EQ(town.solids.meta.lod, "1.2");
    const LayerSpec& layer = town.sink.layers.at(buildings);
    ASSERT_EQ(town.solids.meta.fields.size(), layer.fields.size());
    std::size_t at = 0;
    for (const Feature& feature : town.sink.features.at(buildings)) {
        const auto& record = std::get<BuildingRecord>(feature.record);
        const SurfacePart& solid = town.solids.parts.at(at++);
        ASSERT_EQ(solid.buildings.size(), 1U);
        EXPECT_EQ(solid.buildings[0].id, record.id);
        EXPECT_EQ(solid.buildings[0].values, feature.values);
        for (const SurfacePoint& point : solid.points) {
            const double z = town.solids.meta.frame.coordinates(point)[2];
            EXPECT_TRUE(std::abs(z - record.ground) < 0.001 ||
                        std::abs(z - record.ground - record.heights_m[1]) < 0.001)
                << z;
        }
    }
    EXPECT_EQ(at, town.solids.parts.size());
}

TEST(Surfaces, doNotDependOnThreads) {
    const SurfaceRun one{Options(), 1};
    const SurfaceRun four{Options(), 4};
    ASSERT_EQ(one.shell.parts.size(), four.shell.parts.size());
    for (std::size_t i = 0; i < one.shell.parts.size(); ++i)
        EXPECT_EQ(one.shell.parts[i].points, four.shell.parts[i].points);
}

/// Nothing is looked for that nobody takes.
TEST(Surfaces, areNotReportedWhereNoneIsAskedFor) {
    TownRun town;
    town.run();
    EXPECT_FALSE(town.report.surface);
}

}  // namespace
}  // namespace d2b::test
