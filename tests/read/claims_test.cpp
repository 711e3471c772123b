#include <cstdint>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

/// Headers that promise what cannot be.
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
    EXPECT_EQ(message<InputError>("dem.img"), quoted("dem.img") +
                                                  " has 216000 bytes where its header promises 360000; it is "
                                                  "truncated, so copy it again.");
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
            " has 7199 bytes where its header promises 3 times 2400; it is truncated, so copy it again.");
}

TEST_F(ReadClaims, aTextGridThatClaimsATrillionCells) {
    write_text(path("claim.asc"),
               "ncols 1000000\nnrows 1000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    EXPECT_EQ(message<InputError>("claim.asc"),
              quoted("claim.asc") +
                  " has 69 bytes where its header promises 1999999999999 at least; it is truncated, "
                  "so copy it again.");
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
            " has at most 1010 values where its header promises 2000; it is truncated, so copy it again.");
}

// 60,000 columns of 60,000 bands in 5 rows: 67 GiB that GDAL would ask for.
TEST_F(ReadClaims, aBlockThatTheFileCannotHold) {
    const auto claim = [&](const std::string& rows) {
        return quoted("claim.tif") + " has 240 bytes and a header that claims a block of 60000 x " + rows +
               " cells in 60000 bands; it is damaged or truncated, so copy it again.";
    };
    EXPECT_EQ(refusal(60000, 60000, 1), claim("1"));  // what is not compressed is read row by row
    EXPECT_EQ(refusal(60000, 60000, 8), claim("5"));
}

// A block of 19 MiB is none to be afraid of; reading says what is missing.
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
