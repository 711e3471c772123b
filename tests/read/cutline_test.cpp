#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <ogr_api.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"
#include "read/ring_projection.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

constexpr const char* cell_0 =
    "POLYGON((500000 5538690,500010 5538690,500010 5538680,500000 5538680,500000 5538690))";

/// Cells 10 wide and high from (500000, 5538690) in UTM zone 32, 6 rows and 6 columns, 10 * row + column.
class ReadCutline : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        std::vector<double> values;
        for (int row = 0; row < 6; ++row)
            for (int col = 0; col < 6; ++col)
                values.push_back(10 * row + col);
        spec_ = {.cols = 6,
                 .rows = 6,
                 .values = values,
                 .transform = {{500000, 10, 0, 5538690, 0, -10}},
                 .crs = "EPSG:32632"};
        write(path("dem.tif"), spec_);
    }
    /// Features of GeoJSON geometries.
    void write_cutline(const std::vector<std::string>& geometries, const std::string& crs = "EPSG::32632") {
        std::string text = "{\"type\":\"FeatureCollection\",";
        if (!crs.empty())
            text.append(R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:)")
                .append(crs)
                .append("\"}},");
        text += "\"features\":[";
        for (const std::string& geometry : geometries) {
            text += &geometry == geometries.data() ? "" : ",";
            text += R"({"type":"Feature","properties":{},"geometry":)";
            text += geometry;
            text += "}";
        }
        use("cut.geojson", text + "]}");
    }
    void use(const std::string& name, const std::string& text) {
        write_text(path(name), text);
        options_.cutline = path(name);
    }
    /// The values that are valid, in order.
    std::vector<double> valid(const std::string& name = "dem.tif") {
        std::vector<double> all = values(name);
        std::erase_if(all, [](double value) { return value != value; });
        return all;
    }
    static std::string polygon(const std::string& rings) {
        return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
    }
    static std::string box(const std::string& left, const std::string& bottom, const std::string& right,
                           const std::string& top) {
        return "[[" + left + "," + bottom + "],[" + right + "," + bottom + "],[" + right + "," + top + "],[" +
               left + "," + top + "],[" + left + "," + bottom + "]]";
    }
    RasterSpec spec_;
};

TEST_F(ReadCutline, theCellsWhoseCentresLieInside) {
    write_cutline({polygon(box("500014", "5538656", "500036", "5538674"))});
    // Centres x 5, 15, 25, 35, ...; y 85, 75, 65, 55: of the cells that the box touches only these.
    expect_values(valid(), {21, 22, 23});
    EXPECT_TRUE(warnings_.empty());
}

/// GDAL counts cells in 32 bits, and UTM has no image of places a quarter of the Earth away.
TEST_F(ReadCutline, whatReachesFarBeyondTheDemHoldsIt) {
    for (const char* far : {"1e9", "1e10", "1e15", "1e200"}) {
        const std::string minus = std::string("-") + far;
        write_cutline({polygon(box(minus, minus, far, far))});
        EXPECT_EQ(valid().size(), 36U) << far;
        // All but the first column.
        write_cutline({polygon(box("500010", minus, far, far))});
        EXPECT_EQ(valid().size(), 30U) << far;
    }
    for (const auto& [west, south, east, north] :
         {std::array{"-90", "-80", "90", "80"}, {"-179", "-80", "179", "80"}, {"-180", "-90", "180", "90"}}) {
        write_cutline({polygon(box(west, south, east, north))}, "OGC:1.3:CRS84");
        EXPECT_EQ(valid().size(), 36U) << west;
        write_cutline({polygon(box(west, south, east, north) + "," + box("-10", "-10", "20", "70"))},
                      "OGC:1.3:CRS84");
        EXPECT_EQ(valid().size(), 0U) << west;
    }
    // The meridian of 9 degrees is x = 500000 in UTM zone 32: the western half of a DEM that is moved by 30.
    spec_.transform = {{499970, 10, 0, 5538690, 0, -10}};
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("-180", "-90", "9", "90"))}, "OGC:1.3:CRS84");
    EXPECT_EQ(valid().size(), 18U);
    EXPECT_TRUE(warnings_.empty());
}

