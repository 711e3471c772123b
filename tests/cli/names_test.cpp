#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

/// Names that are not UTF-8, as archives of another time unpack: "Gebäude" in Latin-1.
class WrittenNames : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path(dem_), blocks());
    }
    /// All bytes of all files in the folder but the DEM, and the files' own names.
    [[nodiscard]] std::string written() const {
        std::string bytes;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
            if (entry.is_regular_file() && entry.path().filename() != dem_)
                bytes += read_bytes(entry.path().string());
        return bytes;
    }
    void expect_text(const std::string& of) const {
        const std::string bytes = written();
        EXPECT_NE(bytes.find(readable_), std::string::npos) << of;
        EXPECT_EQ(bytes.find(raw_), std::string::npos) << of;
    }

    const std::string raw_ = "Geb\xE4ude";
    const std::string readable_ = "Geb\xEF\xBF\xBDude";
    const std::string dem_ = raw_ + ".tif";
};

TEST_F(WrittenNames, areTextInEveryFormat) {
    for (const char* extension : {".gpkg", ".sqlite", ".geojson", ".fgb", ".kml", ".jml", ".gml"}) {
        SCOPED_TRACE(extension);
        const std::string file = raw_ + extension;
        // An element of XML cannot have the name.
        const Arguments named = file.ends_with(".gml") ? Arguments{} : Arguments{"-nln", raw_};
        Arguments arguments{"-q", "-layers", "buildings", dem_, file};
        arguments.insert(arguments.begin() + 1, named.begin(), named.end());
        run_well(arguments);
        EXPECT_EQ(written().find(raw_), std::string::npos);
        ASSERT_FALSE(layer_names(path(file)).empty());
        EXPECT_FALSE(layer(file, layer_names(path(file)).front()).records.empty());
        for (const std::string& name : entries())
            if (name != dem_)
                std::filesystem::remove(path(name));
    }
}

TEST_F(WrittenNames, ofFilesAreTextBesideThem) {
    run_well({"-q", "-surface", "town.obj", "-surface", raw_ + ".glb", "-surface", raw_ + ".city.json",
              "-preview", raw_ + ".svg", dem_, raw_ + ".gpkg"});
    for (const char* extension : {".glb", ".city.json", ".svg", ".gpkg"})
        EXPECT_TRUE(std::filesystem::exists(path(raw_ + extension))) << extension;
    expect_text("what is written beside");
}

TEST_F(WrittenNames, ofASingleShapefileKeepTheirBytes) {
    run_well({"-q", "-layers", "buildings", dem_, raw_ + ".shp"});
    for (const char* extension : {".shp", ".dbf", ".qml"})
        EXPECT_TRUE(std::filesystem::exists(path(raw_ + extension))) << extension;
}

TEST_F(WrittenNames, inOptionsOfFormatsAreText) {
    std::filesystem::create_directory(path(raw_));
    run_well({"-q", "-lco", "TEMPORARY_DIR=" + path(raw_), "-layers", "buildings", dem_, "town.fgb"});
    run_well({"-q", "-lco", "IDENTIFIER=" + raw_, "-lco", "DESCRIPTION=" + raw_, "-layers", "buildings", dem_,
              "town.gpkg"});
    expect_text("-lco");
}

TEST_F(WrittenNames, inFieldsOfParcelsAreText) {
    write_text(path("parcels.csv"), "name,WKT\n\"" + raw_ +
                                        "\",\"POLYGON ((391000 5820000,391030 5820000,391030 5819980,391000 "
                                        "5819980,391000 5820000))\"\n");
    const ToolResult result =
        run({"-q", "-preset", "buildings", "-ground", "none", "-min_height", "3", "-min_area", "10",
             "-split_by", "parcels.csv", "-split_field", "name", dem_, "town.gpkg"});
    EXPECT_EQ(result.status, 0) << result.err;
    std::filesystem::remove(path("parcels.csv"));
    expect_text("-split_field");
}

TEST_F(WrittenNames, ofLayersAreFoundAgain) {
    run_well({"-q", "-nln", raw_, dem_, "town.gpkg"});
    run_well({"-q", "-nln", raw_, "-append", dem_, "town.gpkg"});
    const std::size_t twice = layer("town.gpkg", readable_).records.size();
    run_well({"-q", "-nln", raw_, "-overwrite", dem_, "town.gpkg"});
    EXPECT_EQ(2 * layer("town.gpkg", readable_).records.size(), twice);
}

}  // namespace
}  // namespace d2b::test
