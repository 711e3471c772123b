#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

/// Rasters that are larger than any memory, in files of some bytes. Small cells, so that they lie within
/// their CRS.
class TooLarge : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers end a program that asks for too much memory";
    }
    static constexpr const char* no_memory_ =
        "There is not enough memory; use a part of the input (-srcwin, -projwin or -te) or fewer -threads.";
    void write_large(const std::string& cols, const std::string& rows) const {
        write_text(path("large.vrt"),
                   "<VRTDataset rasterXSize=\"" + cols + "\" rasterYSize=\"" + rows +
                       R"("><SRS>EPSG:25832</SRS><GeoTransform>5e5,1e-5,0,5e6,0,-1e-5</GeoTransform>)"
                       R"(<VRTRasterBand dataType="Byte" band="1"/></VRTDataset>)");
    }
};

TEST_F(TooLarge, moreThanTheMemoryHolds) {
    write_large("1073741824", "1048576");
    expect_error(1, no_memory_, {"-preset", "thesis", "-q", "large.vrt", "out.gpkg"});
}

TEST_F(TooLarge, moreThanAUnitMaySee) {
    write_large("1073741824", "1048576");
    expect_error(2, "exceed the limit, so give a smaller -max_building_width.",
                 {"-q", "large.vrt", "out.gpkg"});
}

// 2^60 doubles: the library refuses them before it asks for memory.
TEST_F(TooLarge, moreThanAVectorCanHold) {
    write_large("1073741824", "1073741824");
    expect_error(1, no_memory_, {"-sweep", "lod=3", "-q", "large.vrt"});
}

}  // namespace
}  // namespace d2b::test
