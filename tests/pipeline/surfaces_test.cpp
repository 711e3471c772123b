#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <variant>
#include <vector>

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
        options.write.surfaces = {"s.obj"};  // options about it ask for one
        report =
            run(options, {source}, {sink, nullptr, nullptr, nullptr, nullptr, {&shell, &solids, &tiers}});
    }

    MemorySink sink;
    MemorySurface shell;
    MemorySurface solids{SurfaceForm::solids};
    MemorySurface tiers{SurfaceForm::tiers};
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
        EXPECT_EQ(surface::fault_of(town.shell.parts), "");
        ASSERT_EQ(town.solids.parts.size(), 4U);  // the tower stands apart from its podium
        for (const SurfacePart& solid : town.solids.parts)
            EXPECT_EQ(surface::fault_of({&solid, 1}), "");
        EXPECT_EQ(town.shell.parts.size(), 3U);
        EXPECT_TRUE(surface::twice_plan_area(town.shell.parts, FaceKind::roof) ==
                    surface::twice_plan_area(town.solids.parts, FaceKind::roof));
        ASSERT_TRUE(town.report.surface);
        EXPECT_EQ(town.report.surface->blocks, 3);
        EXPECT_EQ(town.report.surface->buildings, 4);
        EXPECT_EQ(town.solids.meta.lod, "1.3");
    }
}

/// The gabled house of the made town has two slopes of 33.7 degrees to the north and the south, which share
/// the ends of their ridge.
TEST(Surfaces, ofRoofsAreClosedAndSlanted) {
    Options options;
    options.write.surface_of = SurfaceOf::roofs;
    const SurfaceRun town(options);
    EXPECT_EQ(town.solids.meta.lod, "2.2");
    EXPECT_EQ(town.report.counted(Reason::surface_roof_tiers), 0);
    EXPECT_EQ(surface::fault_of(town.shell.parts, true), "");
    ASSERT_EQ(town.solids.parts.size(), 3U);
    std::vector<SurfaceRoofPlane> slanted;
    for (const SurfacePart& solid : town.solids.parts) {
        EXPECT_EQ(surface::fault_of({&solid, 1}, true), "");
        const SurfaceBuilding& building = solid.buildings.front();
        for (const SurfaceFace& face : building.faces)
            EXPECT_EQ(face.roof >= 0, face.kind == FaceKind::roof);
        if (std::isnan(building.roofs.front().azimuth))
            continue;
        slanted = building.roofs;
        EXPECT_EQ(solid.points.size(), 12U);  // of the gabled house
        std::vector<std::uint32_t> corners;   // of both slopes
        for (const SurfaceFace& face : building.faces)
            if (face.kind == FaceKind::roof)
                corners.insert(corners.end(), face.exterior.begin(), face.exterior.end());
        std::ranges::sort(corners);
        EXPECT_EQ(corners.size(), 8U);
        EXPECT_EQ(corners.end() - std::unique(corners.begin(), corners.end()), 2);
    }
    ASSERT_EQ(slanted.size(), 2U);
    std::ranges::sort(slanted, {}, [](const SurfaceRoofPlane& plane) { return std::cos(plane.azimuth); });
    for (const SurfaceRoofPlane& plane : slanted)
        EXPECT_NEAR(plane.slope, 33.7, 1);
    EXPECT_NEAR(std::abs(slanted[0].azimuth - slanted[1].azimuth), 180, 2);
    EXPECT_NEAR(std::fmod(slanted[0].azimuth + 90, 180), 90, 2);
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
            // Roofs make up for the scale of UTM, whose areas differ by up to 0.08 %.
            EXPECT_TRUE(std::abs(z - record.ground) < 0.001 ||
                        std::abs(z - record.ground - record.mean_m) < 0.001 * record.mean_m)
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

/// Corners of roofs, each a place and a height.
std::set<SurfacePoint> roof_corners(const MemorySurface& solids) {
    std::set<SurfacePoint> corners;
    for (const SurfacePart& part : solids.parts)
        for (const SurfaceFace& face : part.buildings.front().faces)
            if (face.kind == FaceKind::roof) {
                std::vector<std::vector<std::uint32_t>> rings = face.interiors;
                rings.push_back(face.exterior);
                for (const auto& ring : rings)
                    for (const std::uint32_t corner : ring)
                        corners.insert(part.points[corner]);
            }
    return corners;
}

std::set<SurfacePoint> tier_corners(const MemorySurface& tiers) {
    std::set<SurfacePoint> corners;
    for (const SurfacePart& part : tiers.parts)
        for (const SurfaceTier& tier : part.buildings.front().tiers)
            for (const auto& ring : tier.rings)
                corners.insert(ring.begin(), ring.end());
    return corners;
}

/// Whether a point lies on an edge of a ring, between its ends.
bool is_on(const std::vector<SurfacePoint>& ring, const SurfacePoint& p) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const SurfacePoint& a = ring[i];
        const SurfacePoint& b = ring[(i + 1) % ring.size()];
        if ((b.x - a.x) * (p.y - a.y) == (b.y - a.y) * (p.x - a.x) && std::min(a.x, b.x) <= p.x &&
            p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y))
            return true;
    }
    return false;
}