/// The window lies on both sides of 180 degrees, and the polygons on one or on both.
TEST_F(ReadCutline, whatReachesFarAcrossTheAntimeridian) {
    spec_.transform = {{819740, 10, 0, 8140198, 0, -10}};  // 180 degrees are at x = 819789 or so
    spec_.crs = "EPSG:32760";
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("-180", "-90", "180", "90"))}, "OGC:1.3:CRS84");
    EXPECT_EQ(valid().size(), 36U);
    write_cutline({polygon(box("0", "-90", "180", "90"))}, "OGC:1.3:CRS84");
    const std::size_t west = valid().size();
    EXPECT_GT(west, 20U);
    EXPECT_LT(west, 36U);
    write_cutline({polygon(box("-180", "-90", "0", "90"))}, "OGC:1.3:CRS84");
    EXPECT_EQ(valid().size(), 36 - west);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadCutline, invalidPointsStayInvalid) {
    spec_.nodata = 22;
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("500014", "5538656", "500036", "5538674"))});
    expect_values(valid(), {21, 23});
}

/// Two triangles of a bow-tie with its waist at (500030, 5538660) are inside, as of two parcels; far from
/// the window nobody needs to know.
TEST_F(ReadCutline, whatIsNotValidIsTakenByTheEvenOddRuleWithAWarning) {
    const std::string tie =
        "[[500000,5538690],[500060,5538630],[500060,5538690],[500000,5538630],"
        "[500000,5538690]]";
    const std::string far_tie =
        "[[600000,5538690],[600060,5538630],[600060,5538690],[600000,5538630],"
        "[600000,5538690]]";
    write_cutline({polygon(tie)});
    EXPECT_EQ(valid().size(), 18U);
    EXPECT_EQ(
        warnings_,
        (std::vector<std::string>{"A polygon of the cutline '" + path("cut.geojson") +
                                  "' is not valid, so the area that an odd number of its rings encloses is "
                                  "used; make it valid, for example by ogr2ogr -makevalid."}));
    warnings_.clear();
    write_cutline({polygon(tie), polygon(tie), polygon(far_tie)});
    EXPECT_EQ(valid().size(), 18U);
    EXPECT_EQ(
        warnings_,
        (std::vector<std::string>{"2 polygons of the cutline '" + path("cut.geojson") +
                                  "' are not valid, so the area that an odd number of their rings encloses "
                                  "is used; make them valid, for example by ogr2ogr -makevalid."}));
    warnings_.clear();
    // Polygons of one feature may overlap: each is taken by itself.
    const std::string box_west = box("500000", "5538670", "500030", "5538690");
    const std::string box_east = box("500010", "5538680", "500040", "5538690");
    write_cutline({R"({"type":"MultiPolygon","coordinates":[[)" + box_west + "],[" + box_east + "]]}",
                   polygon(far_tie)});
    EXPECT_EQ(valid().size(), 7U);
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadCutline, holesAreOutside) {
    write_cutline({polygon(box("500010", "5538640", "500050", "5538680") + "," +
                           box("500020", "5538650", "500040", "5538670"))});
    expect_values(valid(), {11, 12, 13, 14, 21, 24, 31, 34, 41, 42, 43, 44});
}

TEST_F(ReadCutline, overlappingPolygonsAreOneArea) {
    const std::string first = box("500000", "5538670", "500030", "5538690");
    const std::string second = box("500010", "5538680", "500040", "5538690");
    const std::vector<double> expected{0, 1, 2, 3, 10, 11, 12};
    write_cutline({polygon(first), polygon(second)});
    expect_values(valid(), expected);
    write_cutline({R"({"type":"MultiPolygon","coordinates":[[)" + first + "],[" + second + "]]}"});
    expect_values(valid(), expected);
    write_cutline(
        {R"({"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[500000,5538690]},)" +
         polygon(first) + "," + polygon(second) + "]}"});
    expect_values(valid(), expected);
}

TEST_F(ReadCutline, collectionsInCollections) {
    std::string nested = polygon(box("500010", "5538670", "500030", "5538690"));
    for (int i = 0; i < 200; ++i)
        nested = R"({"type":"GeometryCollection","geometries":[)" + nested + "]}";
    write_cutline({nested});
    expect_values(valid(), {1, 2, 11, 12});
}

TEST_F(ReadCutline, trianglesAreAreas) {
    use("cut.csv",
        "id,WKT\n1,\"TIN Z(((500000 5538690 1,500000 5538670 2,500020 5538690 3,500000 5538690 1)))\"\n");
    expect_values(valid(), {0, 1, 10});
}

TEST_F(ReadCutline, whatIsNoPolygonIsPassedOver) {
    write_cutline({R"({"type":"Point","coordinates":[500000,5538690]})", "null",
                   polygon(box("500000", "5538680", "500010", "5538690"))});
    expect_values(valid(), {0});
}

