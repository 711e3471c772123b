// Buildings at the places of scenes, and checks that their truth is sound.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "draft.hpp"
#include "make_scene.hpp"
#include "sample_files.hpp"

namespace d2b::test {
namespace {

using namespace sample;

OGRPolygon polygon_of(const WorldPolygon& polygon) {
    OGRPolygon result;
    const auto add = [&](const WorldRing& ring) {
        OGRLinearRing line;
        for (const Position& p : ring)
            line.addPoint(p.x, p.y);
        line.closeRings();
        result.addRing(&line);
    };
    add(polygon.exterior);
    for (const WorldRing& hole : polygon.interiors)
        add(hole);
    return result;
}

double area_of(const OGRGeometry& geometry) {
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPolygon:
            return geometry.toPolygon()->get_Area();
        case wkbMultiPolygon:
            return geometry.toMultiPolygon()->get_Area();
        default:
            return 0;
    }
}

/// Area of a sum and of a union: equal where nothing overlaps.
struct Areas {
    double sum = 0;
    double united = 0;
};

template <typename Things, typename PolygonOf>
Areas areas_of(const Things& things, PolygonOf outline_of) {
    Areas areas;
    OGRMultiPolygon all;
    for (const auto& thing : things) {
        const OGRPolygon polygon = polygon_of(outline_of(thing));
        areas.sum += polygon.get_Area();
        all.addGeometry(&polygon);
    }
    const std::unique_ptr<OGRGeometry> united(all.UnionCascaded());
    areas.united = area_of(*united);
    return areas;
}

class EachPlace : public testing::TestWithParam<Place> {};

TEST_P(EachPlace, HoldsBuildingsThatDoNotOverlap) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = GetParam().make(seed);
        const bool empty = GetParam().name == "forest" || GetParam().name == "fields";
        ASSERT_EQ(scene.buildings.empty(), empty);
        if (empty)
            continue;
        const Areas areas = areas_of(scene.buildings, [](const Building& b) { return b.footprint; });
        EXPECT_NEAR(areas.sum / areas.united, 1, 1e-6) << "seed " << seed;
        for (const Building& building : scene.buildings) {
            const Rect box = bounds(building.footprint.exterior);
            EXPECT_TRUE(box.x0 >= 0 && box.y0 >= 0 && box.x1 <= GetParam().side && box.y1 <= GetParam().side)
                << building.kind << " at " << box.x0 << ", " << box.y0 << ", seed " << seed;
        }
    }
}

TEST_P(EachPlace, IsAFunctionOfItsSeed) {
    const auto heights = [&](std::uint64_t seed) {
        std::vector<double> all;
        const Scene scene = GetParam().make(seed);
        for (const Tree& tree : scene.trees)
            all.push_back(tree.height);
        return all;
    };
    EXPECT_EQ(heights(4), heights(4));
    EXPECT_NE(heights(4), heights(5));
}