/// A surface has corners more only where another outline ends on an edge.
TEST(Surfaces, tiersHaveTheirCornersAndHeights) {
    Options options;
    options.detect.split_height = 3;
    options.write.surface_of = SurfaceOf::contours;
    const SurfaceRun town(options);
    EXPECT_TRUE(town.tiers.finished);
    ASSERT_EQ(town.tiers.parts.size(), town.solids.parts.size());
    EXPECT_EQ(town.report.counted(Reason::surface_corner_cut), 0);
    const std::set<SurfacePoint> roofs = roof_corners(town.solids);
    const std::set<SurfacePoint> corners = tier_corners(town.tiers);
    EXPECT_GE(corners.size(), 16U);
    for (const SurfacePoint& corner : roofs) {
        if (corners.contains(corner))
            continue;
        bool on_edge = false;
        for (const SurfacePart& part : town.tiers.parts)
            for (const SurfaceTier& tier : part.buildings.front().tiers)
                for (const auto& ring : tier.rings)
                    on_edge = on_edge || (tier.top == corner.z && is_on(ring, corner)) || is_on(ring, corner);
        EXPECT_TRUE(on_edge) << corner.x << " " << corner.y << " " << corner.z;
    }
    // Each tier whose roof is seen somewhere has its height among the roofs.
    std::set<std::int64_t> heights;
    for (const SurfacePoint& corner : roofs)
        heights.insert(corner.z);
    for (const SurfacePart& part : town.tiers.parts)
        for (const SurfaceTier& tier : part.buildings.front().tiers)
            EXPECT_TRUE(heights.contains(tier.top)) << tier.top;
    for (std::size_t i = 0; i < town.tiers.parts.size(); ++i) {
        const SurfaceBuilding& building = town.tiers.parts[i].buildings.front();
        const SurfaceBuilding& solid = town.solids.parts[i].buildings.front();
        EXPECT_EQ(building.id, solid.id);
        EXPECT_EQ(building.values, solid.values);
        const auto lowest = std::ranges::min(town.solids.parts[i].points, {}, &SurfacePoint::z).z;
        EXPECT_EQ(building.base, lowest);
    }
}

/// The flat roof of a tier form is that of the surface of blocks.
TEST(Surfaces, tiersKnowTheirFlatRoofs) {
    const SurfaceRun town{Options()};
    for (std::size_t i = 0; i < town.tiers.parts.size(); ++i)
        EXPECT_EQ(town.tiers.parts[i].buildings.front().roof,
                  std::ranges::max(town.solids.parts.at(i).points, {}, &SurfacePoint::z).z);
}

/// The whole stack is the last of those that end at a level, and fewer levels are no nearer.
TEST(Surfaces, cutsEndWithTheWholeStack) {
    const SurfaceRun town{Options()};
    ASSERT_GE(town.report.cuts.size(), 2U);
    EXPECT_EQ(town.report.cuts.back().rmse_m, town.report.stack_rmse_m);
    for (std::size_t i = 0; i < town.report.cuts.size(); ++i) {
        EXPECT_EQ(town.report.cuts[i].level, static_cast<std::int32_t>(i + 1));
        if (i > 0) {
            EXPECT_LE(town.report.cuts[i].rmse_m, town.report.cuts[i - 1].rmse_m + 0.01);
        }
    }
}

/// Sums of points say the same as cells in traced outlines.
TEST(Surfaces, cutsOfTheThesis) {
    Options options;
    options.preset = Preset::thesis;
    const SurfaceRun town(options);
    ASSERT_GE(town.report.cuts.size(), 2U);
    EXPECT_NEAR(town.report.cuts.back().rmse_m, town.report.stack_rmse_m, 1e-12);
    EXPECT_GT(town.report.cuts.front().rmse_m, town.report.cuts.back().rmse_m);
}

}  // namespace
}  // namespace d2b::test
