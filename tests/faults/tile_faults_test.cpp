#include <algorithm>
#include <fstream>
#include <ostream>
#include <unistd.h>

#include "faults/old_or_new.hpp"

namespace d2b::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

/// Destination of the steps of a run in tiles.
struct TileDestination {
    const char* what;
    const char* name;
    std::vector<std::string> options;
    std::vector<Arguments> steps;  ///< after plan

    friend void PrintTo(const TileDestination& destination, std::ostream* out) { *out << destination.what; }
};

/// Fails calls that change a file or a folder in every step: the old files stay as they were, and the same
/// command does the rest.
class TileFaults : public FaultyTest, public testing::WithParamInterface<TileDestination> {
  protected:
    void SetUp() override {
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
        FaultyTest::SetUp();
        fs::create_directories(beside_);
        fs::rename(path("small.tif"), beside_ / "dem.tif");
        fs::remove(path("dem.tif"));
    }
    void TearDown() override {
        fs::remove_all(beside_);
        FaultyTest::TearDown();
    }
    [[nodiscard]] ToolResult step_with(const std::string& fault, const Arguments& step) const {
        Arguments command{D2B_TILES_TOOL};
        command.insert(command.end(), step.begin(), step.end());
        ToolSetup setup;
        if (!fault.empty())
            setup.environment = failing(fault, folder_.string(), counter());
        setup.environment.emplace_back("OGR_CURRENT_DATE=2026-01-01T00:00:00Z");
        setup.working_directory = folder_.string();
        return run_tool(command, setup);
    }
    [[nodiscard]] std::string counter() const { return (beside_ / "calls").string(); }
    /// All files that are not hidden, with their bytes.
    [[nodiscard]] Files files() const {
        Files found;
        for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
            const std::string name = fs::relative(entry.path(), folder_).string();
            if (entry.is_regular_file() && name.find("/.") == std::string::npos && !name.starts_with("."))
                found[name] = read_bytes(entry.path().string());
        }
        return found;
    }
    void restore(const fs::path& kept) const {
        for (const auto& entry : fs::directory_iterator(folder_))
            fs::remove_all(entry.path());
        fs::copy(kept, folder_, fs::copy_options::recursive);
    }
    /// Compares names, because the seconds of stages differ from run to run.
    static std::vector<std::string> names_of(const Files& files) {
        std::vector<std::string> names;
        for (const auto& [name, bytes] : files)
            names.push_back(name);
        return names;
    }
    void expect_nothing_lost(const Files& before) const {
        const Files now = files();
        for (const auto& [name, bytes] : before) {
            const auto found = now.find(name);
            EXPECT_TRUE(found != now.end() && found->second == bytes) << name;
        }
    }
    void try_step(const Arguments& step) {
        const fs::path kept = beside_ / "kept";
        fs::remove_all(kept);
        fs::copy(folder_, kept, fs::copy_options::recursive);
        const Files before = files();
        const ToolResult good = step_with("change:0:EIO", step);
        ASSERT_EQ(good.status, 0) << good.err;
        const std::vector<std::string> whole = names_of(files());
        long count = 0;
        std::ifstream(counter()) >> count;
        ASSERT_GT(count, 0);
        const long apart = calls_apart(count / 4);
        long first = 0;
        for (const std::string& error : std::vector<std::string>{"ENOSPC", "EIO-once"})
            for (long nth = 1 + first++ % apart; nth <= count; nth += apart) {
                SCOPED_TRACE(step[0] + ", " + error + " at call " + std::to_string(nth) + " of " +
                             std::to_string(count));
                restore(kept);
                const ToolResult result = step_with("change:" + std::to_string(nth) + ":" + error, step);
                ASSERT_TRUE(result.status == 0 || result.status == 1) << result.status << result.err;
                if (result.status == 1) {
                    ++failed_;
                    EXPECT_TRUE(result.err.starts_with("ERROR: ")) << result.err;
                    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
                    expect_nothing_lost(before);
                    const ToolResult again = step_with("", step);
                    EXPECT_EQ(again.status, 0) << result.err << again.err;
                }
                EXPECT_EQ(names_of(files()), whole);
            }
    }

    int failed_ = 0;
    const fs::path beside_ = testing::TempDir() + "d2b_tile_faults_" + std::to_string(::getpid());
};

TEST_P(TileFaults, losesNothingAndGoesOn) {
    const std::string source = (beside_ / "dem.tif").string();
    const TileDestination& destination = GetParam();
    Arguments plan{"plan", "-q", "-threads", "1"};
    plan.insert(plan.end(), destination.options.begin(), destination.options.end());
    plan.insert(plan.end(), {source, destination.name, "work"});
    try_step(plan);
    for (const Arguments& step : destination.steps)
        try_step(step);
    EXPECT_GT(failed_, static_cast<int>(3 * destination.steps.size()));
    // The last step has the result of one run.
    fs::create_directory(path("one"));
    Arguments whole{"-q"};
    const bool parts = std::string(destination.name) == "parts";
    if (parts)
        whole.insert(whole.end(), {"-f", "FlatGeobuf"});
    const std::string name = parts ? "one/parts" : "one/out.gpkg";
    whole.insert(whole.end(), {source, name});
    run_well(whole, {.environment = {"OGR_CURRENT_DATE=2026-01-01T00:00:00Z"}});
    const Files found = files();
    if (parts)
        for (const std::string& layer : std::vector<std::string>{"buildings", "contours"})
            EXPECT_TRUE(found.at("parts/" + layer + "/0.fgb") == found.at("one/parts/" + layer + ".fgb"));
    else
        EXPECT_TRUE(found.at("out.gpkg") == found.at("one/out.gpkg"));
}

INSTANTIATE_TEST_SUITE_P(All, TileFaults,
                         testing::Values(TileDestination{"AGeoPackageAndARaster",
                                                         "out.gpkg",
                                                         {"-write_height", "height.vrt"},
                                                         {{"find", "work", "0"},
                                                          {"join", "work"},
                                                          {"draw", "work", "0"},
                                                          {"merge", "-q", "work"}}},
                                         TileDestination{"Parts",
                                                         "parts",
                                                         {"-f", "FlatGeobuf"},
                                                         {{"find", "work", "0"},
                                                          {"join", "work"},
                                                          {"draw", "work", "0"},
                                                          {"merge", "-q", "work"},
                                                          {"write", "work", "0"}}}),
                         [](const auto& test) { return test.param.what; });

}  // namespace
}  // namespace d2b::test
