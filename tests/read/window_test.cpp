#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

/// 5 columns and 4 rows of cells 2 wide and 3 high; x from 100 to 110, y from 488 to 500. Row 1 starts
/// with 10.
class ReadWindow : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        std::vector<double> values;
        for (int row = 0; row < 4; ++row)
            for (int col = 0; col < 5; ++col)
                values.push_back(10 * row + col);
        spec_ = {.cols = 5, .rows = 4, .values = values, .transform = {{100, 2, 0, 500, 0, -3}}};
        write(path("dem.tif"), spec_);
    }
    RasterSpec spec_;
};

TEST_F(ReadWindow, allOfTheRasterByDefault) {
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 4, 5}));
}

TEST_F(ReadWindow, inCells) {
    options_.source_window = {1, 2, 3, 2};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    EXPECT_EQ(source->info().window, (Window{2, 1, 2, 3}));
    EXPECT_EQ(source->info().rows, 4);
    EXPECT_EQ(source->info().cols, 5);
    EXPECT_EQ(source->info().transform, (AffineTransform{100, 2, 0, 500, 0, -3}));
    expect_values(read_all(*source), {21, 22, 23, 31, 32, 33});
}

TEST_F(ReadWindow, byCorners) {
    options_.projected_window = {102, 494, 106, 488};
    expect_values(values("dem.tif"), {21, 22, 31, 32});
}

TEST_F(ReadWindow, byExtent) {
    options_.extent = {102, 488, 106, 494};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    EXPECT_EQ(source->info().window, (Window{2, 1, 2, 2}));
    expect_values(read_all(*source), {21, 22, 31, 32});
}

TEST_F(ReadWindow, centresOnWestAndSouthEdgesAreInside) {
    // Centres: x 101, 103, ...; y 498.5, 495.5, 492.5, 489.5.
    options_.extent = {103, 492.5, 105, 495.5};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{2, 1, 1, 1}));
    options_.extent = {102.9, 492.4, 105.1, 495.6};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{1, 1, 2, 2}));
    options_.extent = {103.1, 488, 106.9, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 2, 4, 1}));
}

TEST_F(ReadWindow, neighboursShareNoCell) {
    options_.extent = {100, 488, 105, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 4, 2}));
    options_.extent = {105, 488, 110, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 2, 4, 3}));
}

TEST_F(ReadWindow, whatLiesOutsideIsClipped) {
    options_.extent = {-1e300, 496.9, 104, 1e300};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 1, 2}));
}

TEST_F(ReadWindow, southUpAndMirrored) {
    spec_.transform = {{110, -2, 0, 488, 0, 3}};
    write(path("turned.tif"), spec_);
    options_.extent = {102, 488, 106, 494};
    // x of the centres: 109, 107, 105, 103, 101; y: 489.5, 492.5, 495.5, 498.5.
    EXPECT_EQ(open("turned.tif")->info().window, (Window{0, 2, 2, 2}));
    expect_values(values("turned.tif"), {2, 3, 12, 13});
    options_.extent = {103, 489.5, 105, 492.5};
    expect_values(values("turned.tif"), {3});
}

TEST_F(ReadWindow, pixelCoordinatesHaveYUpwards) {
    spec_.transform.reset();
    write(path("plain.tif"), spec_);
    options_.extent = {1, -2, 3, 0};
    expect_values(values("plain.tif"), {1, 2, 11, 12});
}

TEST_F(ReadWindow, cellsMustBeWholeNumbers) {
    options_.source_window = {0, 0, 2.5, 1};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-srcwin 0 0 2.5 1 must be whole numbers of cells (column row columns rows); the raster has 5 "
              "columns "
              "and 4 rows.");
    options_.source_window = {0, 0, none, 1};
    expect_has(message<OptionError>("dem.tif"), "must be whole numbers of cells");
}

TEST_F(ReadWindow, cellsMustLieInside) {
    for (const auto& window : std::vector<std::array<double, 4>>{{3, 0, 3, 1},
                                                                 {0, 3, 1, 2},
                                                                 {-1, 0, 2, 2},
                                                                 {0, -1, 2, 2},
                                                                 {0, 0, 0, 1},
                                                                 {0, 0, 1, 0},
                                                                 {0, 0, 1e300, 1}}) {
        options_.source_window = window;
        expect_has(message<OptionError>("dem.tif"),
                   "does not lie inside the raster; the raster has 5 columns and 4 rows.");
    }
    options_.source_window = {3, 0, 3, 1};
    expect_has(message<OptionError>("dem.tif"), "-srcwin 3 0 3 1 (column row columns rows)");
}

TEST_F(ReadWindow, nothingInside) {
    options_.extent = {0, 488, 100, 500};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-te 0 488 100 500 holds no cell centre of the raster, which extends from 100 to 110 in x and "
              "from 488 "
              "to 500 in y.");
    options_.extent.reset();
    options_.projected_window = {103.2, 500, 104.8, 488};  // between two columns of centres
    expect_has(message<OptionError>("dem.tif"), "-projwin 103.2 500 104.8 488 holds no cell centre");
}

TEST_F(ReadWindow, anotherOrderIsTold) {
    options_.extent = {488, 102, 494, 106};
    expect_has(message<OptionError>("dem.tif"),
               "from 488 to 500 in y; x comes before y, so write -te 102 488 106 494.");
    EXPECT_TRUE(warnings_.empty());
    options_.extent = {102, 106, 488, 494};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{2, 1, 2, 4}));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(
        warnings_[0],
        "-te 102 106 488 494 (xmin ymin xmax ymax) reaches beyond the raster; if it is xmin xmax ymin ymax, "
        "as QGIS has it, write -te 102 488 106 494.");
}

TEST_F(ReadWindow, cornersInOrder) {
    options_.projected_window = {102, 488, 106, 494};
    expect_has(message<OptionError>("dem.tif"),
               "-projwin 102 488 106 494 must be the upper left and the lower right");
    options_.projected_window.reset();
    options_.extent = {102, 494, 106, 488};
    expect_has(message<OptionError>("dem.tif"), "-te 102 494 106 488 must be xmin ymin xmax ymax");
    options_.extent = {none, 488, 106, 494};
    expect_has(message<OptionError>("dem.tif"), "must be xmin ymin xmax ymax");
}

TEST_F(ReadWindow, onlyOne) {
    options_.extent = {102, 488, 106, 494};
    options_.source_window = {0, 0, 1, 1};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-srcwin, -projwin and -te exclude each other; give only one of them.");
}

TEST_F(ReadWindow, coordinatesOfARotatedRaster) {
    spec_.transform = {{100, 2, 1, 500, 1, -2}};
    write(path("rotated.tif"), spec_);
    options_.extent = {102, 488, 106, 494};
    EXPECT_EQ(message<OptionError>("rotated.tif"),
              "-te 102 488 106 494 cannot be used, since the rows of the raster do not run along the x axis; "
              "give the "
              "window in cells with -srcwin.");
    options_.extent.reset();
    options_.source_window = {4, 3, 1, 1};
    expect_values(values("rotated.tif"), {34});
}

}  // namespace
}  // namespace d2b::test
