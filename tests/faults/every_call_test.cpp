#include <algorithm>
#include <fstream>
#include <ostream>
#include <unistd.h>

#include "faults/old_or_new.hpp"

namespace d2b::test {
namespace {

using Files = std::map<std::string, std::string>;
namespace fs = std::filesystem;

/// A destination, and its state before the run.
struct Destination {
    const char* what;
    const char* name;
    const char* format;
    const char* layers;
    const char* mode;         ///< "new", "-overwrite" or "-append"
    bool has_others = false;  ///< files beside it

    friend void PrintTo(const Destination& destination, std::ostream* out) { *out << destination.what; }
};

/// Fails every call that changes a file or a folder in turn: afterwards there are the files from
/// before, or all new ones, and the status says which.
class EveryCall : public FaultyTest, public testing::WithParamInterface<Destination> {
  protected:
    void SetUp() override {
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
        FaultyTest::SetUp();
        write(input_ + "/new.tif", few_buildings(0));
        write(input_ + "/old.tif", few_buildings(2));
        for (const char* name : {"dem.tif", "small.tif"})
            fs::remove(path(name));
    }
    void TearDown() override {
        fs::remove_all(input_);
        FaultyTest::TearDown();
    }
    /// Three buildings, or two lower ones.
    static RasterSpec few_buildings(int lower) {
        RasterSpec spec = blocks();
        spec.rows = 40;
        spec.cols = 50;
        spec.values.assign(40UL * 50UL, 0);
        for (int row = 4; row < 34; ++row)
            for (int col = 4; col < 46; ++col)
                if (row % 18 < 12 && row % 18 > 3 && col % 20 > 3 && col % 20 < 17 &&
                    (lower == 0 || row < 18 || col < 20))
                    spec.values[static_cast<std::size_t>(row * 50 + col)] = 9 + col / 20 - lower;
        return spec;
    }
    [[nodiscard]] std::vector<std::string> errors() const {
        if (step_ > 1)
            return {"ENOSPC-once", "EIO", "EDQUOT", "short"};
        return {"ENOSPC", "EIO", "EDQUOT", "EIO-once", "ENOSPC-once", "short", "short-ENOSPC"};
    }

