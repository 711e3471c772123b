#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <gdal.h>

#include "core/crs.hpp"
#include "mesh/mesh_tool.hpp"

namespace d2b::test {
namespace {

class MeshGround : public MeshTool {
  protected:
    /// 40 by 30 cells of 1 m from (499990, 5800020) on, in coordinates from (500000, 5800000).
    void ground(const std::function<double(double x, double y)>& elevation,
                const std::string& crs = "EPSG:25832") const {
        RasterSpec spec;
        spec.cols = 40;
        spec.rows = 30;
        spec.crs = crs;
        spec.transform = std::array<double, 6>{499990, 1, 0, 5800020, 0, -1};
        for (int row = 0; row < spec.rows; ++row)
            for (int col = 0; col < spec.cols; ++col)
                spec.values.push_back(elevation(col + 0.5 - 10, 20 - row - 0.5));
        write(path("g.tif"), spec);
    }
    const Arguments on_ground_{"-ground", "g.tif", "in.city.json", "out.obj"};
};

TEST_F(MeshGround, standsOnAPlate) {
    city(two_boxes());
    ground([](double, double) { return 2; });
    const nlohmann::json report = mesh_well(on_ground_);
    const ReadMesh mesh = read("out.obj");
    EXPECT_TRUE(mesh.is_closed());
    // 10 m of earth, then the parts of the buildings above 2 m.
    EXPECT_NEAR(mesh.volume(), 40 * 30 * 10 + 50 * 7 + 25 * 2, 1e-2);
    EXPECT_NEAR(mesh.plan_area("terrain/terrain"), 40 * 30 - 75, 1e-6);
    EXPECT_NEAR(mesh.plan_area("plate/plate"), -40 * 30, 1e-6);
    EXPECT_EQ(mesh.plan_area("building_1/ground"), 0);
    EXPECT_GE(mesh.smallest_plan_angle(), 20.7);
    EXPECT_EQ(report["ground"]["cells"], 40 * 30 - 75);
    EXPECT_EQ(report["ground"]["largest_error_m"], 0);
    EXPECT_EQ(report["ground"]["lifted_roofs"].size(), 0U);
    EXPECT_EQ(report["origin"][2], -8);
}

TEST_F(MeshGround, takesTheBaseAndAMargin) {
    city(two_boxes());
    ground([](double, double) { return 2; });
    mesh_well({"-base", "3", "-margin", "5", "-ground", "g.tif", "in.city.json", "out.obj"});
    EXPECT_TRUE(read("out.obj").is_closed());
    EXPECT_NEAR(read("out.obj").volume(), 50 * 40 * 3 + 50 * 7 + 25 * 2, 1e-2);
}

TEST_F(MeshGround, followsAHillWithinTheError) {
    city(two_boxes());
    ground([](double x, double y) { return 3 * std::exp(-(x * x + (y - 8) * (y - 8)) / 40); });
    std::size_t before = 0;
    for (const char* error : {"1", "0.25", "0.05"}) {
        const nlohmann::json report =
            mesh_well({"-overwrite", "-ground_error", error, "-ground", "g.tif", "in.city.json", "out.obj"});
        const ReadMesh mesh = read("out.obj");
        EXPECT_TRUE(mesh.is_closed());
        EXPECT_LE(report["ground"]["largest_error_m"],
                  std::stoi(error) == 1 ? 1.0 : (error[2] == '2' ? 0.25 : 0.05));
        EXPECT_EQ(report["ground"]["cells_beyond_tolerance"].size(), 0U);
        EXPECT_GT(mesh.points.size(), before);
        EXPECT_GE(mesh.smallest_plan_angle(), 20.7);
        before = mesh.points.size();
    }
}

/// Height of the terrain over a place, from the triangles that hold it; NaN where none does.
double terrain_at(const ReadMesh& mesh, double x, double y) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.objects[i] != "terrain/terrain")
            continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const std::array<double, 3>& p = mesh.points[a];
        const double ux = mesh.points[b][0] - p[0];
        const double uy = mesh.points[b][1] - p[1];
        const double vx = mesh.points[c][0] - p[0];
        const double vy = mesh.points[c][1] - p[1];
        const double area = ux * vy - uy * vx;
        const double s = ((x - p[0]) * vy - (y - p[1]) * vx) / area;
        const double t = (ux * (y - p[1]) - uy * (x - p[0])) / area;
        if (s >= -1e-9 && t >= -1e-9 && s + t <= 1 + 1e-9)
            return p[2] + s * (mesh.points[b][2] - p[2]) + t * (mesh.points[c][2] - p[2]);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

TEST_F(MeshGround, followsACliffWithinTheError) {
    city(two_boxes());
    // Bare rock of up to 12 m, whose height differs by metres between neighbouring cells. The plain below it
    // is not level, because one value along the border is undeclared NoData.
    const auto cliff = [](double x, double y) {
        return x < 18 ? 0.01 * x : 8 + 4 * std::sin(2.1 * x) * std::cos(1.7 * y);
    };
    ground(cliff);
    const nlohmann::json report = mesh_well(on_ground_);
    EXPECT_EQ(report["ground"]["cells_beyond_tolerance"].size(), 0U);
    EXPECT_LE(report["ground"]["largest_error_m"], 0.25);
    const ReadMesh mesh = read("out.obj");
    EXPECT_TRUE(mesh.is_closed());
    const auto origin = report["origin"].get<std::vector<double>>();
    for (double x = 15.5; x < 30; ++x)
        for (double y = -9.5; y < 20; ++y)
            EXPECT_NEAR(terrain_at(mesh, x + 500000 - origin[0], y + 5800000 - origin[1]) + origin[2],
                        cliff(x, y), 0.251)
                << x << " " << y;
}

TEST_F(MeshGround, keepsValuesThatLookUndeclared) {
    city(two_boxes());
    ground([](double x, double) { return x < 5 ? 0.0 : 8 + 0.01 * x; });
    const ToolResult left_out = mesh(on_ground_);
    EXPECT_NE(left_out.err.find("450 cells of the terrain 'g.tif' have the elevation 0"), std::string::npos);
    const nlohmann::json kept =
        mesh_well({"-overwrite", "-inodata", "-ground", "g.tif", "in.city.json", "out.obj"});
    EXPECT_EQ(kept["ground"]["cells"], 40 * 30 - 75);
}

TEST_F(MeshGround, liftsRoofsThatTheTerrainComesNear) {
    city(two_boxes());
    ground([](double, double) { return 3.75; });
    const nlohmann::json lifted = mesh_well(on_ground_)["ground"]["lifted_roofs"];
    ASSERT_EQ(lifted.size(), 1U);
    EXPECT_EQ(lifted[0]["building"], "building_2");
    EXPECT_NEAR(lifted[0]["metres"], 0.25, 1e-6);
    EXPECT_TRUE(read("out.obj").is_closed());
    EXPECT_NEAR(read("out.obj").volume(), 40 * 30 * 10 + 50 * 5.25 + 25 * 0.5, 1e-2);
    EXPECT_EQ(mesh_well({"-overwrite", "-min_wall", "0.2", "-ground", "g.tif", "in.city.json",
                         "out.obj"})["ground"]["lifted_roofs"]
                  .size(),
              0U);
}

TEST_F(MeshGround, keepsEdgesShortOnSlopesAndSides) {
    city(two_boxes());
    ground([](double x, double) { return 0.1 * x; });
    mesh_well({"-max_edge", "3", "-ground", "g.tif", "in.city.json", "out.obj"});
    EXPECT_TRUE(read("out.obj").is_closed());
    EXPECT_LE(read("out.obj").longest_edge(), 3 + 1e-6);
}

TEST_F(MeshGround, fillsWhatTheRasterDoesNotKnow) {
    city(two_boxes());
    ground([](double x, double) { return x > 25 ? std::numeric_limits<double>::quiet_NaN() : 2; });
    EXPECT_EQ(mesh_well(on_ground_)["ground"]["cells"], 35 * 30 - 75);
    EXPECT_NEAR(read("out.obj").volume(), 40 * 30 * 10 + 50 * 7 + 25 * 2, 1e-2);
}

TEST_F(MeshGround, bringsFeetToMetres) {
    city(two_boxes());
    RasterSpec spec;
    spec.cols = 40;
    spec.rows = 30;
    spec.transform = std::array<double, 6>{499990, 1, 0, 5800020, 0, -1};
    spec.values.assign(1200, 2 / 0.3048);
    GDALDatasetH raster = create(path("g.tif"), spec);
    ASSERT_EQ(GDALSetRasterUnitType(GDALGetRasterBand(raster, 1), "ft"), CE_None);
    GDALClose(raster);
    mesh_well(on_ground_);
    EXPECT_NEAR(read("out.obj").volume(), 40 * 30 * 10 + 50 * 7 + 25 * 2, 1e-1);
}

TEST_F(MeshGround, bringsTheRasterToTheCity) {
    city(two_boxes());
    // The same place in the next zone: a rectangle that is turned a little there.
    RasterSpec spec;
    spec.cols = 60;
    spec.rows = 60;
    spec.crs = "EPSG:25833";
    spec.transform = std::array<double, 6>{90000, 1, 0, 5816400, 0, -1};
    spec.values.assign(3600, 2);
    // (500000, 5800000) of zone 32 in zone 33, by the transformation itself.
    const Crs from("EPSG:25832");
    std::vector<Position> middle{{500007, 5800004}};
    CoordinateTransform(from, Crs("EPSG:25833"), middle).apply(middle);
    (*spec.transform)[0] = std::floor(middle[0].x) - 30;
    (*spec.transform)[3] = std::floor(middle[0].y) + 30;
    write(path("g.tif"), spec);
    // Nothing is known beside its corners, but no building stands there.
    mesh_well(on_ground_);
    const ReadMesh mesh = read("out.obj");
    EXPECT_TRUE(mesh.is_closed());
    EXPECT_NEAR(mesh.volume() + mesh.plan_area("plate/plate") * 10, 50 * 7 + 25 * 2, 1e-2);
}

TEST_F(MeshGround, sharesItsVerticesInCityJson) {
    city(two_boxes());
    ground([](double, double) { return 2; });
    mesh_well({"-ground", "g.tif", "in.city.json", "out.city.json"});
    const nlohmann::json made = nlohmann::json::parse(read_bytes(path("out.city.json")));
    const auto vertices_of = [&](const std::string& name) {
        std::set<std::size_t> vertices;
        for (const auto& face : made["CityObjects"][name]["geometry"][0]["boundaries"])
            vertices.insert(face[0].begin(), face[0].end());
        return vertices;
    };
    const std::set<std::size_t> terrain = vertices_of("terrain");
    std::size_t shared = 0;
    for (const std::size_t vertex : vertices_of("building_1"))
        shared += terrain.count(vertex);
    EXPECT_GE(shared, 4U);
    // Points of sides and plate are not there.
    std::set<std::size_t> used = terrain;
    for (const char* building : {"building_1", "building_2"})
        used.merge(vertices_of(building));
    EXPECT_EQ(used.size(), made["vertices"].size());
    EXPECT_EQ(*used.rbegin() + 1, made["vertices"].size());
    EXPECT_EQ(made["metadata"]["geographicalExtent"][2], 2);
    EXPECT_EQ(made["CityObjects"]["terrain"]["type"], "TINRelief");
    EXPECT_EQ(made["CityObjects"].size(), 3U);
}

TEST_F(MeshGround, refusesTerrainElsewhere) {
    city(two_boxes());
    ground([](double, double) { return 2; }, "");
    // Coordinates without a CRS are taken as the city's.
    const ToolResult bare = mesh(on_ground_);
    EXPECT_EQ(bare.status, 0);
    expect_has(bare.err, "has no coordinate reference system");
    city({made_box("building_1", 16000, 0, 16160, 80, 9000)});
    ground([](double, double) { return 2; });
    expect_refused(1,
                   "The terrain 'g.tif' and 'in.city.json' do not meet; check the files and their coordinate "
                   "reference systems.",
                   {"-overwrite", "-ground", "g.tif", "in.city.json", "out.obj"});
    city({made_box("building_1", 0, 0, 160, 80, 9000), made_box("building_2", 16000, 0, 16160, 80, 9000)});
    expect_has(mesh({"-overwrite", "-ground", "g.tif", "in.city.json", "out.obj"}).err,
               "4 of 8 corners of 'in.city.json' lie outside of the terrain 'g.tif'");
}

/// Data that do not overlap are refused in a sentence and nothing else, without a CRS in either, or with one
/// in each.
TEST_F(MeshGround, refusesTerrainElsewhereWhateverTheSystems) {
    const std::string apart =
        "The terrain 'g.tif' and 'in.city.json' do not meet; check the files and their coordinate reference "
        "systems.";
    nlohmann::json far = made_city({made_box("building_1", 16000, 0, 16160, 80, 9000)});
    far["metadata"].erase("referenceSystem");
    write_text(path("in.city.json"), far.dump());
    ground([](double, double) { return 2; }, "");
    expect_refused(1, apart, on_ground_);
    city(two_boxes());
    ground([](double, double) { return 2; }, "EPSG:25833");
    expect_refused(1, apart, on_ground_);
    // Nothing is missing where both are at the same place without a CRS.
    nlohmann::json here = made_city(two_boxes());
    here["metadata"].erase("referenceSystem");
    write_text(path("in.city.json"), here.dump());
    ground([](double, double) { return 2; }, "");
    mesh_well(on_ground_);
    EXPECT_TRUE(read("out.obj").is_closed());
}

TEST_F(MeshGround, refusesTerrainWithoutElevations) {
    city(two_boxes());
    ground([](double, double) { return std::numeric_limits<double>::quiet_NaN(); });
    expect_refused(1, "The terrain 'g.tif' has no elevations; give one that -write_ground wrote.",
                   on_ground_);
    const ToolResult missing = mesh({"-ground", "none.tif", "in.city.json", "out.obj"});
    EXPECT_EQ(missing.status, 1);
    expect_has(missing.err, "'none.tif'");
}

}  // namespace
}  // namespace d2b::test
