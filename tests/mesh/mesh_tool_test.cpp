#include "mesh/mesh_tool.hpp"

#include <chrono>

namespace d2b::test {
namespace {

const Arguments to_obj{"in.city.json", "out.obj"};

TEST_F(MeshTool, makesOneClosedSurfaceOfTouchingBuildings) {
    city(two_boxes());
    const nlohmann::json report = mesh_well(to_obj);
    const ReadMesh mesh = read("out.obj");
    EXPECT_TRUE(mesh.is_closed());
    EXPECT_NEAR(mesh.volume(), 50 * 9 + 25 * 4, 1e-3);
    EXPECT_NEAR(mesh.plan_area("building_1/roof"), 50, 1e-6);
    EXPECT_NEAR(mesh.plan_area("building_2/roof"), 25, 1e-6);
    EXPECT_NEAR(mesh.plan_area("building_2/ground"), -25, 1e-6);
    EXPECT_GE(mesh.smallest_plan_angle(), 20.7);
    EXPECT_EQ(report["buildings"], 2);
    EXPECT_EQ(report["points"], mesh.points.size());
    EXPECT_EQ(report["triangles"], mesh.triangles.size());
    EXPECT_EQ(report["small_angles"].size(), 0U);
    EXPECT_NEAR(report["smallest_angle"], mesh.smallest_plan_angle(), 1e-6);
    EXPECT_EQ(report["origin"], (std::vector<double>{500008, 5800004, 0}));
    EXPECT_EQ(report["ground"], nullptr);
    EXPECT_EQ(entries(), (std::vector<std::string>{"in.city.json", "out.obj"}));
}

TEST_F(MeshTool, keepsEdgesShortEverywhere) {
    city(two_boxes());
    const nlohmann::json report = mesh_well({"-max_edge", "1.5", "in.city.json", "out.obj"});
    const ReadMesh mesh = read("out.obj");
    EXPECT_TRUE(mesh.is_closed());
    EXPECT_LE(mesh.longest_edge(), 1.5 + 1e-6);
    EXPECT_NEAR(report["longest_edge_m"], mesh.longest_edge(), 1e-6);
    EXPECT_NEAR(mesh.volume(), 550, 1e-3);
}

TEST_F(MeshTool, refusesEdgesTooShortForAnyMemory) {
    city(two_boxes());
    expect_refused(2,
                   "-max_edge 0.001 would take more than 20 million points; give a larger one, or a smaller "
                   "part of the city.",
                   {"-max_edge", "0.001", "in.city.json", "out.obj"});
}

TEST_F(MeshTool, keepsThirtyDegreesOnRightAngles) {
    city(two_boxes());
    EXPECT_EQ(mesh_well({"-min_angle", "30", "in.city.json", "out.obj"})["small_angles"].size(), 0U);
    EXPECT_GE(read("out.obj").smallest_plan_angle(), 30);
}

TEST_F(MeshTool, namesAnglesOfTheInput) {
    // A wedge with a tip of 11.3 degrees at 0 0.
    city({{"building_1", {{0, 0}, {400, 0}, {400, 80}}, 0, 3000}});
    const nlohmann::json report = mesh_well(to_obj);
    ASSERT_EQ(report["small_angles"].size(), 1U);
    EXPECT_EQ(report["small_angles"][0]["x"], 500000);
    EXPECT_EQ(report["small_angles"][0]["y"], 5800000);
    EXPECT_EQ(report["small_angles"][0]["building"], "building_1");
    EXPECT_NEAR(report["small_angles"][0]["degrees"], std::atan(0.2) * 180 / 3.14159265358979, 1e-4);
}

TEST_F(MeshTool, namesPinchesThatItTakesApart) {
    city({made_box("building_1", 0, 0, 80, 80, 9000), made_box("building_2", 80, 80, 160, 160, 7000)});
    const nlohmann::json report = mesh_well(to_obj);
    EXPECT_TRUE(read("out.obj").is_closed());
    EXPECT_EQ(report["separated_points"], nlohmann::json::parse(R"([{"x": 500005.0, "y": 5800005.0}])"));
}

TEST_F(MeshTool, takesAnOrigin) {
    city(two_boxes());
    EXPECT_EQ(mesh_well({"-origin", "500000", "5800000", "-3", "in.city.json", "out.obj"})["origin"],
              (std::vector<double>{500000, 5800000, -3}));
    const ReadMesh mesh = read("out.obj");
    const auto has = [&](const std::array<double, 3>& point) {
        return std::ranges::find(mesh.points, point) != mesh.points.end();
    };
    EXPECT_TRUE(has({0, 0, 3}));
    EXPECT_TRUE(has({10, 5, 12}));
}

TEST_F(MeshTool, writesTheSameBytesAgain) {
    city(two_boxes());
    mesh_well({"-min_angle", "30", "in.city.json", "a.obj"});
    mesh_well({"-min_angle", "30", "in.city.json", "b.obj"});
    EXPECT_EQ(read_bytes(path("a.obj")), read_bytes(path("b.obj")));
}

TEST_F(MeshTool, replacesAFileOnlyWhereItIsTold) {
    city(two_boxes());
    mesh_well(to_obj);
    expect_refused(2, "\"out.obj\" exists; give another name, or -overwrite to replace it.", to_obj);
    mesh_well({"-overwrite", "-min_angle", "30", "in.city.json", "out.obj"});
    EXPECT_GE(read("out.obj").smallest_plan_angle(), 30);
}

TEST_F(MeshTool, refusesWhatItCannotMesh) {
    city({});
    expect_refused(1, "'in.city.json' has no buildings; there is nothing to mesh.", to_obj);
    expect_refused(1, "'none.city.json' cannot be read; check its name and rights.",
                   {"none.city.json", "out.obj"});
    city({made_box("building_1", 0, 0, 80, 80, 9000), made_box("building_2", 20, 20, 60, 60, 7000)});
    const ToolResult nested = mesh(to_obj);
    EXPECT_EQ(nested.status, 1);
    expect_has(nested.err, "'in.city.json' has two roofs over one place at 5000");
    expect_refused(2,
                   "Meshes are written as STL, OBJ and CityJSON; give 'out.ply' a name that ends in .stl, "
                   ".obj or .city.json.",
                   {"in.city.json", "out.ply"});
}

TEST_F(MeshTool, refusesDegreesAndUnknownSystems) {
    nlohmann::json city = made_city(two_boxes());
    city["metadata"]["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/4326";
    write_text(path("in.city.json"), city.dump());
    expect_refused(1,
                   "'in.city.json' is in degrees, which are not lengths; make it again with -t_srs and a "
                   "projected coordinate reference system.",
                   to_obj);
    city["metadata"]["referenceSystem"] = "nowhere";
    write_text(path("in.city.json"), city.dump());
    expect_refused(1,
                   "'in.city.json' has a referenceSystem that PROJ does not know, 'nowhere'; give a file "
                   "that -surface wrote.",
                   to_obj);
}

TEST_F(MeshTool, refusesCornersThatSinglePrecisionMerges) {
    // Two gaps of a 16th of a metre, 100,000 km away.
    city(two_boxes());
    const ToolResult far = mesh({"-origin", "100000000", "0", "0", "in.city.json", "out.obj"});
    EXPECT_EQ(far.status, 1);
    expect_has(far.err, "would coincide in single precision; give an -origin near them");
}

TEST_F(MeshTool, leavesNothingWhereThereIsNoRoom) {
    city(two_boxes());
    ToolSetup setup;
    setup.working_directory = folder_.string();
    // Files of two blocks of 512 bytes at most; the surface takes many.
    const ToolResult full = run_tool(
        {"/bin/sh", "-c", "ulimit -f 2; exec " D2B_MESH_TOOL " -max_edge 0.5 in.city.json out.obj"}, setup);
    EXPECT_EQ(full.status, 1);
    EXPECT_EQ(full.err, "ERROR: Cannot write \"out.obj\": File too large.\n");
    EXPECT_EQ(entries(), (std::vector<std::string>{"in.city.json"}));
}

/// The old file or the new one, whole, at any moment.
TEST_F(MeshTool, aKilledRunLeavesTheOldFileOrTheNew) {
    city(two_boxes());
    const Arguments fine{"-overwrite", "-max_edge", "0.2", "in.city.json", "out.obj"};
    mesh_well(to_obj);
    const std::string old = read_bytes(path("out.obj"));
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(mesh(fine).status, 0);
    const auto whole =
        std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start);
    const std::string finished = read_bytes(path("out.obj"));
    Arguments command{D2B_MESH_TOOL};
    command.insert(command.end(), fine.begin(), fine.end());
    ToolSetup setup;
    setup.working_directory = folder_.string();
    int killed = 0;
    for (int i = 0; i < 12; ++i) {
        write_text(path("out.obj"), old);
        setup.kill = Kill{SIGKILL, whole * (300 + 60 * i) / 1000};
        const int status = run_tool(command, setup).status;
        killed += status == 128 + SIGKILL ? 1 : 0;
        const std::string found = read_bytes(path("out.obj"));
        EXPECT_TRUE(found == finished || (found == old && status != 0)) << found.size();
    }
    EXPECT_GT(killed, 2);
    // Files left behind by killed runs do not disturb the next.
    ASSERT_EQ(mesh(fine).status, 0);
    EXPECT_EQ(read_bytes(path("out.obj")), finished);
}

TEST_F(MeshTool, saysWhatItIs) {
    EXPECT_EQ(mesh({}).status, 2);
    expect_has(mesh({}).err, "Usage: dem2buildings_mesh [options] <in.city.json>");
    expect_has(mesh({"--help"}).out, "Exit status: 0 done, 1 failed, 2 wrong usage.");
    expect_has(mesh({"--version"}).out, ", CGAL ");
    expect_has(mesh({"-man"}).out, ".TH DEM2BUILDINGS_MESH 1");
    expect_has(mesh({"-bash_completion"}).out, "-ground|--ground) COMPREPLY=($(compgen -f");
    city(two_boxes());
    expect_has(mesh(to_obj).out, "buildings                 2\n");
    EXPECT_EQ(mesh({"-q", "-overwrite", "in.city.json", "out.obj"}).out, "");
}

}  // namespace
}  // namespace d2b::test
