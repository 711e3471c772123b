#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

struct TypeCase {
    GDALDataType type;
    std::vector<double> values;
};

class ReadTypes : public ReadTest, public ::testing::WithParamInterface<TypeCase> {};

TEST_P(ReadTypes, valuesComeBackAsDoubles) {
    write("/vsimem/typed.tif", {.cols = 2, .rows = 1, .type = GetParam().type, .values = GetParam().values});
    options_.source = "/vsimem/typed.tif";
    expect_values(values(), GetParam().values);
    VSIUnlink("/vsimem/typed.tif");
}

INSTANTIATE_TEST_SUITE_P(Types, ReadTypes,
                         ::testing::Values(TypeCase{GDT_Byte, {0, 255}}, TypeCase{GDT_Int16, {-32768, 32767}},
                                           TypeCase{GDT_UInt16, {0, 65535}},
                                           TypeCase{GDT_Int32, {-2147483648.0, 2147483647.0}},
                                           TypeCase{GDT_UInt32, {0, 4294967295.0}},
                                           TypeCase{GDT_Float32, {-0.15625, 8388607.5}},
                                           TypeCase{GDT_Float64, {0.1, -1e300}}),
                         [](const auto& test) { return std::string(GDALGetDataTypeName(test.param.type)); });

class ReadValues : public ReadTest {};

TEST_F(ReadValues, oneCellOneRowOneColumn) {
    write(path("cell.tif"), {.values = {7}});
    write(path("row.tif"), {.cols = 4, .rows = 1, .values = counting(4)});
    write(path("column.tif"), {.cols = 1, .rows = 4, .values = counting(4)});
    expect_values(values("cell.tif"), {7});
    expect_values(values("row.tif"), {0, 1, 2, 3});
    expect_values(values("column.tif"), {0, 1, 2, 3});
    EXPECT_EQ(open("column.tif")->info().window, (Window{0, 0, 4, 1}));
}

TEST_F(ReadValues, anyBandsOfRowsOfATiledRasterAreTheSame) {
    const int cols = 70;
    const int rows = 150;
    const std::vector<double> expected = counting(cols * rows);
    write(path("tiled.tif"),
          {.cols = cols,
           .rows = rows,
           .values = expected,
           .nodata = 35,
           .creation = {"TILED=YES", "BLOCKXSIZE=32", "BLOCKYSIZE=48", "COMPRESS=DEFLATE"}});
    const std::unique_ptr<DemSource> source = open("tiled.tif");
    for (const std::int32_t step : {1, 7, 48, 149, 150}) {
        std::vector<double> got(expected.size());
        for (std::int32_t row = 0; row < rows; row += step) {
            const std::int32_t count = std::min(step, rows - row);
            source->read(whole_rows(*source, row, count),
                         std::span(got).subspan(static_cast<std::size_t>(row * cols),
                                                static_cast<std::size_t>(count * cols)));
        }
        std::vector<double> wanted = expected;
        wanted[35] = none;
        expect_values(got, wanted);
    }
    std::vector<double> part(50 * 20);
    source->read({30, 35, 50, 20}, part);
    for (std::size_t i = 0; i < part.size(); ++i)
        ASSERT_EQ(part[i], static_cast<double>((30 + i / 20) * cols + 35 + i % 20));
}

TEST_F(ReadValues, scaleAndOffsetAreApplied) {
    const GDALDatasetH dataset = create(
        path("dem.tif"), {.cols = 3, .type = GDT_Int16, .values = {-5, 100, -32768}, .nodata = -32768});
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    GDALSetRasterScale(band, 0.25);
    GDALSetRasterOffset(band, 1000);
    GDALSetRasterUnitType(band, "US survey foot");
    GDALClose(dataset);
    expect_values(values("dem.tif"), {998.75, 1025, none});
    EXPECT_EQ(open("dem.tif")->info().band_unit, "US survey foot");
}

TEST_F(ReadValues, aScaleThatOverflowsGivesNoElevation) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .values = {2, 1e300}});
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 1e10);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {2e10, none});
}

TEST_F(ReadValues, aScaleOfZeroIsRefused) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.values = {2}});
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 0);
    GDALSetRasterOffset(GDALGetRasterBand(dataset, 1), 3);
    GDALClose(dataset);
    EXPECT_EQ(message<InputError>("dem.tif"),
              quoted("dem.tif") +
                  " has the scale 0 and the offset 3, which give no elevations; correct them, " +
                  "for example with gdal_edit.py -scale -offset.");
}

TEST_F(ReadValues, theBandIsChosen) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .values = {1, 2}, .bands = 2});
    std::array<double, 2> second{3, 4};
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 2), GF_Write, 0, 0, 2, 1, second.data(), 2, 1,
                           GDT_Float64, 0, 0),
              CE_None);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {1, 2});
    options_.band = 2;
    expect_values(values("dem.tif"), {3, 4});
}

