#include <cmath>
#include <filesystem>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"
#include "support/test_name.hpp"

namespace d2b::test {
namespace {

/// What is known of a real DEM, found with NumPy from the bands as GDAL gives them.
struct City {
    const char* file;
    int cols;
    int rows;
    const char* unit;
    int valid;
    double minimum;
    double maximum;
    double sum;
    double at_100_100;
    const char* crs;
};

void PrintTo(const City& city, std::ostream* stream) {
    *stream << city.file;
}

class ReadCity : public ReadTest, public ::testing::WithParamInterface<City> {};

TEST_P(ReadCity, isReadWhole) {
    const City& city = GetParam();
    options_.source = std::string(D2B_SHARED) + "/cities/" + city.file;
    if (!std::filesystem::exists(options_.source))
        GTEST_SKIP() << "the real DEM " << options_.source << " is not here";
    const std::unique_ptr<DemSource> source = open();
    EXPECT_EQ(source->info().cols, city.cols);
    EXPECT_EQ(source->info().rows, city.rows);
    EXPECT_EQ(source->info().band_unit, city.unit);
    expect_has(source->info().crs_wkt, city.crs);
    const std::vector<double> elevations = read_all(*source);
    int valid = 0;
    double minimum = 1e9;
    double maximum = -1e9;
    double sum = 0;
    for (const double z : elevations)
        if (!std::isnan(z)) {
            ++valid;
            minimum = std::min(minimum, z);
            maximum = std::max(maximum, z);
            sum += z;
        }
    EXPECT_EQ(valid, city.valid);
    EXPECT_EQ(minimum, city.minimum);
    EXPECT_EQ(maximum, city.maximum);
    EXPECT_NEAR(sum, city.sum, 1e-9 * city.sum);
    EXPECT_EQ(elevations[static_cast<std::size_t>(100 * city.cols + 100)], city.at_100_100);
    EXPECT_TRUE(warnings_.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Cities, ReadCity,
    ::testing::Values(
        City{"delft/dsm.tif", 527, 456, "m", 224129, -0.5680000185966492, 26.32900047302246,
             1094635.1119940942, 0.2840000092983246, "PROJCRS[\"Amersfoort / RD New\""},
        City{"annarbor/dsm.tif", 786, 868, "m", 682248, 254.0, 300.3396301269531, 185497837.1700287, 280.0,
             "PROJCRS[\"NAD83 / Michigan South (ft)\""},
        City{"annarbor/dsm_zfeet.tif", 786, 868, "ft", 682248, 833.3333129882812, 985.3662109375,
             608588704.7709961, 918.6351928710938, "PROJCRS[\"NAD83 / Michigan South (ft)\""},
        City{"stuttgart_csite2/dsm.tif", 420, 632, "m", 263594, 283.6400146484375, 350.42999267578125,
             79954669.06994629, 294.739990234375, "PROJCRS[\"WGS 84 / UTM zone 32N\""},
        City{"stuttgart_csite2/derived_epsg4326_dsm.tif", 541, 537, "m", 286493, 284.5199890136719, 349.5,
             86900307.07919312, 290.2699890136719, "GEOGCRS[\"WGS 84\""}),
    [](const auto& test) { return case_name(test.param.file); });

}  // namespace
}  // namespace d2b::test
