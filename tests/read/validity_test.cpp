#include <array>
#include <limits>
#include <optional>
#include <string>

#include <cpl_conv.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

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

}  // namespace
}  // namespace d2b::test