TEST_F(ReadValues, rowsOutsideTheWindowAreRefused) {
    write(path("dem.tif"), {.cols = 2, .rows = 3, .values = counting(6)});
    options_.source_window = {0, 1, 2, 2};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    std::vector<double> row(2);
    source->read(whole_rows(*source, 2, 1), row);
    expect_values(row, {4, 5});
    EXPECT_THROW(source->read(whole_rows(*source, 0, 1), row), InputError);
    EXPECT_THROW(source->read(whole_rows(*source, 3, 1), row), InputError);
    EXPECT_THROW(source->read(whole_rows(*source, 1, 2), row), InputError);  // a buffer that is too small
    try {
        source->read(whole_rows(*source, 0, 1), row);
    } catch (const InputError& error) {
        expect_has(error.what(),
                   "1 rows from 0 on and 2 columns from 0 on were asked for outside the window");
    }
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest_single = static_cast<double>(std::numeric_limits<float>::max());

class ReadValidity : public ReadTest {};

TEST_F(ReadValidity, noDataIsNotValid) {
    write(path("dem.tif"), {.cols = 3, .type = GDT_Int16, .values = {-9999, 0, 5}, .nodata = -9999});
    expect_values(values("dem.tif"), {none, 0, 5});
}

TEST_F(ReadValidity, noDataThatIsNotANumber) {
    write(path("dem.tif"), {.cols = 3, .type = GDT_Float32, .values = {none, 0, 5}, .nodata = none});
    expect_values(values("dem.tif"), {none, 0, 5});
}

TEST_F(ReadValidity, noDataThatNoSingleHoldsExactly) {
    const double tenth = static_cast<double>(0.1F);
    write(path("dem.tif"), {.cols = 2, .type = GDT_Float32, .values = {0.1, 0.2}, .nodata = 0.1});
    ASSERT_NE(tenth, 0.1);
    expect_values(values("dem.tif"), {none, static_cast<double>(0.2F)});
    options_.nodata = 0.2;
    expect_values(values("dem.tif"), {tenth, none});
}

TEST_F(ReadValidity, noDataAtTheEndOfTheSingles) {
    write(path("dem.tif"), {.cols = 2, .type = GDT_Float32, .values = {-largest_single, 1}});
    expect_values(values("dem.tif"), {-largest_single, 1});
    options_.nodata = -3.4028235e38;  // as gdalinfo writes it; a little beyond
    expect_values(values("dem.tif"), {none, 1});
    options_.nodata = -1e300;
    expect_values(values("dem.tif"), {-largest_single, 1});
}

TEST_F(ReadValidity, noDataOutOfTheRangeOfTheTypeHasNoEffect) {
    write(path("dem.tif"), {.cols = 2, .type = GDT_Byte, .values = {0, 255}});
    options_.nodata = -9999;
    expect_values(values("dem.tif"), {0, 255});
}

TEST_F(ReadValidity, notANumberAndInfinitiesAreNeverValid) {
    for (const GDALDataType type : {GDT_Float32, GDT_Float64}) {
        write(path("dem.tif"), {.cols = 4, .type = type, .values = {none, infinity, -infinity, 2}});
        expect_values(values("dem.tif"), {none, none, none, 2});
        options_.ignore_nodata = true;
        expect_values(values("dem.tif"), {none, none, none, 2});
        options_.ignore_nodata = false;
    }
}

TEST_F(ReadValidity, theUsersNoDataTakesThePlaceOfTheFiles) {
    write(path("dem.tif"), {.cols = 3, .type = GDT_Int16, .values = {-9999, 0, 5}, .nodata = -9999});
    options_.nodata = 0;
    expect_values(values("dem.tif"), {-9999, none, 5});
}

TEST_F(ReadValidity, theUsersNoDataIsComparedWithStoredValues) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .type = GDT_Int16, .values = {10, 20}});
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 2);
    GDALClose(dataset);
    options_.nodata = 20;
    expect_values(values("dem.tif"), {20, none});
}

TEST_F(ReadValidity, noDataCanBeIgnored) {
    write(path("dem.tif"), {.cols = 3, .type = GDT_Int16, .values = {-9999, 0, 5}, .nodata = -9999});
    options_.ignore_nodata = true;
    expect_values(values("dem.tif"), {-9999, 0, 5});
}

TEST_F(ReadValidity, eitherOwnNoDataOrNone) {
    write(path("dem.tif"), {.values = {1}});
    options_.ignore_nodata = true;
    options_.nodata = 0;
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-snodata and -inodata exclude each other; give only one of them.");
}

