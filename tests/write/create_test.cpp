#include <sys/stat.h>

#include "dem2buildings/open_sinks.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

class CreateTest : public WriteTest {};

TEST_F(CreateTest, GeoPackageHoldsWhatWasAdded) {
    write(to("a.gpkg"), 5);
    EXPECT_EQ(entries(), Names{"a.gpkg"});
    EXPECT_TRUE(warnings_.empty());
    const Dataset dataset = open_dataset(path("a.gpkg"));
    ASSERT_TRUE(dataset);
    EXPECT_EQ(layer_names(dataset.get()), (Names{"buildings", "contours"}));
    EXPECT_STREQ(GDALGetMetadataItem(dataset.get(), "source", nullptr), "dem.tif");
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset.get(), "buildings");
    EXPECT_EQ(OGR_L_GetGeomType(layer), wkbMultiPolygon);
    EXPECT_STREQ(GDALGetMetadataItem(layer, "thresholds", nullptr), "1, 2");
    EXPECT_STREQ(GDALGetMetadataItem(layer, "IDENTIFIER", nullptr), "Title of buildings");
    EXPECT_STREQ(GDALGetMetadataItem(layer, "DESCRIPTION", nullptr), "What buildings are.");
    EXPECT_STREQ(OSRGetAuthorityCode(OGR_L_GetSpatialRef(layer), nullptr), "25832");
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    ASSERT_EQ(OGR_FD_GetFieldCount(fields), 3);
    EXPECT_EQ(OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, 0)), OFTInteger64);
    EXPECT_EQ(OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, 1)), OFTReal);
    EXPECT_EQ(OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, 2)), OFTString);
    OGRFeatureH feature = OGR_L_GetFeature(layer, 3);
    ASSERT_NE(feature, nullptr);
    EXPECT_EQ(OGR_F_GetFieldAsInteger64(feature, 0), 3);
    EXPECT_EQ(OGR_F_GetFieldAsDouble(feature, 1), 3.25);
    EXPECT_STREQ(OGR_F_GetFieldAsString(feature, 2), "text 3");
    OGREnvelope box;
    OGR_G_GetEnvelope(OGR_F_GetGeometryRef(feature), &box);
    EXPECT_EQ(box.MinX, 3);
    EXPECT_EQ(box.MaxY, 1);
    OGR_F_Destroy(feature);
    feature = OGR_L_GetFeature(layer, 4);
    EXPECT_TRUE(OGR_F_IsFieldNull(feature, 1));
    OGR_F_Destroy(feature);
}

TEST_F(CreateTest, GeoPackageHasItsIndexAndOptions) {
    WriteOptions options = to("a.gpkg");
    options.layer_options = {"IDENTIFIER=mine", "GEOMETRY_NAME=shape"};
    options.dataset_options = {"VERSION=1.3"};
    options.layers = Layers::buildings;
    write(options, 7);
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT COUNT(*) FROM rtree_buildings_shape"), "7");
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT identifier FROM gpkg_contents WHERE table_name = 'buildings'"),
              "mine");
    EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA user_version"), "10300");
    EXPECT_EQ(count(path("a.gpkg"), "contours"), -1);
}

TEST_F(CreateTest, ZAndNoCrs) {
    WriteOptions options = to("a.gpkg");
    const auto sink = open_sink(options, callbacks_);
    const LayerSpec spec = layer_spec("buildings", true);
    sink->begin({&spec, 1}, {});
    sink->add(0, square(1));
    sink->finish();
    const Dataset dataset = open_dataset(path("a.gpkg"));
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
    EXPECT_EQ(OGR_L_GetGeomType(layer), wkbMultiPolygon25D);
    OGRFeatureH feature = OGR_L_GetNextFeature(layer);
    OGRGeometryH ring = OGR_G_GetGeometryRef(OGR_G_GetGeometryRef(OGR_F_GetGeometryRef(feature), 0), 0);
    EXPECT_EQ(OGR_G_GetPointCount(ring), 5);
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(OGR_G_GetZ(ring, i), 7.5);
    OGR_F_Destroy(feature);
}

TEST_F(CreateTest, EmptyLayersAreWritten) {
    for (const char* name : {"a.gpkg", "a.geojson", "a.shp", "a.fgb", "a.sqlite"}) {
        write(to(name), 0);
        const Dataset dataset = open_dataset(path(name));
        ASSERT_TRUE(dataset) << name;
        EXPECT_EQ(OGR_L_GetFeatureCount(GDALDatasetGetLayer(dataset.get(), 0), TRUE), 0) << name;
    }
}

/// A sequence of one GeoJSON object looks like plain GeoJSON, and one of none like nothing.
TEST_F(CreateTest, FewFeatures) {
    for (const char* name : {"city.geojson", "city.fgb", "city.geojsonl", "city.csv", "city.gml"})
        for (const int features : {0, 1}) {
            WriteOptions options = to(name);
            options.layers = Layers::buildings;
            EXPECT_EQ(write(options, features), 1) << name;
            EXPECT_EQ(warnings_, Names()) << name;
            for (const std::string& file : entries())
                std::filesystem::remove(path(file));
        }
}

TEST_F(CreateTest, FilesThatAreOneLayer) {
    for (const char* name :
         {"city.geojson", "city.shp", "city.fgb", "city.geojsonl", "city.csv", "city.tab"}) {
        warnings_.clear();
        write(to(name), 4);
        EXPECT_EQ(ids(path(name), "city"), (std::vector<std::int64_t>{1, 2, 3, 4})) << name;
        EXPECT_EQ(warnings_,
                  Names{quote + path(name) +
                        "\" holds one layer; only the buildings are written; use -layers contours for the "
                        "stack, or a GeoPackage for both."})
            << name;
        const Dataset dataset = open_dataset(path(name));
        OGRFeatureH feature = OGR_L_GetNextFeature(GDALDatasetGetLayer(dataset.get(), 0));
        EXPECT_NE(OGR_F_GetGeometryRef(feature), nullptr) << name;
        OGR_F_Destroy(feature);
    }
}

