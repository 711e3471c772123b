#include "dem2buildings/error.hpp"
#include "read/side_fixture.hpp"

namespace d2b::test {
namespace {

class Ndvi : public SideTest {
  protected:
    void SetUp() override {
        SideTest::SetUp();
        dem({.cols = 4});
    }
    void scaled(GDALDataType type, const std::vector<double>& values, double scale, double offset) {
        const GDALDatasetH dataset = create(path("side.tif"), {.cols = 4, .type = type, .values = values});
        GDALSetRasterScale(GDALGetRasterBand(dataset, 1), scale);
        GDALSetRasterOffset(GDALGetRasterBand(dataset, 1), offset);
        GDALClose(dataset);
    }
    std::string refusal() {
        return refused<InputError>([this] { ndvi(); });
    }
};

TEST_F(Ndvi, valuesAsTheyAre) {
    write(path("side.tif"), {.cols = 4, .values = {-1, 0.25, none, 1}});
    expect_values(ndvi(), {-1, 0.25, none, 1});
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Ndvi, scaledProducts) {
    scaled(GDT_Int16, {-10000, 0, 2500, 10000}, 0.0001, 0);
    expect_near(ndvi(), {-1, 0, 0.25, 1}, 1e-12);
    scaled(GDT_Byte, {0, 50, 125, 250}, 0.008, -1);
    expect_near(ndvi(), {-1, -0.6, 0, 1}, 1e-12);
}

TEST_F(Ndvi, roundingIsForgiven) {
    write(path("side.tif"), {.cols = 4, .values = {-1.0000005, 0, 0, 1.0000005}});
    expect_values(ndvi(), {-1, 0, 0, 1});
}

TEST_F(Ndvi, otherGridsAndGaps) {
    write(path("side.tif"),
          {.cols = 2, .rows = 2, .values = {0.2, 0.4, 0.2, 0.4}, .transform = {{0, 2, 0, 0, 0, -1}}});
    expect_near(ndvi(), {0.2, 0.25, 0.35, 0.4}, 1e-12);
    write(path("side.tif"), {.cols = 2, .values = {0.2, 0.4}});
    expect_values(ndvi(), {0.2, 0.4, none, none});
    EXPECT_EQ(warnings(),
              (std::vector<std::string>{"About 50 % of " + quoted("dem.tif") + " lies outside of the NDVI " +
                                        quoted("side.tif") + "; nothing is known of vegetation there."}));
}

TEST_F(Ndvi, otherProductsAreRefused) {
    const auto text = [this](const std::string& value) {
        return "The NDVI " + quoted("side.tif") + " has the value " + value +
               ", and an NDVI lies between -1 and 1; set the scale of a scaled product, for example with "
               "gdal_edit.py -scale 0.0001, or compute it as (NIR - red) / (NIR + red) and clamp it.";
    };
    write(path("side.tif"), {.cols = 4, .type = GDT_Int16, .values = {0, 1, 6000, 1}});
    EXPECT_EQ(refusal(), text("6000"));
    write(path("side.tif"), {.cols = 4, .values = {0, 1, 0, -1.5}});
    EXPECT_EQ(refusal(), text("-1.5"));
}

TEST_F(Ndvi, refusedAtOnceWhereTheMiddleRowTells) {
    dem({.cols = 1, .rows = 3});
    write(path("side.tif"), {.rows = 3, .values = {0, 2, 0}});
    expect_has(refused<InputError>([this] { (void)open_ndvi(path("side.tif"), grid_, callbacks_); }),
               "has the value 2,");
    write(path("side.tif"), {.rows = 3, .values = {2, 0, 0}});
    const auto source = open_ndvi(path("side.tif"), grid_, callbacks_);
    std::vector<double> row(1);
    source->read(whole_rows(*source, 2, 1), row);
    EXPECT_EQ(row[0], 0);
    expect_has(refused<InputError>([&] { source->read(whole_rows(*source, 0, 1), row); }),
               "has the value 2,");
}

}  // namespace
}  // namespace d2b::test
