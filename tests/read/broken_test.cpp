#include <cpl_vsi.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

class ReadBroken : public ReadTest {
  protected:
    /// Cuts a file down to a share of its bytes.
    void cut(const std::string& name, double share) {
        const std::string bytes = read_bytes(path(name));
        write_text(path(name),
                   bytes.substr(0, static_cast<std::size_t>(static_cast<double>(bytes.size()) * share)));
    }
    static RasterSpec large() {
        return {.cols = 300, .rows = 300, .type = GDT_Float32, .values = counting(90000, 1)};
    }
};

TEST_F(ReadBroken, aMissingFile) {
    for (const std::string& name : {path("none.tif"), std::string("no_such_folder/none.tif")}) {
        options_.source = name;
        EXPECT_EQ(message<InputError>(),
                  "'" + name + "' cannot be opened as a raster: No such file or directory.");
    }
}

TEST_F(ReadBroken, aFileOfAnotherKind) {
    write_text(path("dem.tif"), "not a raster");
    expect_has(message<InputError>("dem.tif"), "supported file format.");
}

TEST_F(ReadBroken, aTiffWithoutItsDirectory) {
    write(path("dem.tif"), large());
    write_text(path("dem.tif"), read_bytes(path("dem.tif")).substr(0, 20));
    expect_has(message<InputError>("dem.tif"), "' cannot be opened as a raster: ");
}

TEST_F(ReadBroken, aTruncatedTiff) {
    for (const std::vector<std::string>& creation : std::vector<std::vector<std::string>>{
             {}, {"COMPRESS=DEFLATE"}, {"COMPRESS=LZW", "TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64"}}) {
        RasterSpec spec = large();
        spec.creation = creation;
        write(path("dem.tif"), spec);
        cut("dem.tif", 0.6);
        const std::string text = message<InputError>("dem.tif");
        expect_has(text, "of '" + path("dem.tif") + "' cannot be read: ");
        expect_has(text, "IReadBlock failed");
        expect_has(text, "; the file may be truncated or damaged.");
    }
}

TEST_F(ReadBroken, theRowsBeforeTheEndAreReadAndTheRestNamed) {
    RasterSpec spec = large();
    spec.creation = {"BLOCKYSIZE=10"};
    write(path("dem.tif"), spec);
    cut("dem.tif", 0.6);
    const std::unique_ptr<DemSource> source = open("dem.tif");
    std::vector<double> rows(3000);
    source->read(whole_rows(*source, 100, 10), rows);
    expect_values(rows, counting(3000, 30001));
    try {
        source->read(whole_rows(*source, 200, 10), rows);
        FAIL() << "no exception";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what())
                      .rfind("Rows 200 to 209 of '" + path("dem.tif") + "' cannot be read: ", 0),
                  0U)
            << error.what();
    }
}

TEST_F(ReadBroken, aTruncatedUncompressedFileReadInANarrowWindow) {
    RasterSpec spec{.cols = 20000, .rows = 10, .type = GDT_Float32, .values = counting(200000, 1)};
    spec.driver = "EHdr";
    write(path("dem.bil"), spec);
    options_.source_window = {0, 9, 2, 1};
    expect_values(values("dem.bil"), {180001, 180002});
    cut("dem.bil", 0.6);
    expect_has(message<InputError>("dem.bil"), "Rows 9 to 9 of '" + path("dem.bil") + "' cannot be read: ");
}

TEST_F(ReadBroken, aMosaicWhosePartIsMissing) {
    options_.source =
        R"(<VRTDataset rasterXSize="1" rasterYSize="1"><VRTRasterBand dataType="Byte" band="1">)"
        R"(<SimpleSource><SourceFilename>no_such_folder/none.tif</SourceFilename></SimpleSource>)"
        R"(</VRTRasterBand></VRTDataset>)";
    const std::string text = message<InputError>();
    expect_has(text, "Rows 0 to 0 of '");
    expect_has(
        text,
        "no_such_folder/none.tif: No such file or directory; check whether the files and functions that "
        "the VRT "
        "names are there.");
}

}  // namespace
}  // namespace d2b::test