TEST_F(ReadCutline, bandsOfRowsAndWindows) {
    write_cutline({polygon(box("500014", "5538634", "500036", "5538674"))});
    options_.source_window = {2, 1, 3, 5};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    std::vector<double> row(3);
    source->read(whole_rows(*source, 4, 1), row);
    expect_values(row, {42, 43, none});
    source->read(whole_rows(*source, 1, 1), row);
    expect_values(row, {none, none, none});
    source->read(whole_rows(*source, 5, 1), row);
    expect_values(row, {52, 53, none});
    std::vector<double> part(4);
    source->read({4, 3, 2, 2}, part);
    expect_values(part, {43, none, 53, none});
    source->read({1, 2, 2, 2}, part);
    expect_values(part, {none, none, 22, 23});
}

TEST_F(ReadCutline, degreesOverMetres) {
    // By Krueger's series: 9 E 50 N is (500000, 5538630.703), 0.0004 degrees to the east are 28.67 m and
    // 0.0003 to the north 33.36 m.
    write_cutline({polygon(box("9", "50", "9.0004", "50.0003"))}, "OGC:1.3:CRS84");
    expect_values(valid(), {30, 31, 32, 40, 41, 42, 50, 51, 52});
}

TEST_F(ReadCutline, theOrderOfTheAxesIsMinded) {
    // EPSG:4326 has the latitude first, a GML file of it too.
    use("cut.gml",
        "<ogr:FeatureCollection xmlns:ogr=\"http://ogr.maptools.org/\" "
        "xmlns:gml=\"http://www.opengis.net/gml\">"
        "<gml:featureMember><ogr:cut><ogr:geometryProperty>"
        "<gml:Polygon srsName=\"urn:ogc:def:crs:EPSG::4326\"><gml:exterior><gml:LinearRing><gml:posList>"
        "50 9 50 9.0004 50.0003 9.0004 50.0003 9 50 "
        "9</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
        "</ogr:geometryProperty></ogr:cut></gml:featureMember></ogr:FeatureCollection>");
    expect_values(valid(), {30, 31, 32, 40, 41, 42, 50, 51, 52});
}

TEST_F(ReadCutline, aCrsWithHeightsIsCutAsWithout) {
    spec_.crs = "EPSG:32632+5773";
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("9", "50", "9.0004", "50.0003"))}, "OGC:1.3:CRS84");
    expect_values(valid(), {30, 31, 32, 40, 41, 42, 50, 51, 52});
    write_cutline({polygon(box("500014", "5538656", "500036", "5538674"))});
    expect_values(valid(), {21, 22, 23});
}

TEST_F(ReadCutline, edgesBendWithTheirCrs) {
    // On the central meridian 50 N has the northing 5538630.703; at the ends of this edge, 25 km away,
    // 5538689.392.
    RasterSpec spec{
        .cols = 1, .rows = 100, .values = counting(100), .transform = {{499999.5, 1, 0, 5538680, 0, -1}}};
    spec.crs = "EPSG:32632";
    write(path("dem.tif"), spec);
    write_cutline({polygon(box("8.65", "49.9", "9.35", "50"))}, "OGC:1.3:CRS84");
    expect_values(valid(), counting(51, 49));  // centres at 5538679.5 - row
}

TEST_F(ReadCutline, rotatedAndMirroredGrids) {
    // Cell (column 2, row 1) has its centre at (10 + 2.5 + 1.5, 10 + 2.5 - 1.5) = (14, 11).
    spec_.transform = {{10, 1, 1, 10, 1, -1}};
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("13.5", "10.5", "14.5", "11.5"))});
    expect_values(valid(), {12});
    // Centres are at (11 + column + row, 10 + column - row): column + row is 3 or 4, column - row is 0, 1
    // or 2.
    write_cutline({polygon(box("13.1", "9.5", "15.9", "12.5"))});
    expect_values(valid(), {12, 13, 22});
    spec_.transform = {{10, -1, 0, 10, 0, 1}};  // x falls with the column, y grows with the row
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("7", "11", "9", "12"))});
    expect_values(valid(), {11, 12});
}

