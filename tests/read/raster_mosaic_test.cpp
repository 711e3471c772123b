#include "read/raster_mosaic.hpp"

#include <fstream>

#include "read/rasters.hpp"

namespace d2b::test {
namespace {

class ReadMosaic : public ReadTest {
  protected:
    /// Cells of the rasters, with what none of them covers.
    std::vector<double> mosaic(const std::vector<std::string>& names) {
        std::vector<std::string> rasters;
        for (const std::string& name : names)
            rasters.push_back(path(name));
        build_mosaic(path("source.vrt"), rasters, 1);
        return values("source.vrt");
    }
    std::string refusal(const std::vector<std::string>& names) {
        try {
            (void)mosaic(names);
        } catch (const InputError& error) {
            return error.what();
        }
        return "not refused";
    }
    static RasterSpec at(double x, double y, const std::vector<double>& values) {
        return {.cols = 2, .rows = 1, .values = values, .transform = {{x, 1, 0, y, 0, -1}}};
    }
};

TEST_F(ReadMosaic, putsRastersWhereTheyLie) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    write(path("b.tif"), at(12, 19, {3, 4}));
    expect_values(mosaic({"a.tif", "b.tif"}), {1, 2, none, none, none, none, 3, 4});
    write(path("b.tif"), at(11, 20, {3, 4}));  // the later one is above the earlier
    expect_values(mosaic({"a.tif", "b.tif"}), {1, 3, 4});
    expect_values(mosaic({"b.tif", "a.tif"}), {1, 2, 4});
}

TEST_F(ReadMosaic, knowsNoDataInEach) {
    RasterSpec a = at(10, 20, {0, -7});
    RasterSpec b = at(12, 19, {-9, 4});
    write(path("a.tif"), a);
    b.nodata = -9;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, -7, none, none, none, none, none, 4});
    a.nodata = -7;
    write(path("a.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, none, none, none, none, none, none, 4});
}

TEST_F(ReadMosaic, ofBytesLeavesGapsWithoutData) {
    RasterSpec a = at(10, 20, {0, 254});
    RasterSpec b = at(12, 20, {255, 1});
    a.type = b.type = GDT_Byte;
    write(path("a.tif"), a);
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, 254, 255, 1});  // no gap: all are elevations
    b = at(13, 20, {2, 1});
    b.type = GDT_Byte;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, 254, none, 2, 1});
}

/// Rows are copied where no raster lies above another one and all mean the same by no data.
TEST_F(ReadMosaic, looksAtEachCellOnlyWhereItHasTo) {
    const auto copies = [&] { return read_bytes(path("source.vrt")).find("<NODATA>") == std::string::npos; };
    RasterSpec a = at(10, 20, {1, -7});
    RasterSpec b = at(12, 20, {-7, 4});
    a.type = b.type = GDT_Float32;
    a.nodata = b.nodata = -7;
    write(path("a.tif"), a);
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, none, 4});
    EXPECT_TRUE(copies());
    b.nodata = -9;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, none, 4});  // -7 is none of the mosaic's
    EXPECT_FALSE(copies());
    b = at(11, 20, {-7, 4});
    b.type = GDT_Float32;
    b.nodata = -7;
    write(path("b.tif"), b);
    write(path("c.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, 4});
    expect_values(mosaic({"c.tif", "b.tif", "a.tif"}), {1, none, 4});
    EXPECT_FALSE(copies());
    a = at(10, 20, {3, 5});  // all of which is above
    a.type = GDT_Float32;
    a.nodata = -7;
    write(path("a.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {3, 5, 4});
    EXPECT_FALSE(copies());
}

TEST_F(ReadMosaic, refusesWhatIsNotOnOneGrid) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    const auto expect = [&](const RasterSpec& spec, const std::string& why, const std::string& advice) {
        write(path("b.tif"), spec);
        EXPECT_EQ(refusal({"a.tif", "b.tif"}), "'" + path("b.tif") + "' cannot be a part of a mosaic: " +
                                                   why + "; " + advice + ", or take it off the list.");
    };
    const std::string first = "'" + path("a.tif") + "'";
    const std::string warp = "bring it onto that grid with gdalwarp";
    RasterSpec b = at(12.5, 20, {1, 2});
    expect(b, "its cells lie between those of " + first, warp);
    expect(at(12, 20.25, {1, 2}), "its cells lie between those of " + first, warp);
    b = at(12, 20, {1, 2});
    b.crs = "EPSG:25833";
    expect(b, "it has another coordinate reference system than " + first, warp);
    b.crs = "";
    expect(b, "it has another coordinate reference system than " + first, warp);
    b = at(12, 20, {1, 2});
    b.transform = {{12, 1.01, 0, 20, 0, -1}};
    expect(b, "it has cells of another size than " + first, warp);
    b.transform = {{12, 1, 0.1, 20, 0, -1}};
    expect(b, "it is rotated or upside down", "bring it onto the grid of the others with gdalwarp");
    b.transform = {};
    expect(b, "it does not say where it lies", "give it corners with gdal_translate -a_ullr");
    b = at(12, 20, {1, 2});
    b.type = GDT_Int16;
    expect(b, "it holds Int16, not Float64 as " + first, "give it that type with gdal_translate -ot");
    GDALDatasetH feet = create(path("b.tif"), at(12, 20, {1, 2}));
    GDALSetRasterUnitType(GDALGetRasterBand(feet, 1), "ft");
    GDALClose(feet);
    EXPECT_EQ(refusal({"a.tif", "b.tif"}),
              "'" + path("b.tif") +
                  "' cannot be a part of a mosaic: it says that its unit is 'ft', not '' as " + first +
                  "; say what holds with gdal_edit.py -units, or take it off the list.");
    expect_has(refusal({"a.tif", "c.tif"}), "'" + path("c.tif") + "' cannot be opened as a raster: ");
}

TEST_F(ReadMosaic, refusesWhatGdalLeavesOut) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    RasterSpec b = at(12, 20, {1, 2});
    b.bands = 2;
    write(path("b.tif"), b);
    expect_has(refusal({"a.tif", "b.tif"}), "The rasters of the list cannot be made into a mosaic: ");
}

TEST_F(ReadMosaic, isWrittenOrNot) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    try {
        build_mosaic("/nowhere/source.vrt", {path("a.tif")}, 1);
        ADD_FAILURE();
    } catch (const OutputError& error) {
        expect_has(error.what(), "'/nowhere/source.vrt' cannot be written: ");
    }
}

TEST(ReadList, hasANameALine) {
    const std::string list = testing::TempDir() + "d2b_raster_list.txt";
    const auto read = [&](const std::string& text) {
        std::ofstream(list, std::ios::binary) << text;
        return read_raster_list(list);
    };
    EXPECT_EQ(read("a.tif\r\n\n two words.tif \n/vsizip/b.zip/b.tif"),
              (std::vector<std::string>{"a.tif", " two words.tif", "/vsizip/b.zip/b.tif"}));
    for (const std::string nothing : {"", "\n \n"})
        try {
            (void)read(nothing);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), "'" + list + "' names no raster; write the name of one a line into it.");
        }
    std::remove(list.c_str());
    for (const auto& [name, why] :
         {std::pair{list, "No such file or directory"}, std::pair{testing::TempDir(), "Is a directory"}})
        try {
            (void)read_raster_list(name);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), "'" + name + "' cannot be read: " + why +
                                        "; give a text file with the name of a raster a line.");
        }
}

}  // namespace
}  // namespace d2b::test
