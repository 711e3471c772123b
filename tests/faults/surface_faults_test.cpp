#include <chrono>
#include <fstream>
#include <random>
#include <sys/mount.h>
#include <unistd.h>

#include "faults/old_or_new.hpp"

namespace d2b::test {
namespace {

using std::chrono::milliseconds;
namespace fs = std::filesystem;

/// Files of surfaces and pages on disks that fail, and of runs that are killed.
class SurfaceFaults : public FaultyTest {
  protected:
    /// A run that replaces files. @param source with its result for the layers beside it
    static Arguments writing(const std::string& source) {
        Arguments arguments{"-q", "-overwrite"};
        for (const std::string& name : names)
            if (name == asked_for(name))
                arguments.insert(arguments.end(), {option_of(name), name});
        arguments.insert(arguments.end(), {source, "out.gpkg"});
        return arguments;
    }
    /// The file that a run is asked for which writes another one: the materials of an OBJ come with it.
    static std::string asked_for(const std::string& name) { return name == "city.mtl" ? "city.obj" : name; }
    static std::string option_of(const std::string& name) {
        return name.ends_with(".html") ? "-page" : "-surface";
    }
    /// Bytes of the surfaces that are there, by their names.
    [[nodiscard]] std::map<std::string, std::string> surfaces() const {
        std::map<std::string, std::string> found;
        for (const std::string& name : names)
            if (fs::exists(path(name)))
                found[name] = read_bytes(path(name));
        return found;
    }
    void clear() const {
        for (const auto& entry : fs::directory_iterator(folder_))
            if (entry.path().extension() != ".tif")
                fs::remove_all(entry.path());
    }
    static const std::vector<std::string> names;
};

const std::vector<std::string> SurfaceFaults::names{"city.city.json", "city.glb",
#ifdef D2B_PAGE
                                                    "city.html",
#endif
                                                    "city.mtl",       "city.obj", "city.stl"};

/// At any moment each is as it was, or as it is to be.
TEST_F(SurfaceFaults, aKilledRunLeavesEachWhole) {
    const auto start = std::chrono::steady_clock::now();
    run_well(writing("dem.tif"));
    const auto whole = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
    const auto finished = surfaces();
    ASSERT_EQ(finished.size(), names.size());
    run_well(writing("small.tif"));
    const auto old = surfaces();
    std::mt19937 random(3);
    int killed = 0;
    for (int i = 0; i < 12; ++i) {
        clear();
        const bool replaces = i % 2 == 0;
        if (replaces)
            run_well(writing("small.tif"));
        const int status =
            run(writing("dem.tif"), {.kill = Kill{SIGKILL, whole * (200 + random() % 800) / 1000}}).status;
        killed += status == 128 + SIGKILL ? 1 : 0;
        const auto found = surfaces();
        for (const std::string& name : names) {
            const auto here = found.find(name);
            const bool is_new = here != found.end() && here->second == finished.at(name);
            const bool is_old =
                replaces ? here != found.end() && here->second == old.at(name) : here == found.end();
            EXPECT_TRUE(is_new || (is_old && status != 0)) << name << " " << status;
        }
    }
    EXPECT_GT(killed, 2);
    run_well(writing("dem.tif"));
    EXPECT_EQ(surfaces(), finished);
}

/// Some of the writes of each file fail, and the old one stays.
TEST_F(SurfaceFaults, aWriteThatFailsLeavesTheOld) {
    if (D2B_SANITIZED != 0)
        GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
    run_well(writing("small.tif"));
    const auto old = surfaces();
    const std::string layers = read_bytes(path("out.gpkg"));
    const std::string counter = testing::TempDir() + "d2b_surface_calls_" + std::to_string(::getpid());
    for (const std::string& name : names)
        for (const std::string kind : {"write", "sync"}) {
            const std::string error = kind == "sync" ? "EIO" : "ENOSPC";
            const ToolResult result =
                run({"-q", "-overwrite", option_of(name), asked_for(name), "dem.tif", "out.gpkg"},
                    {.environment = failing(kind + ":1:" + error, name, counter)});
            EXPECT_EQ(result.status, 1) << name << " " << kind;
            EXPECT_TRUE(result.err.starts_with("ERROR: ")) << result.err;
            EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
            EXPECT_EQ(surfaces(), old) << name << " " << kind;
            EXPECT_EQ(read_bytes(path("out.gpkg")), layers);
        }
    fs::remove(counter);
}

/// A disk of its own, where root may make one.
TEST_F(SurfaceFaults, aDiskThatIsFull) {
    const std::string disk = path("disk");
    fs::create_directory(disk);
    if (::mount("d2b", disk.c_str(), "tmpfs", 0, "size=24k") != 0)
        GTEST_SKIP() << "no disk can be mounted here";
    for (const std::string& name : names) {
        const std::string place = "disk/" + asked_for(name);
        const ToolResult result = run({"-q", option_of(name), place, "dem.tif", "out.gpkg"});
        EXPECT_EQ(result.status, 1) << name;
        EXPECT_TRUE(result.err.starts_with("ERROR: Cannot write \"" + place + "\": ")) << result.err;
        EXPECT_TRUE(fs::is_empty(disk)) << name;
        EXPECT_FALSE(fs::exists(path("out.gpkg")));
    }
    ::umount(disk.c_str());
}

}  // namespace
}  // namespace d2b::test
