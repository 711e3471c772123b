#include "read/polygon_layer.hpp"

#include <cmath>
#include <filesystem>

#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "read/rasters.hpp"
#include "score/measure.hpp"
#include "support/error_of.hpp"
#include "support/vector_file.hpp"

namespace d2b::reading {
namespace {

using namespace test;

constexpr const char* square = "POLYGON((0 0,10 0,10 10,0 10,0 0))";

class PolygonLayerTest : public ReadTest {
  protected:
    PolygonLayer read(LayerChoice choice = {}) {
        choice.dataset = path("a.gpkg");
        return read_polygon_layer(choice, heard_);
    }
    template <typename E>
    std::string refusal(LayerChoice choice = {}) {
        return error_of<E>([&] { (void)read(std::move(choice)); });
    }
    [[nodiscard]] std::string file() const { return quoted("a.gpkg"); }
};

TEST_F(PolygonLayerTest, readsPolygonsWithHolesAndHeights) {
    write_layer(
        path("a.gpkg"),
        {"buildings",
         {{"MULTIPOLYGON(((0 0,10 0,10 10,0 10,0 0),(2 2,2 4,4 4,2 2)),((20 0,21 0,21 1,20 0)))", 7.5},
          {square},
          {""},
          {"POLYGON EMPTY"}}});
    const PolygonLayer layer = read({.height_field = "height"});
    EXPECT_EQ(layer.name, "buildings");
    EXPECT_EQ(layer.height_field, "height");
    EXPECT_NE(layer.crs_wkt.find("UTM zone 32N"), std::string::npos);
    ASSERT_EQ(layer.features.size(), 2U);
    const PolygonFeature& first = layer.features[0];
    ASSERT_EQ(first.polygons.size(), 2U);
    EXPECT_EQ(first.polygons[0].exterior, (WorldRing{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
    ASSERT_EQ(first.polygons[0].interiors.size(), 1U);
    EXPECT_EQ(first.polygons[0].interiors[0], (WorldRing{{2, 2}, {2, 4}, {4, 4}}));
    EXPECT_EQ(first.height, 7.5);
    EXPECT_FALSE(first.open_ring);
    EXPECT_FALSE(layer.features[1].height);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(PolygonLayerTest, makesLinesOfCurves) {
    write_layer(path("a.gpkg"), {"buildings", {{"CURVEPOLYGON(CIRCULARSTRING(0 0,2 0,0 0))"}}});
    const PolygonLayer layer = read();
    ASSERT_EQ(layer.features.size(), 1U);
    EXPECT_GT(layer.features[0].polygons.at(0).exterior.size(), 60U);
}

TEST_F(PolygonLayerTest, dropsHeightsOfVertices) {
    write_layer(path("a.gpkg"), {"buildings", {{"POLYGON Z((0 0 5,1 0 5,1 1 5,0 0 5))"}}});
    EXPECT_EQ(read().features.at(0).polygons.at(0).exterior, (WorldRing{{0, 0}, {1, 0}, {1, 1}}));
}

TEST_F(PolygonLayerTest, seesOpenRings) {
    write_layer(path("a.gpkg"), {"buildings", {{"POLYGON((0 0,10 0,10 10,0 10))"}}});
    EXPECT_TRUE(read().features.at(0).open_ring);
}

TEST_F(PolygonLayerTest, leavesOtherGeometriesOutWithAWarning) {
    write_layer(path("a.gpkg"), {"buildings",
                                 {{square},
                                  {"POINT(1 1)"},
                                  {"LINESTRING(0 0,1 1)"},
                                  {"GEOMETRYCOLLECTION(POINT(0 0),POLYGON((0 0,1 0,1 1,0 0)))"}}});
    EXPECT_EQ(read().features.size(), 2U);
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0],
              "2 features of the layer 'buildings' of " + file() + " have no polygon and are left out.");
    write_layer(path("a.gpkg"), {"one", {{"POINT(1 1)"}}});
    (void)read({.layer = "one"});
    EXPECT_EQ(warnings_.back(),
              "1 feature of the layer 'one' of " + file() + " has no polygon and is left out.");
}

TEST_F(PolygonLayerTest, picksLayersByDefault) {
    write_layer(path("a.gpkg"), {.name = "styles", .geometry = wkbNone});
    write_layer(path("a.gpkg"), {.name = "roads"});
    EXPECT_EQ(read().name, "roads");  // the first with geometries
    EXPECT_EQ(read({.defaults = {"buildings"}}).name, "roads");
    write_layer(path("a.gpkg"), {.name = "buildings"});
    write_layer(path("a.gpkg"), {.name = "blocks"});
    EXPECT_EQ(read({.defaults = {"blocks", "buildings"}}).name, "blocks");
    EXPECT_EQ(read({.layer = "roads", .defaults = {"blocks"}}).name, "roads");
    EXPECT_EQ(layer_names(path("a.gpkg"), heard_),
              (std::vector<std::string>{"roads", "buildings", "blocks"}));
}

TEST_F(PolygonLayerTest, namesTheLayersThereAre) {
    write_layer(path("a.gpkg"), {.name = "roads"});
    EXPECT_EQ(refusal<OptionError>({.layer = "houses"}), file() + " has no layer 'houses'; it has 'roads'.");
    write_layer(path("a.gpkg"), {.name = "trees"});
    write_layer(path("a.gpkg"), {.name = "lakes"});
    EXPECT_EQ(refusal<OptionError>({.layer = "houses"}),
              file() + " has no layer 'houses'; it has 'roads', 'trees' and 'lakes'.");
}

TEST_F(PolygonLayerTest, refusesWhatHasNoGeometries) {
    write_layer(path("a.gpkg"), {.name = "table", .geometry = wkbNone});
    EXPECT_EQ(refusal<InputError>(), file() + " has no layer with geometries; give a dataset with polygons.");
}

TEST_F(PolygonLayerTest, refusesWhatCannotBeOpened) {
    expect_has(refusal<InputError>(), file() + " cannot be opened as a vector dataset: ");
}

TEST_F(PolygonLayerTest, refusesDamagedLayers) {
    write_layer(path("a.fgb"), {.name = "a",
                                .features = std::vector<VectorFeature>(50, {square}),
                                .geometry = wkbPolygon,
                                .driver = "FlatGeobuf"});
    const std::string bytes = read_bytes(path("a.fgb"));
    write_text(path("a.fgb"), bytes.substr(0, bytes.size() * 3 / 4));
    LayerChoice choice;
    choice.dataset = path("a.fgb");
    try {
        (void)read_polygon_layer(choice, heard_);
        FAIL();
    } catch (const InputError& error) {
        expect_has(error.what(), "The layer 'a' of '" + path("a.fgb") + "' cannot be read: ");
    }
}

TEST_F(PolygonLayerTest, findsFieldsOfHeights) {
    write_layer(path("a.gpkg"), {.name = "a", .features = {{square, 3}}, .height_field = "roof_h"});
    EXPECT_EQ(read({.default_heights = {"height", "Height", "roof_h"}}).features.at(0).height, 3);
    const PolygonLayer without = read({.default_heights = {"height"}});
    EXPECT_EQ(without.height_field, "");
    EXPECT_FALSE(without.features.at(0).height);
    EXPECT_EQ(refusal<OptionError>({.height_field = "tall"}),
              "The layer 'a' of " + file() + " has no field 'tall'; its fields are 'roof_h'.");
    write_layer(path("a.gpkg"), {.name = "bare", .height_field = ""});
    EXPECT_EQ(refusal<OptionError>({.layer = "bare", .height_field = "tall"}),
              "The layer 'bare' of " + file() + " has no field 'tall'; it has no fields at all.");
}

TEST_F(PolygonLayerTest, takesHeightsFromTexts) {
    write_text(path("a.csv"),
               "WKT,height\n\"POLYGON((0 0,1 0,1 1,0 0))\",12.5\n"
               "\"POLYGON((0 0,1 0,1 1,0 0))\",12 m\n\"POLYGON((0 0,1 0,1 1,0 0))\",nan\n");
    LayerChoice choice;
    choice.dataset = path("a.csv");
    choice.height_field = "height";
    const PolygonLayer layer = read_polygon_layer(choice, heard_);
    ASSERT_EQ(layer.features.size(), 3U);
    EXPECT_EQ(layer.features[0].height, 12.5);
    EXPECT_FALSE(layer.features[1].height);
    EXPECT_FALSE(layer.features[2].height);
    EXPECT_EQ(layer.crs_wkt, "");
}

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
    EXPECT_EQ(cells.middle_cell, (WorldRing{{106, 198}, {108, 198}, {108, 197}, {106, 197}}));
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
    EXPECT_DOUBLE_EQ(score::area_of(cells.polygons), 2 * (24 - 1 - 1 - 4));
    const std::size_t holes = cells.polygons[0].interiors.size() + cells.polygons[1].interiors.size();
    EXPECT_EQ(holes, 1U);
}

TEST_F(ValidCellsTest, followRotatedGrids) {
    RasterSpec rotated = spec();
    rotated.transform = std::array<double, 6>{0, 3, 4, 0, 4, -3};
    set(rotated, 0, 0, -9999);
    write(path("a.tif"), rotated);
    EXPECT_DOUBLE_EQ(score::area_of(valid_cells(path("a.tif"), heard_).polygons), 25 * 23.0);
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

TEST_F(ValidCellsTest, refuseARasterWithoutData) {
    RasterSpec empty = spec();
    empty.values.assign(24, -9999);
    write(path("a.tif"), empty);
    EXPECT_EQ(error_of<InputError>([&] { (void)valid_cells(path("a.tif"), heard_); }),
              "No cell of " + quoted("a.tif") + " has data; give the raster that the footprints come from.");
}

}  // namespace
}  // namespace d2b::reading
