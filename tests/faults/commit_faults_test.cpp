#include <set>
#include <unistd.h>

#include "faults/old_or_new.hpp"

namespace d2b::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

/// Runs that write several files, of which some cannot be renamed.
class CommitFaults : public FaultyTest, public testing::WithParamInterface<const char*> {
  protected:
    void SetUp() override {
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
        FaultyTest::SetUp();
    }
    void TearDown() override {
        fs::remove(counter_);
        FaultyTest::TearDown();
    }
    /// @param mode "" for new files
    [[nodiscard]] Arguments writing(const std::string& source, const std::string& mode = "") const {
        Arguments arguments{"-q",       "-layers",  "buildings", "-write_ground", "ground.tif", "-surface",
                            "city.glb", "-surface", "city.obj",  source,          destination_};
        if (!mode.empty())
            arguments.insert(arguments.begin(), mode);
        return arguments;
    }
    [[nodiscard]] ToolResult run_with(const std::string& fault, const Arguments& arguments) const {
        ToolSetup setup{.environment = failing(fault, folder_.string(), counter_)};
        setup.environment.emplace_back("OGR_CURRENT_DATE=2026-01-01T00:00:00Z");
        return run(arguments, setup);
    }
    /// Names in the order in which they are to show; the layers of a database show first.
    [[nodiscard]] std::vector<std::string> in_order(bool replaces) const {
        std::vector<std::string> names{"ground.tif", "city.glb", "city.obj"};
        const bool in_place = replaces && destination_ == "out.gpkg";
        names.insert(in_place ? names.begin() : names.end(), destination_);
        return names;
    }
    /// Of a database the number of its features, in which the old and the new content differ.
    [[nodiscard]] Files content() const {
        Files files;
        for (const std::string& name : in_order(false))
            if (fs::exists(path(name)))
                files[name] = name == "out.gpkg" ? std::to_string(features(name)) : read_bytes(path(name));
        return files;
    }
    void clear() const {
        for (const auto& entry : fs::directory_iterator(folder_))
            if (entry.path().extension() != ".tif" || entry.path().filename() == "ground.tif")
                fs::remove_all(entry.path());
    }
    [[nodiscard]] std::vector<std::string> hidden() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder_))
            if (entry.path().filename().string().starts_with(".dem2buildings."))
                found.push_back(entry.path().string());
        return found;
    }
    /// Files before a run, and its result.
    void prepare(bool replaces) {
        clear();
        if (replaces) {
            ASSERT_EQ(run_with("renames:0:EIO", writing("small.tif")).status, 0);
        }
        old_ = content();
        ASSERT_EQ(old_.size(), replaces ? 4U : 0U);
    }
    void remember_new() {
        clear();
        ASSERT_EQ(run_with("renames:0:EIO", writing("dem.tif")).status, 0);
        whole_ = content();
        ASSERT_EQ(whole_.size(), 4U);
    }

    const std::string destination_ = GetParam();
    const std::string counter_ = testing::TempDir() + "d2b_commit_calls_" + std::to_string(::getpid());
    Files old_;
    Files whole_;
};

/// Each file is whole, and those that show first are new.
TEST_P(CommitFaults, AKillBetweenTwoRenames) {
    remember_new();
    for (const bool replaces : {false, true}) {
        const std::vector<std::string> order = in_order(replaces);
        int status = 128 + SIGKILL;
        std::set<std::size_t> seen;
        for (int nth = 1; status != 0; ++nth) {
            prepare(replaces);
            status = run_with("renames:" + std::to_string(nth) + ":kill",
                              writing("dem.tif", replaces ? "-overwrite" : ""))
                         .status;
            ASSERT_TRUE(status == 0 || status == 128 + SIGKILL) << status;
            Files found = content();
            std::size_t shown = 0;
            while (shown < order.size() && found[order[shown]] == whole_.at(order[shown]))
                ++shown;
            for (std::size_t i = shown; i < order.size(); ++i)
                EXPECT_TRUE(found[order[i]] == (replaces ? old_.at(order[i]) : "")) << order[i] << " " << nth;
            seen.insert(shown);
            // Left-over files do not disturb the next run.
            run_well(writing("dem.tif", "-overwrite"));
        }
        // Each number of files that show, except that a database that is changed in place comes before the
        // first.
        EXPECT_EQ(seen.size(), replaces && destination_ == "out.gpkg" ? 4U : 5U);
    }
}

TEST_P(CommitFaults, ARenameThatFails) {
    remember_new();
    for (const bool replaces : {false, true})
        for (int nth = 1; nth < 20; ++nth) {
            prepare(replaces);
            const ToolResult result = run_with("renames:" + std::to_string(nth) + ":EIO-once",
                                               writing("dem.tif", replaces ? "-overwrite" : ""));
            EXPECT_TRUE(hidden().empty()) << nth;
            if (result.status == 0)
                break;
            EXPECT_EQ(result.status, 1) << nth;
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
            Files expected = old_;
            if (replaces && destination_ == "out.gpkg") {
                EXPECT_TRUE(result.err.ends_with("; \"out.gpkg\" has been changed already.\n")) << result.err;
                expected[destination_] = whole_.at(destination_);
            }
            EXPECT_TRUE(content() == expected) << nth << result.err;
            ASSERT_LT(nth, 19);
        }
}

/// Renamed files cannot be taken back where nothing can be renamed any more.
TEST_P(CommitFaults, RenamesThatFailForEver) {
    prepare(true);
    // Where the file of the layers is renamed, too, it comes last.
    const ToolResult result = run_with("renames:3:EIO", writing("dem.tif", "-overwrite"));
    EXPECT_EQ(result.status, 1);
    const std::vector<std::string> folders = hidden();
    ASSERT_EQ(folders.size(), 2U) << result.err;
    Files kept;
    for (const std::string& folder : folders) {
        EXPECT_NE(result.err.find(fs::path(folder).filename().string() + "\" now"), std::string::npos)
            << result.err;
        kept.merge(files_of(folder));
    }
    EXPECT_EQ(kept.size(), 2U);
    EXPECT_TRUE(kept["ground.tif"] == old_.at("ground.tif"));
    EXPECT_TRUE(kept["city.glb"] == old_.at("city.glb"));
    EXPECT_TRUE(content().at("city.obj") == old_.at("city.obj"));
}

/// A reader of stdout finds the files that a report tells of.
TEST_P(CommitFaults, NothingIsToldOfARunThatFails) {
    for (const bool replaces : {false, true}) {
        prepare(replaces);
        Arguments arguments = writing("dem.tif", replaces ? "-overwrite" : "");
        arguments.insert(arguments.begin(), "-json");
        const ToolResult result = run_with("renames:2:EIO-once", arguments);
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.out, "");
    }
    clear();
    const Arguments to_stdout{"-f",       "GeoJSON",  "-layers", "buildings",
                              "-surface", "city.glb", "dem.tif", "/vsistdout/"};
    const ToolResult result = run_with("renames:1:EIO-once", to_stdout);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(content().empty());
    const ToolResult good = run(to_stdout);
    EXPECT_EQ(good.status, 0);
    EXPECT_TRUE(good.out.starts_with("{")) << good.out;
    EXPECT_EQ(content().size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(All, CommitFaults, testing::Values("out.gpkg", "out.fgb"),
                         [](const auto& test) { return std::string(test.param).substr(4); });

}  // namespace
}  // namespace d2b::test
