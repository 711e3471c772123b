#include <filesystem>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

/// The steps of a run in tiles, where the source is on a server.
class TilesOverHttp : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        if (!std::filesystem::exists(python))
            GTEST_SKIP() << python << " is missing; Debian's package is python3";
        std::filesystem::create_directory(path("served"));
        std::filesystem::copy(sample("town.tif"), path("served/town.tif"));
    }
    /// Runs lines of the shell while the folder `served` is at $url, with the tools as $one and $tiles.
    [[nodiscard]] ToolResult serve(const std::string& lines) const {
        const std::string begin = "set -e\nurl=/vsicurl/{url}\none=" D2B_TOOL "\ntiles=" D2B_TILES_TOOL "\n";
        ToolSetup setup;
        setup.working_directory = folder_.string();
        setup.environment = {"OGR_CURRENT_DATE=2001-02-03T04:05:06.000Z"};
        return run_tool(
            {python, D2B_SAMPLES "/../tests/cli/serve.py", "served", "/bin/sh", "-c", begin + lines}, setup);
    }
    /// Compares steps with a run of all at once, when all has been read over the network.
    void expect_one_run(const ToolResult& result) {
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_TRUE(result.err.ends_with(" ranges of bytes\n")) << result.err;
        EXPECT_GT(std::stoi(result.err), 0) << result.err;  // the first and the only line
        EXPECT_TRUE(read_bytes(path("tiles.gpkg")) == read_bytes(path("one.gpkg")));
    }

    static constexpr const char* python = "/usr/bin/python3";
};

TEST_F(TilesOverHttp, givesTheBytesOfOneRun) {
    const ToolResult result = serve(
        "$one -q $url/town.tif one.gpkg\n"
        "$tiles plan -q $url/town.tif tiles.gpkg work\n"
        "$tiles find work 0\n"
        "$tiles join work\n"
        "$tiles draw work 0\n"
        "$tiles merge -q work\n");
    expect_one_run(result);
}

TEST_F(TilesOverHttp, refusesASourceThatHasChanged) {
    const ToolResult result = serve(
        "$tiles plan -q $url/town.tif tiles.gpkg work\n"
        "touch -d 2001-02-03 served/town.tif\n"
        "$tiles find work 0\n");
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("/town.tif' has changed since the plan was made"), std::string::npos)
        << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("work/find/0")));
}

TEST_F(TilesOverHttp, saysThatTheServerIsGone) {
    ASSERT_EQ(serve("$tiles plan -q $url/town.tif tiles.gpkg work\n").status, 0);
    const ToolResult result = serve("$tiles find work 0\n");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(result.err.starts_with("ERROR: '/vsicurl/http://127.0.0.1:")) << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("work/find/0")));
}

}  // namespace
}  // namespace d2b::test
