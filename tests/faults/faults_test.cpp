#include <fstream>
#include <sys/mount.h>
#include <unistd.h>
#include <utility>

#include "faults/faulty_case.hpp"

namespace d2b::test {
namespace {

/// One call of many fails: the run fails with a sentence and leaves all as it was, or all is there.
class Faults : public FaultyTest {
  protected:
    void SetUp() override {
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
        FaultyTest::SetUp();
    }
    void TearDown() override {
        std::filesystem::remove_all(kept_);
        FaultyTest::TearDown();
    }
    ToolResult run_with(const std::string& fault, const std::string& files,
                        const Arguments& arguments) const {
        return run(arguments, {.environment = failing(fault, files, counter_)});
    }
    /// Calls that a run without a fault makes.
    long calls(const std::string& kind, const std::string& files, const Arguments& arguments) const {
        const ToolResult result = run_with(kind + ":0:EIO", files, arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        long count = 0;
        std::ifstream(counter_) >> count;
        std::filesystem::remove(counter_);
        return count;
    }
    void prepare(const std::string& destination, bool existing) {
        std::filesystem::remove_all(path(destination));
        if (!existing)
            return;
        constexpr auto whole = std::filesystem::copy_options::recursive;
        if (std::exchange(prepared_, destination) == destination) {
            std::filesystem::copy(kept_, path(destination), whole);
            return;
        }
        run_well({"-q", "-f", format_, "-layers", layers_, before_, destination});
        std::filesystem::remove_all(kept_);
        std::filesystem::copy(path(destination), kept_, whole);
    }
    /// Lets some of the calls fail, from the first to the last.
    void try_all(const std::string& kind, const std::string& destination, bool existing,
                 const std::string& files, const std::vector<std::string>& errors) {
        SCOPED_TRACE(kind + " " + destination + (existing ? " existing" : " new"));
        const Arguments arguments{"-q", mode_, "-f", format_, "-layers", layers_, "dem.tif", destination};
        prepare(destination, existing);
        const int old = features(destination);
        const long count = calls(kind, files, arguments);
        const int whole = features(destination);
        ASSERT_GT(count, 0);
        for (const std::string& error : errors)
            for (long k = 0, steps = std::min(steps_, std::max(count, 6L)); k < steps; ++k) {
                const long nth = 1 + k * (count - 1) / (steps - 1);
                SCOPED_TRACE(error + " at call " + std::to_string(nth) + " of " + std::to_string(count));
                prepare(destination, existing);
                const auto before = names();
                const ToolResult result =
                    run_with(kind + ":" + std::to_string(nth) + ":" + error, files, arguments);
                std::filesystem::remove(counter_);
                // Drivers do not tell a file that cannot be read on from one that nothing can be added to.
                const bool refused = result.status == 1 || (result.status == 2 && mode_ == "-append");
                ASSERT_TRUE(result.status == 0 || refused) << result.status << result.err;
                if (result.status == 0) {
                    EXPECT_EQ(features(destination), whole);
                    expect_ids_given_once(destination);
                    ++survived_;
                    continue;
                }
                EXPECT_NE(result.err.find("ERROR: "), std::string::npos);
                EXPECT_EQ(features(destination), old) << result.err;
                EXPECT_EQ(names(), before);
                ++failed_;
            }
    }
    /// The content of a layer, read before something is added to it, decides the next id.
    void expect_ids_given_once(const std::string& destination) const {
        if (format_ != "GPKG")
            return;
        EXPECT_EQ(sql_value(path(destination), "SELECT count(id) - count(DISTINCT id) FROM contours"), "0");
    }
    void use(const std::string& format, const std::string& layers = "both") {
        format_ = format;
        layers_ = layers;
    }

    long steps_ = 6;
    std::string before_ = "small.tif";  ///< whose result a destination holds
    int failed_ = 0;
    int survived_ = 0;
    std::string mode_ = "-overwrite";
    std::string format_ = "GPKG";
    std::string layers_ = "both";
    std::string prepared_;  ///< the destination of which there is a copy
    const std::string kept_ = testing::TempDir() + "d2b_kept_" + std::to_string(::getpid());
    const std::string counter_ = testing::TempDir() + "d2b_calls_" + std::to_string(::getpid());
};

TEST_F(Faults, writesOfANewGeoPackage) {
    try_all("write", "out.gpkg", false, "out.gpkg", {"EIO", "ENOSPC", "short"});
    EXPECT_GE(failed_, 2 * steps_ - 2);
}

TEST_F(Faults, writesOfAnExistingGeoPackage) {
    try_all("write", "out.gpkg", true, "out.gpkg", {"EIO", "ENOSPC", "short"});
    EXPECT_GE(failed_, 2 * steps_ - 4);
}

TEST_F(Faults, writesOfFilesThatHideThem) {
    use("GeoJSON", "buildings");
    try_all("write", "out.geojson", false, "out.geojson", {"ENOSPC", "short"});
    try_all("write", "out.geojson", true, "out.geojson", {"EIO"});
    use("FlatGeobuf", "buildings");
    try_all("write", "out.fgb", false, "out.fgb", {"ENOSPC", "short"});
    use("ESRI Shapefile");
    try_all("write", "shapes", false, "/shapes/", {"ENOSPC", "EIO"});
    try_all("write", "shapes", true, "/shapes/", {"ENOSPC"});
    EXPECT_GT(failed_, 5 * steps_);
}

TEST_F(Faults, syncs) {
    try_all("sync", "out.gpkg", false, "out.gpkg", {"EIO"});
    use("GeoJSON", "buildings");
    try_all("sync", "out.geojson", true, "out.geojson", {"EIO"});
    EXPECT_GE(failed_, 2 * steps_ - 2);
}

TEST_F(Faults, readsOfTheRaster) {
    try_all("read", "out.gpkg", false, "dem.tif", {"EIO", "short"});
    try_all("read", "out.gpkg", true, "dem.tif", {"EIO"});
    EXPECT_GT(failed_, steps_);
}

TEST_F(Faults, readsOfTheDestination) {
    try_all("read", "out.gpkg", true, "out.gpkg", {"EIO"});
    EXPECT_GT(failed_, 0);
}

TEST_F(Faults, readsOfADestinationToAppendTo) {
    mode_ = "-append";
    use("GPKG", "contours");
    before_ = "dem.tif";              // a layer of many pages, read one after another
    steps_ = 1000 / calls_apart(16);  // one of 1000 leaves the search for the largest id behind half way
    try_all("read", "out.gpkg", true, "out.gpkg", {"EIO-once"});
    EXPECT_GT(failed_, 0);
    steps_ = 6;
    use("GeoJSON", "buildings");
    try_all("read", "out.geojson", true, "out.geojson", {"EIO"});
    use("ESRI Shapefile");
    try_all("read", "shapes", true, "/shapes/", {"EIO"});
    EXPECT_GT(failed_, steps_);
}

TEST_F(Faults, aNetworkIsNotAskedForByItself) {
    // Between these systems PROJ would use a grid from its servers, had it a network.
    write_text(path("area.geojson"), R"({"type": "Polygon", "coordinates":
        [[[10, 40], [16, 40], [16, 60], [10, 60], [10, 40]]]})");
    EXPECT_EQ(
        calls("net", "", {"-q", "-a_srs", "EPSG:31468", "-t_srs", "EPSG:25832", "dem.tif", "moved.gpkg"}), 0);
    EXPECT_EQ(calls("net", "", {"-q", "-cutline", "area.geojson", "dem.tif", "cut.gpkg"}), 0);
    // The counter does count.
    const ToolResult named = run_with("net:0:EIO", "", {"-q", "/vsicurl/http://127.0.0.1:9/a.tif", "b.gpkg"});
    EXPECT_EQ(named.status, 1);
    long count = 0;
    std::ifstream(counter_) >> count;
    EXPECT_GT(count, 0);
}

/// A disk of its own, where root may make one.
TEST_F(Faults, aDiskThatIsFull) {
    const std::string disk = path("disk");
    std::filesystem::create_directory(disk);
    if (::mount("d2b", disk.c_str(), "tmpfs", 0, "size=24k") != 0)
        GTEST_SKIP() << "no disk can be mounted here";
    for (const char* name :
         {"disk/a.gpkg", "disk/a.geojson", "disk/a.fgb", "disk/shapes.shp", "disk/a.gml"}) {
        const ToolResult result = run({"-q", "-layers", "contours", "-lod", "8", "dem.tif", name});
        EXPECT_EQ(result.status, 1) << name;
        EXPECT_TRUE(result.err.starts_with("ERROR: Cannot write \"" + std::string(name) + "\": "))
            << result.err;
        EXPECT_TRUE(std::filesystem::is_empty(disk)) << name;
    }
    ::umount(disk.c_str());
}

}  // namespace
}  // namespace d2b::test