INSTANTIATE_TEST_SUITE_P(Places, EachPlace, testing::ValuesIn(places().begin(), places().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Places, CrownsLeanOnRoofs) {
    const Scene scene = village(1);
    const auto leaning =
        std::count_if(scene.buildings.begin(), scene.buildings.end(), [&](const Building& b) {
            return std::any_of(scene.trees.begin(), scene.trees.end(), [&](const Tree& tree) {
                const OGRPoint trunk(tree.trunk.x, tree.trunk.y);
                return tree.height > 4 && polygon_of(b.footprint).Distance(&trunk) < 0.75 * tree.radius;
            });
        });
    EXPECT_GT(leaning, static_cast<std::ptrdiff_t>(scene.buildings.size() / 6));
}

TEST(Places, RowsHaveAHouseOfOneHeightOnEachParcel) {
    for (const auto make : {rows, hillside}) {
        const Scene scene = make(1);
        ASSERT_GT(scene.parcels.size(), 30U);
        const Areas areas = areas_of(scene.parcels, [](const Parcel& parcel) { return parcel.polygon; });
        EXPECT_NEAR(areas.sum / areas.united, 1, 1e-6);
        const Building* last = nullptr;
        std::size_t found = 0;
        for (const Building& house : scene.buildings) {
            if (house.kind != "row house")
                continue;
            const OGRPolygon outline = polygon_of(house.footprint);
            found += static_cast<std::size_t>(
                std::count_if(scene.parcels.begin(), scene.parcels.end(), [&](const Parcel& parcel) {
                    const OGRPolygon plot = polygon_of(parcel.polygon);
                    const std::unique_ptr<OGRGeometry> shared(plot.Intersection(&outline));
                    return area_of(*shared) > 0.999999 * outline.get_Area();
                }));
            // Neighbours share two corners exactly, and the roof goes on.
            if (last != nullptr && last->footprint.exterior[1] == house.footprint.exterior[0]) {
                EXPECT_EQ(last->footprint.exterior[2], house.footprint.exterior[3]);
                EXPECT_EQ(last->ground + last->top(), house.ground + house.top());
            }
            last = &house;
        }
        EXPECT_EQ(found, scene.parcels.size());
    }
}

TEST(Places, HillsidesHaveWallsBelowTheirTerraces) {
    const Scene scene = hillside(1);
    double highest = 0;
    for (const Terrace& terrace : scene.ground.terraces) {
        const Rect& level = terrace.rect;
        const auto at = [&](double y) {
            return scene.ground.at(terrace.frame.to_scene(Position{level.centre().x, y}));
        };
        EXPECT_EQ(at(level.y0 + 1), at(level.y1 - 1));
        highest = std::max(highest, at(level.y0) - at(level.y0 - 0.5));
    }
    EXPECT_GT(highest, 1.5);
}

TEST(Scenes, WriteFoldersThatTellTheTruth) {
    GDALAllRegister();
    const std::string folder = testing::TempDir() + "d2b_scene";
    VSIRmdirRecursive(folder.c_str());
    VSIMkdir(folder.c_str(), 0755);
    make_scene(folder, choose_scene("rows_thinned"), 2);
    const std::string own = folder + "/rows_thinned";
    const Raster surface = read_raster(own, "dsm");
    const Raster terrain = read_raster(own, "dtm");
    EXPECT_EQ(surface.cols, 120);
    EXPECT_EQ(terrain.rows, 120);
    const auto layers = read_truth(own, "reference_buildings.gpkg");
    ASSERT_EQ(layers.size(), 4U);
    EXPECT_EQ(layers[2].name, "parcels");
    EXPECT_EQ(layers[3].name, "roofs");
    EXPECT_GE(layers[3].footprints.size(), layers[0].footprints.size());
    double area = 0;
    int roof = 0;
    int low = 0;
    for (const Footprint& house : layers[0].footprints) {
        area += house.polygon->get_Area();
        EXPECT_NEAR(house.polygon->get_Area(), house.width_m * house.length_m, 1e-6);
        OGRPoint middle;
        house.polygon->Centroid(&middle);
        const auto col = static_cast<int>((middle.getX() - surface.transform[0]) / 2.5);
        const auto row = static_cast<int>((surface.transform[3] - middle.getY()) / 2.5);
        ++roof;
        low += surface.at(row, col) < terrain.at(row, col) + 2 ? 1 : 0;
    }
    double blocks = 0;
    for (const Footprint& block : layers[1].footprints)
        blocks += block.polygon->get_Area();
    EXPECT_NEAR(blocks, area, 1e-3);
    EXPECT_LT(layers[1].footprints.size(), layers[0].footprints.size() / 3);
    // A cell of a narrow house without a pulse may have been filled from beside it.
    EXPECT_LE(low, roof / 50);
    VSIRmdirRecursive(folder.c_str());
}

TEST(Scenes, HaveOtherCellsAndPulsesIfTheyAreAskedFor) {
    SceneChoice choice = choose_scene("rows_lidar2");
    EXPECT_EQ(grid_over(choice).cols, 300);
    choice.survey.cell = 0.5;
    EXPECT_EQ(grid_over(choice).cols, 600);
    // A pulse comes down in about every other cell, and fills those around it.
    const Seen seen = see(choice.place.make(1), grid_over(choice), choice.survey);
    ASSERT_EQ(seen.elevations.size(), 360000U);
    EXPECT_TRUE(
        std::none_of(seen.elevations.begin(), seen.elevations.end(), [](float z) { return std::isnan(z); }));
}

}  // namespace
}  // namespace d2b::test