    [[nodiscard]] ToolResult run_with(const std::string& fault, const Arguments& arguments) const {
        ToolSetup setup{.environment = failing(fault, folder_.string(), input_ + "/calls")};
        setup.environment.emplace_back("OGR_CURRENT_DATE=2026-01-01T00:00:00Z");
        return run(arguments, setup);
    }
    /// The layers as they are read, or the files where that is the same.
    [[nodiscard]] Files layers() const {
        if (destination_ == "out.gpkg")
            return {{destination_, database_content(path(destination_))}};
        return files_of(destination_ == "shapes" ? path(destination_) : folder_.string());
    }
    [[nodiscard]] Files content() const {
        Files all = layers();
        for (const std::string& name : others())
            if (fs::exists(path(name)))
                all[name] = read_bytes(path(name));
        return all;
    }
    /// Files beside the layers.
    [[nodiscard]] std::vector<std::string> others() const {
        if (!GetParam().has_others)
            return {};
        return {"ground.tif", "city.glb", "city.city.json", "map.png"};
    }
    [[nodiscard]] Arguments options_of_others() const {
        if (!GetParam().has_others)
            return {};
        return {"-write_ground",  "ground.tif", "-surface", "city.glb", "-surface",
                "city.city.json", "-preview",   "map.png",  "-zunit",   "m"};
    }
    void prepare() const {
        for (const auto& entry : fs::directory_iterator(folder_))
            fs::remove_all(entry.path());
        if (fs::exists(input_ + "/kept"))
            fs::copy(input_ + "/kept", folder_, fs::copy_options::recursive);
    }
    /// The result of a run before, and in a database something of the user's.
    void keep_old() const {
        Arguments arguments = options_of_others();
        arguments.insert(arguments.end(),
                         {"-q", "-f", format_, "-layers", layers_, input_ + "/old.tif", destination_});
        run_well(arguments);
        if (destination_ == "out.gpkg")
            run_sql(
                path(destination_),
                "CREATE TABLE mine (note); INSERT INTO mine VALUES ('my own'); CREATE VIEW tall AS SELECT "
                "fid, height FROM buildings WHERE height > 5");
        fs::copy(folder_, input_ + "/kept", fs::copy_options::recursive);
    }
    [[nodiscard]] std::vector<std::string> hidden() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder_))
            if (entry.path().filename().string().starts_with("."))
                found.push_back(entry.path().string());
        return found;
    }
    /// Where the disk takes no name any more, a set of files is neither here nor there, but none of it is
    /// lost.
    [[nodiscard]] bool lies_aside(const Files& old, const std::string& said) const {
        const bool several = destination_ == "out.shp" || GetParam().has_others;
        if (!several || said.find("the finished result cannot be renamed (") == std::string::npos)
            return false;
        Files found = files_of(folder_);
        found.merge(layers());
        for (const std::string& folder : hidden())
            found.merge(files_of(folder));
        return std::all_of(old.begin(), old.end(),
                           [&](const auto& file) { return found.contains(file.first); });
    }
    /// A transaction is committed before files are renamed, and cannot be taken back.
    [[nodiscard]] bool has_new_layers_alone(Files found, const Files& old, const Files& whole) const {
        const bool is_new = found[destination_] == whole.at(destination_);
        found[destination_] = old.at(destination_);
        return is_new && found == old;
    }
    void check(const ToolResult& result, const std::string& error, const Files& old,
               const Files& whole) const {
        ASSERT_TRUE(result.status == 0 || result.status == 1 || (result.status == 2 && mode_ == "-append"))
            << result.status << result.err;
        const Files found = content();
        if (result.status == 0) {
            EXPECT_TRUE(found == whole) << "status 0, but not all is there";
        } else {
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
            EXPECT_TRUE(result.err.starts_with("ERROR: ")) << result.err;
            const bool changed =
                result.err.find("\"out.gpkg\" has been changed already") != std::string::npos;
            EXPECT_TRUE(found == old || lies_aside(old, result.err) ||
                        (changed && has_new_layers_alone(found, old, whole)))
                << result.err;
            if (destination_ == "out.gpkg" && fs::exists(input_ + "/kept") && !changed) {
                EXPECT_TRUE(read_bytes(path(destination_)) == read_bytes(input_ + "/kept/out.gpkg"))
                    << result.err;
            }
        }
        // A disk that removes nothing keeps the hidden folder, too.
        if (!error.starts_with("EIO") && result.err.find("old files of \"") == std::string::npos) {
            EXPECT_TRUE(hidden().empty()) << hidden().front() << result.err;
        }
    }
    void try_all() {
        SCOPED_TRACE(destination_ + " " + mode_);
        prepare();
        if (mode_ != "new")
            keep_old();
        const Files old = content();
        Arguments arguments{"-q",    "-threads",          "1",         "-f", format_, "-layers",
                            layers_, input_ + "/new.tif", destination_};
        const Arguments others = options_of_others();
        arguments.insert(arguments.begin(), others.begin(), others.end());
        if (mode_ != "new")
            arguments.insert(arguments.begin(), mode_);
        const ToolResult good = run_with("change:0:EIO", arguments);
        ASSERT_EQ(good.status, 0) << good.err;
        const Files whole = content();
        ASSERT_FALSE(whole == old);
        long count = 0;
        std::ifstream(input_ + "/calls") >> count;
        ASSERT_GT(count, 20);
        long first = 0;
        for (const std::string& error : errors())
            for (long nth = 1 + first++ * 3 % step_; nth <= count; nth += step_) {
                SCOPED_TRACE(error + " at call " + std::to_string(nth) + " of " + std::to_string(count));
                prepare();
                const ToolResult result = run_with("change:" + std::to_string(nth) + ":" + error, arguments);
                check(result, error, old, whole);
                failed_ += result.status == 0 ? 0 : 1;
            }
        RecordProperty("failed", failed_);
        EXPECT_GT(failed_, count / step_);
    }

    const std::string destination_ = GetParam().name;
    const std::string format_ = GetParam().format;
    const std::string layers_ = GetParam().layers;
    const std::string mode_ = GetParam().mode;
    const long step_ = calls_apart(30);
    int failed_ = 0;
    const std::string input_ = [] {
        const std::string folder = testing::TempDir() + "d2b_every_call_" + std::to_string(::getpid());
        fs::create_directory(folder);
        return folder;
    }();
};

TEST_P(EveryCall, failsWithoutALoss) {
    try_all();
}

INSTANTIATE_TEST_SUITE_P(
    All, EveryCall,
    testing::Values(
        Destination{"NewGeoPackage", "out.gpkg", "GPKG", "both", "new"},
        Destination{"LayersOfAGeoPackageReplaced", "out.gpkg", "GPKG", "both", "-overwrite"},
        Destination{"GeoPackageAddedTo", "out.gpkg", "GPKG", "both", "-append"},
        Destination{"NewFolderOfShapefiles", "shapes", "ESRI Shapefile", "both", "new"},
        Destination{"FolderOfShapefilesReplaced", "shapes", "ESRI Shapefile", "both", "-overwrite"},
        Destination{"FolderOfShapefilesAddedTo", "shapes", "ESRI Shapefile", "both", "-append"},
        Destination{"NewShapefile", "out.shp", "ESRI Shapefile", "buildings", "new"},
        Destination{"ShapefileReplaced", "out.shp", "ESRI Shapefile", "buildings", "-overwrite"},
        Destination{"ShapefileAddedTo", "out.shp", "ESRI Shapefile", "buildings", "-append"},
        Destination{"NewFlatGeobuf", "out.fgb", "FlatGeobuf", "buildings", "new"},
        Destination{"FlatGeobufReplaced", "out.fgb", "FlatGeobuf", "buildings", "-overwrite"},
        Destination{"NewGeoPackageAndOthers", "out.gpkg", "GPKG", "both", "new", true},
        Destination{"GeoPackageAndOthersReplaced", "out.gpkg", "GPKG", "both", "-overwrite", true},
        Destination{"ShapefileAndOthersReplaced", "out.shp", "ESRI Shapefile", "buildings", "-overwrite",
                    true},
        Destination{"FolderAndOthersReplaced", "shapes", "ESRI Shapefile", "both", "-overwrite", true}),
    [](const auto& test) { return test.param.what; });

}  // namespace
}  // namespace d2b::test
