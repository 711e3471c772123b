#include <algorithm>
#include <cmath>
#include <limits>

#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

class OddValues : public HostileTest {};
INSTANTIATE_TEST_SUITE_P(All, OddValues, ::testing::ValuesIn(ways()), way_name);

TEST_P(OddValues, theBlockIsFound) {
    const Layer found = buildings(one_block());
    ASSERT_EQ(found.records.size(), 1U);
    EXPECT_NEAR(found.records[0].area(), block_area(), slack());
}

TEST_P(OddValues, oneCellOneRowOneColumn) {
    for (const auto& [rows, cols] : {std::pair{1, 1}, {1, 60}, {60, 1}, {2, 2}, {1, 2}}) {
        RasterSpec spec = blocks();
        spec.rows = rows;
        spec.cols = cols;
        spec.values.assign(static_cast<std::size_t>(rows * cols), 3);
        std::fill_n(spec.values.begin() + rows * cols / 3, (rows * cols + 2) / 3, 15.0);
        for (const Record& record : buildings(spec).records)
            EXPECT_LE(record.area(), rows * cols);
    }
}

TEST_P(OddValues, allNoData) {
    RasterSpec spec = one_block(-9999, -9999);
    spec.nodata = -9999;
    EXPECT_EQ(buildings(spec).records.size(), 0U);
}

TEST_P(OddValues, allEqual) {
    EXPECT_EQ(buildings(one_block(0, 0)).records.size(), 0U);
    EXPECT_EQ(buildings(one_block(-0.0, 0.0)).records.size(), 0U);
}

TEST_P(OddValues, allEqualAndAboveTheGroundThatIsNone) {
    write(path("dem.tif"), one_block(12, 12));
    Arguments arguments = GetParam().arguments;
    arguments.insert(arguments.end(), {"-q", "--", "dem.tif", "out.gpkg"});
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 0);
    const std::size_t found = layer("out.gpkg", "buildings").records.size();
    // Heights that are taken as they are make one building of the whole; nobody says then that there is none.
    EXPECT_EQ(found, std::string(GetParam().name) == "NoGround" ? 1U : 0U);
    EXPECT_EQ(result.err.find("no building was found") == std::string::npos, found > 0) << result.err;
}

TEST_P(OddValues, whatIsNoNumberIsNoData) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (const double odd : {none, inf, -inf}) {
        RasterSpec spec = one_block();
        RasterSpec with_nodata = spec;
        with_nodata.nodata = -9999;
        for (std::size_t i = 3; i < spec.values.size(); i += 131) {
            spec.values[i] = odd;
            with_nodata.values[i] = -9999;
        }
        const std::vector<std::string> found = wkts(buildings(spec));
        EXPECT_EQ(found, wkts(buildings(with_nodata))) << odd;
        EXPECT_FALSE(found.empty());
    }
}

TEST_P(OddValues, hugeOnesNeitherOverflowNorHang) {
    constexpr double most = std::numeric_limits<double>::max();
    for (const auto& [low, high] :
         {std::pair{0.0, most}, {-most, most}, {-most, 0.0}, {0.0, 1e38}, {1e300, 1e301}}) {
        RasterSpec spec = one_block(low, high);
        spec.type = GDT_Float64;
        const Layer found = buildings(spec, {"-zrange", "-1.7976931348623157e308", "1.7976931348623157e308"});
        EXPECT_LE(found.records.size(), 1U);
        if (thesis() && low <= 5 && high > 5) {
            ASSERT_EQ(found.records.size(), 1U) << low << " " << high;
            EXPECT_NEAR(found.records[0].area(), block_area(), slack());
        }
    }
}

TEST_P(OddValues, denormalOnesAreNumbers) {
    RasterSpec spec = one_block(std::numeric_limits<double>::denorm_min(), 3e-310);
    spec.type = GDT_Float64;
    const Layer found = buildings(spec, {"-overwrite"});
    EXPECT_EQ(found.records.size(), 0U);  // there is nothing of 5 m, or of the least height
    if (thesis()) {
        write(path("dem.tif"), spec);
        run_well({"-preset", "thesis", "-fl", "1e-310", "-q", "-overwrite", "--", "dem.tif", "out.gpkg"});
        const Layer low = layer("out.gpkg", "buildings");
        ASSERT_EQ(low.records.size(), 1U);
        EXPECT_EQ(low.records[0].area(), block_area());
    }
}

TEST_P(OddValues, everyTypeGivesTheSame) {
    RasterSpec spec = one_block(3, 15);
    spec.type = GDT_Float64;
    const std::vector<std::string> expected = wkts(buildings(spec));
    ASSERT_EQ(expected.size(), 1U);
    for (const GDALDataType type :
         {GDT_Byte, GDT_Int16, GDT_UInt16, GDT_Int32, GDT_UInt32, GDT_Int64, GDT_UInt64, GDT_Float32}) {
        spec.type = type;
        EXPECT_EQ(wkts(buildings(spec)), expected) << GDALGetDataTypeName(type);
    }
}

TEST_P(OddValues, scaleAndOffsetOfSixteenBits) {
    const std::vector<std::string> expected = wkts(buildings(one_block()));
    RasterSpec spec = one_block(-10000, -8800);
    spec.type = GDT_Int16;
    const GDALDatasetH dataset = create(path("scaled.tif"), spec);
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 0.01);
    GDALSetRasterOffset(GDALGetRasterBand(dataset, 1), 100);
    GDALClose(dataset);
    EXPECT_EQ(wkts(buildings("scaled.tif", "scaled.gpkg")), expected);
}

}  // namespace
}  // namespace d2b::test
