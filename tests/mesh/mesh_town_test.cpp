#include "mesh/mesh_tool.hpp"

namespace d2b::test {
namespace {

/// Tests from a raster to a mesh, with the files that the program itself writes.
class MeshTown : public MeshTool {
  protected:
    MeshTown() { preset_ = ""; }
    void make(const Arguments& arguments) const {
        const ToolResult made = run(arguments);
        ASSERT_EQ(made.status, 0) << made.err;
    }
    /// Checks the OBJ alone, by a program that shares no code with this one.
    /// @param reported angles below the bound in the mesher's own report
    void expect_forced_angles(std::size_t reported) const {
        ToolSetup setup;
        setup.working_directory = folder_.string();
        const ToolResult found =
            run_tool({"/usr/bin/python3", D2B_SAMPLES "/../tests/mesh/check_angles.py", "out.obj"}, setup);
        if (found.err.find("No module named") != std::string::npos)
            GTEST_SKIP() << "python3-numpy is missing";
        EXPECT_EQ(found.status, 0) << found.out << found.err;
        expect_has(found.out, " at sharp corners, ");
        expect_has(found.out, " beside them, 0 elsewhere");
        const std::string counts = found.out.substr(found.out.rfind(": ") + 2);
        EXPECT_EQ(std::stoul(counts) + std::stoul(counts.substr(counts.find(", ") + 2)), reported);
    }
    /// All angles, all edges; and none is smaller than the input makes it.
    void expect_good(const std::string& dem) const {
        make({"-q", "-split_height", "3", "-layers", "buildings", "-write_ground", "g.tif", "-surface",
              "in.city.json", dem, "out.gpkg"});
        for (const Arguments& more : {Arguments{}, Arguments{"-ground", "g.tif"}}) {
            Arguments arguments{"-overwrite", "in.city.json", "out.obj", "-json"};
            arguments.insert(arguments.begin(), more.begin(), more.end());
            const ToolResult result = mesh(arguments);
            ASSERT_EQ(result.status, 0) << result.err;
            const nlohmann::json report = nlohmann::json::parse(result.out);
            EXPECT_TRUE(read("out.obj").is_closed());
            EXPECT_EQ(report["separated_points"].size(), 0U);
            expect_forced_angles(report["small_angles"].size());
            if (more.empty()) {
                EXPECT_LE(report["plan_points"], 5 * report["footprint_points"].get<int>());
            }
        }
    }
};

TEST_F(MeshTown, ofTheSample) {
    expect_good(sample("town.tif"));
}

TEST_F(MeshTown, ofDelft) {
    const std::string dem = D2B_SHARED "/cities/delft/dsm.tif";
    if (!std::filesystem::exists(dem))
        GTEST_SKIP() << missing_shared(dem);
    expect_good(dem);
}

/// Roofs that leave very small angles (La Rochelle), and roofs that the terrain lifts above others
/// (Stuttgart).
TEST_F(MeshTown, ofSlantedRoofsOfPlaces) {
    for (const std::string place : {"larochelle_2m5", "stuttgart_csite2"}) {
        const std::string dem = D2B_SHARED "/cities/" + place + "/dsm.tif";
        if (!std::filesystem::exists(dem))
            GTEST_SKIP() << missing_shared(dem);
        make({"-q", "-overwrite", "-layers", "buildings", "-write_ground", "g.tif", "-surface_of", "roofs",
              "-surface", "in.city.json", dem, "out.gpkg"});
        for (const Arguments& more : {Arguments{}, Arguments{"-ground", "g.tif"}}) {
            Arguments arguments{"-q", "-overwrite", "in.city.json", "out.city.json"};
            arguments.insert(arguments.begin(), more.begin(), more.end());
            const ToolResult result = mesh(arguments);  // it refuses a mesh that is not closed
            EXPECT_EQ(result.status, 0) << place << result.err;
        }
    }
}

/// A mesh encloses as much as the solids that it is made of, and keeps their ridges, whatever points are
/// added.
TEST_F(MeshTown, ofSlantedRoofs) {
    make({"-q", "-te", "391100", "5820100", "391400", "5820400", "-layers", "buildings", "-write_ground",
          "g.tif", "-surface_of", "roofs", "-surface", "in.city.json", "-surface", "in.obj",
          sample("town.tif"), "out.gpkg"});
    const double volume = read("in.obj").volume();
    for (const Arguments& more : {Arguments{}, Arguments{"-max_edge", "5"}, Arguments{"-ground", "g.tif"}}) {
        Arguments arguments{"-overwrite", "in.city.json", "out.obj", "-json"};
        arguments.insert(arguments.begin(), more.begin(), more.end());
        const ToolResult result = mesh(arguments);
        ASSERT_EQ(result.status, 0) << result.err;
        const nlohmann::json report = nlohmann::json::parse(result.out);
        EXPECT_EQ(report["separated_points"].size(), 0U);
        EXPECT_TRUE(read("out.obj").is_closed());
        if (more.empty() || more.front() == "-max_edge") {
            EXPECT_NEAR(read("out.obj").volume(), volume, 1e-4 * volume);
        }
        if (!more.empty() && more.front() == "-max_edge") {
            EXPECT_LE(report["longest_edge_m"].get<double>(), 5);
        }
    }
}

TEST_F(MeshTown, asStl) {
    make({"-q", "-surface", "in.city.json", sample("town.tif"), "out.gpkg"});
    mesh_well({"in.city.json", "out.stl"});
    const std::string text = read_bytes(path("out.stl"));
    EXPECT_TRUE(text.starts_with("solid building_1 origin 391"));
    EXPECT_TRUE(text.ends_with("\n"));
}

}  // namespace
}  // namespace d2b::test