TEST_F(CreateTest, FoldersAndFilesWithBothLayers) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"shapes", "ESRI Shapefile"},
                                                          {"tables", "CSV"},
                                                          {"buffers", "FlatGeobuf"},
                                                          {"a.gml", "GML"},
                                                          {"a.sqlite", ""},
                                                          {"a.kml", "KML"},
                                                          {"b.kml", ""},
                                                          {"a.gdb", "OpenFileGDB"}}) {
        write(to(name, format), 3);
        EXPECT_EQ(count(path(name), "buildings"), 3) << name;
        EXPECT_EQ(count(path(name), "contours"), 3) << name;
    }
    for (const std::string& entry : entries())
        EXPECT_NE(entry.front(), '.') << entry;
    EXPECT_EQ(entries("shapes"), (Names{"buildings.cpg", "buildings.dbf", "buildings.prj", "buildings.qml",
                                        "buildings.shp", "buildings.shx", "contours.cpg", "contours.dbf",
                                        "contours.prj", "contours.qml", "contours.shp", "contours.shx"}));
}

TEST_F(CreateTest, AnEmptyFolderIsFilled) {
    std::filesystem::create_directory(path("shapes"));
    write(to("shapes", "ESRI Shapefile"), 2);
    EXPECT_EQ(count(path("shapes"), "contours"), 2);
}

TEST_F(CreateTest, LayerNameOption) {
    WriteOptions options = to("a.gpkg");
    options.layer_name = "blocks";
    write(options, 1);
    EXPECT_EQ(count(path("a.gpkg"), "blocks"), 1);
    EXPECT_EQ(count(path("a.gpkg"), "blocks_contours"), 1);
    options.destination = path("b.shp");
    write(options, 1);
    EXPECT_EQ(count(path("b.shp"), "b"), 1);
}

TEST_F(CreateTest, SymbolicLinksAreKept) {
    std::filesystem::create_directory(path("disk"));
    std::filesystem::create_symlink("disk/real.gpkg", path("link.gpkg"));
    write(to("link.gpkg"), 2);
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.gpkg")));
    EXPECT_EQ(count(path("disk/real.gpkg"), "buildings"), 2);
}

TEST_F(CreateTest, MemoryFilesAreWrittenInPlace) {
    WriteOptions options;
    options.destination = "/vsimem/d2b_create_test.gpkg";
    write(options, 3);
    EXPECT_EQ(count(options.destination, "contours"), 3);
    EXPECT_EQ(thrown<OptionError>([&] { write(options, 3); }),
              "\"/vsimem/d2b_create_test.gpkg\" exists; give -overwrite to replace the layers of this run in "
              "it, or "
              "-append to add to them.");
    options.append = true;
    EXPECT_EQ(write(options, 3), 4);
    EXPECT_EQ(count(options.destination, "contours"), 6);
    GDALDeleteDataset(nullptr, options.destination.c_str());
    options = WriteOptions();
    options.destination = "/vsimem/d2b_create_test.fgb";
    write(options, 3);
    options.overwrite = true;
    write(options, 2);
    EXPECT_EQ(count(options.destination, "d2b_create_test"), 2);
    GDALDeleteDataset(nullptr, options.destination.c_str());
}

TEST_F(CreateTest, StandardOutput) {
    ::testing::internal::CaptureStdout();
    WriteOptions options;
    options.destination = "/vsistdout/";
    options.format = "GeoJSON";
    write(options, 2);
    const std::string text = ::testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find("\"name\": \"buildings\""), std::string::npos);
    EXPECT_NE(text.find("\"id\": 2, \"height\": null, \"status\": \"text 2\""), std::string::npos) << text;
}

TEST_F(CreateTest, UnknownCreationOptionsAreWarnedOf) {
    WriteOptions options = to("a.gpkg");
    options.layer_options = {"NONESUCH=1"};
    options.dataset_options = {"NEITHER=1"};
    write(options, 1);
    ASSERT_EQ(warnings_.size(), 2u);
    EXPECT_NE(warnings_[0].find("NEITHER"), std::string::npos) << warnings_[0];
    EXPECT_NE(warnings_[1].find("NONESUCH"), std::string::npos) << warnings_[1];
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 1);
}

TEST_F(CreateTest, FormatsWithoutGeometriesAreWarnedOf) {
    if (GDALGetDriverByName("ODS") == nullptr)
        GTEST_SKIP() << "this GDAL has no ODS driver";
    WriteOptions options = to("a.ods");
    options.layers = Layers::buildings;
    write(options, 1);
    EXPECT_EQ(warnings_, Names{"Layer \"buildings\" of \"" + path("a.ods") +
                               "\" gets no geometries: ODS does not keep them."});
}

TEST_F(CreateTest, AbandonedSinkLeavesNothing) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.gpkg", ""},
                                                          {"a.shp", ""},
                                                          {"shapes", "ESRI Shapefile"},
                                                          {"a.geojson", ""},
                                                          {"a.kml", "KML"}}) {
        {
            const auto sink = open_sink(to(name, format), callbacks_);
            const LayerSpec spec = layer_spec("buildings");
            sink->begin({&spec, 1}, provenance());
            sink->add(0, square(1));
        }
        EXPECT_TRUE(entries().empty()) << name;
    }
}

}  // namespace

}  // namespace d2b::test
