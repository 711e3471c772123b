#include <cmath>

#include "dem2buildings/error.hpp"
#include "read/polygon_layer.hpp"
#include "read/rasters.hpp"
#include "score/measure.hpp"

namespace d2b::test {
namespace {

class ValidCellsTest : public ReadTest {
  protected:
    /// 6 columns and 4 rows from (100, 200) on downwards, cells of 2 by 1.
    static RasterSpec spec() {
        RasterSpec result;
        result.cols = 6;
        result.rows = 4;
        result.values = counting(24);
        result.transform = std::array<double, 6>{100, 2, 0, 200, 0, -1};
        result.nodata = -9999;
        return result;
    }
    static void set(RasterSpec& spec, int row, int col, double value) {
        spec.values[static_cast<std::size_t>(row * spec.cols + col)] = value;
    }
};

TEST_F(ValidCellsTest, areTheWholeRasterWhereAllHaveData) {
    write(path("a.tif"), spec());
    const ValidCells cells = valid_cells(path("a.tif"), heard_);
    ASSERT_EQ(cells.polygons.size(), 1U);
    EXPECT_EQ(cells.polygons[0].exterior, (WorldRing{{100, 200}, {112, 200}, {112, 196}, {100, 196}}));
    EXPECT_NE(cells.crs_wkt.find("UTM zone 32N"), std::string::npos);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ValidCellsTest, leaveOutWhatHasNone) {
    RasterSpec holed = spec();
    set(holed, 1, 1, -9999);           // a hole
    set(holed, 0, 5, std::nan(""));    // a corner
    for (int row = 0; row < 4; ++row)  // a cut
        set(holed, row, 3, -9999);
    write(path("a.tif"), holed);
    const ValidCells cells = valid_cells(path("a.tif"), heard_);
    ASSERT_EQ(cells.polygons.size(), 2U);
    EXPECT_DOUBLE_EQ(area_of(cells.polygons), 2 * (24 - 1 - 1 - 4));
    const std::size_t holes = cells.polygons[0].interiors.size() + cells.polygons[1].interiors.size();
    EXPECT_EQ(holes, 1U);
}

TEST_F(ValidCellsTest, followRotatedGrids) {
    RasterSpec rotated = spec();
    rotated.transform = std::array<double, 6>{0, 3, 4, 0, 4, -3};
    set(rotated, 0, 0, -9999);
    write(path("a.tif"), rotated);
    EXPECT_DOUBLE_EQ(area_of(valid_cells(path("a.tif"), heard_).polygons), 25 * 23.0);
}

TEST_F(ValidCellsTest, warnOfAMissingCrs) {
    RasterSpec bare = spec();
    bare.crs = "";
    write(path("a.tif"), bare);
    EXPECT_EQ(valid_cells(path("a.tif"), heard_).crs_wkt, "");
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0],
              quoted("a.tif") +
                  " has no coordinate reference system; its coordinates are taken as the reference's.");
}

TEST_F(ValidCellsTest, passOtherWarningsOn) {
    RasterSpec indexed = spec();
    indexed.transform.reset();
    write(path("a.tif"), indexed);
    (void)valid_cells(path("a.tif"), heard_);
    ASSERT_EQ(warnings_.size(), 1U);
    expect_has(warnings_[0], "has no georeferencing");
}

TEST_F(ValidCellsTest, refuseARasterWithoutData) {
    RasterSpec empty = spec();
    empty.values.assign(24, -9999);
    write(path("a.tif"), empty);
    try {
        (void)valid_cells(path("a.tif"), heard_);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), "No cell of " + quoted("a.tif") +
                                    " has data; give the raster that the footprints come from.");
    }
}

TEST_F(ValidCellsTest, refuseWhatIsNoRaster) {
    EXPECT_THROW((void)valid_cells(path("none.tif"), heard_), InputError);
}

}  // namespace
}  // namespace d2b::test
