#include <filesystem>
#include <fstream>

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
    /// Of steps beside a run of all at once, when all has been read over the network.
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

/// A window that is just too large to be looked at whole: it has four units, at whose corner the town lies.
/// All else of it is no data, and levels of the thesis need no ground: that keeps this to a few seconds.
TEST_F(TilesOverHttp, givesTheBytesOfOneRunInFourUnits) {
    std::ofstream(path("served/wide.vrt"))
        << R"(<VRTDataset rasterXSize="8200" rasterYSize="8200"><SRS>EPSG:25833</SRS>
<GeoTransform>387400,1,0,5824600,0,-1</GeoTransform>
<VRTRasterBand dataType="Float32" band="1"><NoDataValue>-9999</NoDataValue>
<SimpleSource><SourceFilename relativeToVRT="1">town.tif</SourceFilename>
<SrcRect xOff="0" yOff="0" xSize="1000" ySize="1000"/>
<DstRect xOff="3600" yOff="3600" xSize="1000" ySize="1000"/></SimpleSource>
</VRTRasterBand></VRTDataset>)";
    const ToolResult result = serve(
        "$one -q -preset thesis $url/wide.vrt one.gpkg\n"
        "$tiles plan -q -preset thesis $url/wide.vrt tiles.gpkg work\n"
        "$tiles find work 3\n"
        "$tiles find work 0 1 2\n"
        "if $tiles find work 4 2> refusal; then exit 1; fi\n"  // there are four
        "$tiles join work\n"
        "$tiles draw work 2 3\n"
        "$tiles draw work 0 1\n"
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
