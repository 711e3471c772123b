#include <cstdlib>
#include <map>

#include <gdal.h>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

using Metadata = std::map<std::string, std::string>;

/// What a result says of itself.
class Repeat : public CliTest {
  protected:
    /// @param layer of it; nullptr for the file as a whole
    [[nodiscard]] Metadata metadata_of(const std::string& file, const char* layer = nullptr) const {
        const GDALDatasetH dataset = GDALOpenEx(path(file).c_str(), 0, nullptr, nullptr, nullptr);
        Metadata metadata;
        const GDALMajorObjectH object =
            layer == nullptr ? dataset : GDALDatasetGetLayerByName(dataset, layer);
        for (CSLConstList item = GDALGetMetadata(object, nullptr); item != nullptr && *item != nullptr;
             ++item) {
            const std::string text = *item;
            metadata[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
        }
        GDALClose(dataset);
        return metadata;
    }
    /// Has a shell run what a result says.
    void repeat(const std::string& file, const std::string& again) const {
        const Metadata said = metadata_of(file);
        const std::string command = D2B_TOOL " -q " + said.at("D2B_OPTIONS") + " -- \"$0\" \"$1\"";
        const ToolResult result = run_tool({"/bin/sh", "-c", command, said.at("D2B_SOURCE"), again},
                                           {.environment = {dated}, .working_directory = folder_.string()});
        EXPECT_EQ(result.status, 0) << result.err;
    }
    static constexpr const char* dated = "OGR_CURRENT_DATE=2001-02-03T04:05:06Z";
};

TEST_F(Repeat, whatAResultSaysMakesItAgainByteForByte) {
    write(path("bob's blocks.tif"), blocks());
    run_well({"-q",
              "-srcwin",
              "0",
              "0",
              "24",
              "20",
              "-snodata",
              "6",
              "-fl",
              "5",
              "15",
              "-nf",
              "0",
              "-nln",
              "bob's roofs",
              "-3d",
              "-lco",
              "DESCRIPTION=a $HOME; `b` \"c\" \\d",
              "-write_rejected",
              "bob's blocks.tif",
              "out.gpkg"},
             {.environment = {dated}});
    EXPECT_EQ(metadata_of("out.gpkg").at("D2B_OPTIONS"),
              "-snodata 6 -srcwin 0 0 24 20 -preset thesis -fl 5 15 -nf 0 -3d -lco 'DESCRIPTION=a $HOME; `b` "
              "\"c\" \\d' -nln 'bob'\\''s roofs' -write_rejected");
    repeat("out.gpkg", "again.gpkg");
    EXPECT_EQ(read_bytes(path("again.gpkg")), read_bytes(path("out.gpkg")));
}

TEST_F(Repeat, rastersBesideTheLayersSayItToo) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    run_well(
        {"-q", "-preset", "buildings", "-min_height", "2", "-write_height", "h.tif", "town.tif", "out.gpkg"});
    EXPECT_EQ(metadata_of("h.tif").at("D2B_OPTIONS"), "-preset buildings -min_height 2");
}

TEST_F(Repeat, nothingIsLeftOfWhatIsReplaced) {
    write(path("blocks.tif"), blocks());
    run_well({"-q", "-lod", "3", "-min_area", "2", "blocks.tif", "out.gpkg"});
    EXPECT_EQ(metadata_of("out.gpkg").at("D2B_LOD"), "3");
    run_well({"-q", "-overwrite", "-fl", "5", "blocks.tif", "out.gpkg"});
    const Metadata said = metadata_of("out.gpkg", "buildings");
    EXPECT_FALSE(said.contains("D2B_LOD"));
    EXPECT_EQ(said.at("D2B_OPTIONS"), "-preset thesis -fl 5");
    EXPECT_EQ(said.at("D2B_MIN_AREA_M2"), "0");
}

}  // namespace
}  // namespace d2b::test