void write_masked(const std::string& path) {
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
    const GDALDatasetH dataset = create(path, {.cols = 4, .type = GDT_Float32, .values = {1, 2, 3, 4}});
    GDALCreateDatasetMaskBand(dataset, GMF_PER_DATASET);
    std::array<GByte, 4> mask{255, 0, 255, 0};
    ASSERT_EQ(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataset, 1)), GF_Write, 0, 0, 4, 1, mask.data(),
                           4, 1, GDT_Byte, 0, 0),
              CE_None);
    GDALClose(dataset);
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
}

TEST_F(ReadValidity, theMaskOfTheDataset) {
    write_masked(path("dem.tif"));
    expect_values(values("dem.tif"), {1, none, 3, none});
    options_.nodata = 3;  // in addition: it only takes the place of a NoData value
    expect_values(values("dem.tif"), {1, none, none, none});
    options_.nodata.reset();
    options_.ignore_nodata = true;
    expect_values(values("dem.tif"), {1, 2, 3, 4});
}

TEST_F(ReadValidity, alphaAboveZeroIsValid) {
    const GDALDatasetH dataset =
        create(path("dem.tif"),
               {.cols = 3, .type = GDT_Byte, .values = {10, 20, 30}, .bands = 2, .creation = {"ALPHA=YES"}});
    std::array<GByte, 3> alpha{0, 1, 255};
    ASSERT_EQ(
        GDALRasterIO(GDALGetRasterBand(dataset, 2), GF_Write, 0, 0, 3, 1, alpha.data(), 3, 1, GDT_Byte, 0, 0),
        CE_None);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {none, 20, 30});
}

/// A raster of three elevations with an alpha band of the same type.
void write_with_alpha(const std::string& path, GDALDataType type, std::array<double, 3> alpha,
                      std::optional<double> nodata = {}) {
    const GDALDatasetH dataset =
        create(path, {.cols = 3, .type = type, .values = {10, 20, 30}, .nodata = nodata, .bands = 2});
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 2);
    ASSERT_EQ(GDALSetRasterColorInterpretation(band, GCI_AlphaBand), CE_None);
    ASSERT_EQ(GDALRasterIO(band, GF_Write, 0, 0, 3, 1, alpha.data(), 3, 1, GDT_Float64, 0, 0), CE_None);
    GDALClose(dataset);
}

TEST_F(ReadValidity, alphaOfAnyTypeIsTheMask) {
    for (const GDALDataType type :
         {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_UInt32, GDT_Int32, GDT_Float32, GDT_Float64}) {
        SCOPED_TRACE(GDALGetDataTypeName(type));
        write_with_alpha(path("dem.tif"), type, {0, 1, 255});
        expect_values(values("dem.tif"), {none, 20, 30});
        options_.ignore_nodata = true;
        expect_values(values("dem.tif"), {10, 20, 30});
        options_.ignore_nodata = false;
    }
    write_with_alpha(path("dem.tif"), GDT_Float32, {0, 0.001, 1});
    expect_values(values("dem.tif"), {none, 20, 30});
}

TEST_F(ReadValidity, alphaAndNoDataBothTakeOut) {
    write_with_alpha(path("dem.tif"), GDT_Float32, {0, 1, 1}, 30);
    expect_values(values("dem.tif"), {none, 20, none});
    options_.nodata = 20;  // takes the place of the NoData value, not of the alpha band
    expect_values(values("dem.tif"), {none, none, 30});
}

TEST_F(ReadValidity, alphaIsNotScaledAway) {
    write_with_alpha(path("dem.tif"), GDT_Float32, {0, 1, 1});
    const GDALDatasetH dataset = GDALOpen(path("dem.tif").c_str(), GA_Update);
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 2);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {none, 40, 60});
}

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

/// Headers that promise impossible content.
class ReadClaims : public ReadTest {
  protected:
    /// A TIFF of float32 in a strip, of which there is a header and nothing else.
    static std::string tiff(std::uint16_t cols, std::uint16_t bands, std::uint16_t compression) {
        std::string bytes("II*\0\x08\0\0\0", 8);
        const auto add = [&](std::uint32_t value, int count) {
            for (int i = 0; i < count; ++i)
                bytes += static_cast<char>(value >> 8 * i & 255);
        };
        // Tag and value: width, length, bits, compression, photometric, offset, bands, rows of a strip,
        // bytes, format.
        const std::vector<std::pair<std::uint32_t, std::uint32_t>> tags{
            {256, cols}, {257, 5},     {258, 32}, {259, compression}, {262, 1},
            {273, 140},  {277, bands}, {278, 5},  {279, 100},         {339, 3}};
        add(static_cast<std::uint32_t>(tags.size()), 2);
        for (const auto& [tag, value] : tags) {
            add(tag, 2);
            add(3, 2);  // the type: numbers of 16 bits
            add(1, 4);
            add(value, 4);
        }
        return bytes + std::string(240 - bytes.size(), '\0');
    }
    [[nodiscard]] std::string refusal(std::uint16_t cols, std::uint16_t bands, std::uint16_t compression) {
        write_text(path("claim.tif"), tiff(cols, bands, compression));
        return message<InputError>("claim.tif");
    }
    static std::string virtual_raster(const std::string& cols, const std::string& rows) {
        return "<VRTDataset rasterXSize=\"" + cols + "\" rasterYSize=\"" + rows +
               R"("><GeoTransform>0,1,0,0,0,-1</GeoTransform><VRTRasterBand dataType="Byte" band="1"/></VRTDataset>)";
    }
};