TEST_F(ReadCutline, arcsBecomeLines) {
    // A circle of radius 12 around the centre of cell (2, 2), (500025, 5538665): its four neighbours are
    // inside.
    use("cut.csv",
        "id,WKT\n1,\"CURVEPOLYGON(CIRCULARSTRING(500013 5538665,500037 5538665,500013 5538665))\"\n");
    expect_values(valid(), {12, 21, 22, 23, 32});
    EXPECT_EQ(warnings_,
              (std::vector<std::string>{
                  "The cutline '" + path("cut.csv") +
                  "' has no coordinate reference system; its coordinates are taken as the DEM's."}));
}

TEST_F(ReadCutline, outsideOfTheDemNothingIsValid) {
    write_cutline({polygon(box("600000", "5538680", "600010", "5538690"))});
    EXPECT_TRUE(valid().empty());
    EXPECT_EQ(warnings_, (std::vector<std::string>{"The cutline '" + path("cut.geojson") +
                                                   "' does not meet the part of '" + path("dem.tif") +
                                                   "' that is used; no point of it is valid."}));
}

TEST_F(ReadCutline, cannotBeOpened) {
    for (const std::string& name : {path("none.gpkg"), std::string("no_such_folder/none.gpkg")}) {
        options_.cutline = name;
        EXPECT_EQ(message<InputError>("dem.tif"),
                  "The cutline '" + name + "' cannot be opened: No such file or directory.");
    }
    options_.cutline = path("dem.tif");
    expect_has(message<InputError>("dem.tif"), "' cannot be opened: ");
}

TEST_F(ReadCutline, hasNoLayer) {
    options_.cutline = "<OGRVRTDataSource></OGRVRTDataSource>";
    EXPECT_EQ(message<InputError>("dem.tif"),
              "The cutline '<OGRVRTDataSource></OGRVRTDataSource>' has no layer with geometries; give a "
              "dataset with polygons.");
}

/// A table without geometries, and two layers that cover cell 0 and cell 12.
void write_layers(const std::string& path) {
    write_layer(path, {.name = "notes", .epsg = 0, .geometry = wkbNone});
    write_layer(path, {.name = "first", .features = {{cell_0}}, .epsg = 32632});
    write_layer(
        path,
        {.name = "second",
         .features =
             {{"POLYGON((500020 5538680,500030 5538680,500030 5538670,500020 5538670,500020 5538680))"}},
         .epsg = 32632});
}

TEST_F(ReadCutline, theLayerIsTheOneThatIsNamed) {
    write_layers(path("cut.gpkg"));
    options_.cutline = path("cut.gpkg");
    options_.cutline_layer = "second";
    expect_values(valid(), {12});
    EXPECT_TRUE(warnings_.empty());
    options_.cutline_layer = "third";
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "The cutline '" + path("cut.gpkg") + "' has no layer 'third'; it has 'first' and 'second'.");
}

TEST_F(ReadCutline, withoutANameTheFirstWithGeometriesIsTakenAndSaid) {
    write_layers(path("cut.gpkg"));
    options_.cutline = path("cut.gpkg");
    expect_values(valid(), {0});
    EXPECT_EQ(warnings_,
              (std::vector<std::string>{"The cutline '" + path("cut.gpkg") +
                                        "' has the layers 'first' and 'second'; 'first' is taken, and "
                                        "-cutline_layer takes another."}));
}

TEST_F(ReadCutline, hasNoPolygons) {
    write_cutline({R"({"type":"Point","coordinates":[500000,5538690]})"});
    EXPECT_EQ(message<InputError>("dem.tif"),
              "The layer 'cut' of the cutline '" + path("cut.geojson") +
                  "' has no polygons; give one that has, for example with -cutline_layer.");
}

TEST_F(ReadCutline, hasACrsWhereTheDemHasNone) {
    spec_.crs = "";
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("9", "50", "9.0004", "50.0003"))}, "OGC:1.3:CRS84");
    EXPECT_EQ(message<InputError>("dem.tif"),
              "The cutline '" + path("cut.geojson") + "' has a coordinate reference system and '" +
                  path("dem.tif") + "' has none; give the DEM's with -a_srs.");
    options_.crs = "EPSG:32632";
    expect_values(valid(), {30, 31, 32, 40, 41, 42, 50, 51, 52});
}

TEST_F(ReadCutline, neitherHasACrs) {
    spec_.crs = "";
    write(path("dem.tif"), spec_);
    use("cut.csv", "id,WKT\n1,\"POLYGON((500000 5538690,500010 5538690,500010 5538680,500000 5538680))\"\n");
    expect_values(valid(), {0});
    ASSERT_EQ(warnings_.size(), 1U);
    expect_has(warnings_[0], path("dem.tif") + "' has no coordinate reference system");
}

/// A GeoPackage says by the numbers 0 and -1 that it knows no CRS, and GDAL makes up one for each.
TEST_F(ReadCutline, aGeoPackageWithoutACrsIsTakenAsOtherFilesWithoutOne) {
    for (const char* number : {"0", "-1"}) {
        const std::string file = path(std::string("cut") + number + ".gpkg");
        write_layer(file, {.name = "cut", .features = {{cell_0}}, .epsg = 0});
        const GDALDatasetH dataset =
            GDALOpenEx(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
        for (const char* table : {"gpkg_contents", "gpkg_geometry_columns"})
            GDALDatasetExecuteSQL(dataset,
                                  ("UPDATE " + std::string(table) + " SET srs_id = " + number).c_str(),
                                  nullptr, nullptr);
        GDALClose(dataset);
        options_.cutline = file;
        expect_values(valid(), {0});
        EXPECT_EQ(warnings_,
                  (std::vector<std::string>{
                      "The cutline '" + file +
                      "' has no coordinate reference system; its coordinates are taken as the DEM's."}))
            << number;
        warnings_.clear();
    }
}

TEST_F(ReadCutline, thereIsNoWayBetweenTheSystems) {
    spec_.crs = R"(LOCAL_CS["site",UNIT["metre",1]])";
    write(path("dem.tif"), spec_);
    write_cutline({polygon(box("9", "50", "9.0004", "50.0003"))}, "OGC:1.3:CRS84");
    const std::string text = message<InputError>("dem.tif");
    EXPECT_EQ(text.rfind("The cutline '" + path("cut.geojson") +
                             "' cannot be converted to the DEM's coordinate reference system: ",
                         0),
              0U)
        << text;
    expect_has(text, "; reproject it first.");
}

TEST_F(ReadCutline, hasAPositionWithoutAnImage) {
    write_cutline({polygon(box("9", "50", "10", "95"))}, "OGC:1.3:CRS84");
    EXPECT_EQ(message<InputError>("dem.tif"),
              "The cutline '" + path("cut.geojson") +
                  "' has a position that has no counterpart in the DEM's coordinate reference system (10, "
                  "95); clip it to the surroundings of the DEM.");
}

TEST_F(ReadCutline, cannotBeReadToItsEnd) {
    write_layer(path("cut.shp"), {.name = "cut",
                                  .features = {{cell_0}},
                                  .epsg = 0,
                                  .geometry = wkbPolygon,
                                  .driver = "ESRI Shapefile"});
    const std::string bytes = read_bytes(path("cut.shp"));
    write_text(path("cut.shp"), bytes.substr(0, bytes.size() - 40));
    options_.cutline = path("cut.shp");
    expect_has(message<InputError>("dem.tif"), "The cutline '" + path("cut.shp") + "' cannot be read: ");
}

}  // namespace
}  // namespace d2b::test

namespace d2b::reading {
namespace {

constexpr ClipBox box{0, 0, 10, 10};

TEST(RingClip, whatLiesWithinIsLeftAsItIs) {
    const WorldRing ring{{1, 1}, {9, 1}, {9, 10}, {1, 1}};
    EXPECT_EQ(clipped(ring, box), ring);
    EXPECT_EQ(clipped(ring, ClipBox{}), ring);
    EXPECT_EQ(clipped({}, box), WorldRing{});
}

TEST(RingClip, whatReachesOutIsCutOff) {
    EXPECT_EQ(clipped({{5, 5}, {15, 5}, {15, 8}, {5, 8}, {5, 5}}, box),
              (WorldRing{{5, 5}, {10, 5}, {10, 8}, {5, 8}, {5, 5}}));
    // Open rings are closed.
    EXPECT_EQ(clipped({{-20, -20}, {30, -20}, {30, 30}, {-20, 30}}, box),
              (WorldRing{{10, 0}, {10, 10}, {0, 10}, {0, 0}, {10, 0}}));
}

TEST(RingClip, whatLiesElsewhereGoes) {
    EXPECT_TRUE(clipped({{15, 5}, {25, 5}, {25, 8}, {15, 5}}, box).empty());
}

TEST(RingClip, farAwayIsFarAway) {
    const WorldRing part = clipped({{5, 5}, {1e200, 5}, {1e200, 8}, {5, 8}, {5, 5}}, box);
    EXPECT_EQ(part, (WorldRing{{5, 5}, {10, 5}, {10, 8}, {5, 8}, {5, 5}}));
}

}  // namespace
}  // namespace d2b::reading