TEST_F(ReadClaims, aTruncatedEnviFile) {
    RasterSpec spec = RasterSpec{.cols = 300, .rows = 300, .type = GDT_Float32, .values = counting(90000, 1)};
    spec.driver = "ENVI";
    write(path("dem.img"), spec);
    expect_values(values("dem.img"), spec.values);
    write_text(path("dem.img"), read_bytes(path("dem.img")).substr(0, 216000));
    EXPECT_EQ(message<InputError>("dem.img"),
              quoted("dem.img") +
                  " has 216000 bytes, but its header promises 360000; it is truncated, so copy it again.");
}

TEST_F(ReadClaims, aTruncatedEnviFileOfBands) {
    write(path("dem.img"), {.cols = 30,
                            .rows = 20,
                            .type = GDT_Float32,
                            .values = counting(600, 1),
                            .bands = 3,
                            .driver = "ENVI"});
    const std::string bytes = read_bytes(path("dem.img"));
    ASSERT_EQ(bytes.size(), 7200U);
    expect_values(values("dem.img"), counting(600, 1));
    write_text(path("dem.img"), bytes.substr(0, 7199));
    EXPECT_EQ(
        message<InputError>("dem.img"),
        quoted("dem.img") +
            " has 7199 bytes, but its header promises 3 times 2400; it is truncated, so copy it again.");
}

TEST_F(ReadClaims, aTextGridThatClaimsATrillionCells) {
    write_text(path("claim.asc"),
               "ncols 1000000\nnrows 1000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    // GDAL 3.13 refuses it itself.
    const std::string text = message<InputError>("claim.asc");
    expect_has(text, quoted("claim.asc"));
    expect_has(text, "69 bytes");
}

// GDAL would look for the rows that are missing until the end of days.
TEST_F(ReadClaims, aTruncatedTextGrid) {
    std::string text = "ncols 10\nnrows 200\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int i = 0; i < 1000; ++i)
        text += "12.345 ";
    write_text(path("cut.asc"), text);
    EXPECT_EQ(
        message<InputError>("cut.asc"),
        quoted("cut.asc") +
            " has at most 1010 values, but its header promises 2000; it is truncated, so copy it again.");
}

// 60,000 columns of 60,000 bands in 5 rows: 67 GiB that GDAL would ask for.
TEST_F(ReadClaims, aBlockThatTheFileCannotHold) {
    const auto claim = [&](const std::string& rows) {
        return quoted("claim.tif") + " has 240 bytes and a header that claims a block of 60000 x " + rows +
               " cells in 60000 bands; it is damaged or truncated, so copy it again.";
    };
    EXPECT_EQ(refusal(60000, 60000, 1), claim("1"));  // uncompressed data are read row by row
    EXPECT_EQ(refusal(60000, 60000, 8), claim("5"));
}

// A block of 19 MiB is none to be afraid of; reading reports the missing rows.
TEST_F(ReadClaims, anOrdinaryBlockIsRead) {
    for (const std::uint16_t compression : {std::uint16_t{1}, std::uint16_t{8}})
        expect_has(refusal(1000, 1000, compression),
                   "Rows 0 to 4 of " + quoted("claim.tif") + " cannot be read");
}

TEST_F(ReadClaims, sidesBeyondAllRasters) {
    const auto expect_refused = [&](const std::string& cols, const std::string& rows) {
        options_.source = virtual_raster(cols, rows);
        options_.source_window = {0, 0, 1, 1};
        EXPECT_EQ(message<InputError>(),
                  "'" + options_.source + "' has " + cols + " columns and " + rows +
                      " rows; more than 1073741824 of either are not supported, so cut it into parts, for "
                      "example with gdal_translate -srcwin.");
    };
    expect_refused("1073741825", "1");
    expect_refused("2", "2147483647");
}

TEST_F(ReadClaims, theLongestSides) {
    options_.source = virtual_raster("1073741824", "1073741824");
    options_.source_window = {1073741821, 1073741822, 3, 2};
    expect_values(values(), std::vector<double>(6, 0));
}

}  // namespace
}  // namespace d2b::test
