#include <sys/stat.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "write/vector/vector_format.hpp"
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
    EXPECT_STREQ(GDALGetMetadataItem(layer, "source", nullptr), "dem.tif");
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

TEST_F(CreateTest, OneTitleForSeveralLayersIsMadeUnique) {
    WriteOptions options = to("a.gpkg");
    options.layer_options = {"IDENTIFIER=mine"};
    for (const bool overwrite : {false, true}) {
        options.overwrite = overwrite;
        write(options, 7);
        EXPECT_EQ(sql(path("a.gpkg"),
                      "SELECT group_concat(identifier, ', ') FROM (SELECT identifier FROM "
                      "gpkg_contents WHERE data_type = 'features' ORDER BY identifier)"),
                  "mine, mine (contours)");
    }
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
    std::string text = ::testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find("\"name\": \"buildings\""), std::string::npos);
    std::erase(text, ' ');  // GDAL 3.13 has none between properties
    EXPECT_NE(text.find("\"id\":2,\"height\":null,\"status\":\"text2\""), std::string::npos) << text;
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

/// An option without an effect rounds no coordinates.
TEST_F(CreateTest, PrecisionThatADriverDoesNotHaveIsWarnedOf) {
    const std::string option = "COORDINATE_PRECISION";
    const auto sink_of = [&](const std::string& name, bool asked) {
        WriteOptions options = to(name);
        options.layers = Layers::buildings;
        options.layer_options = {"GEOMETRY=AS_WKT"};
        if (name == "a.gml")
            options.layer_options.clear();
        if (asked)
            options.layer_options.push_back(option + "=3");
        auto sink = open_sink(options, callbacks_);
        const LayerSpec spec = layer_spec(sink->layer_name(LayerRole::buildings, Layers::buildings));
        sink->preflight({&spec, 1}, provenance(), {500000.1, 5600000.1});
        sink->begin({&spec, 1}, provenance());
        return sink;
    };
    for (const char* name : {"a.csv", "a.gml"}) {
        if (writing::has_layer_option(writing::format_for(to(name)).driver, option))
            continue;
        const CoordinateRounding usual = sink_of(name, false)->rounding();
        const auto sink = sink_of(name, true);
        EXPECT_EQ(sink->rounding().digits, usual.digits) << name;
        sink->finish();
        const Names warnings = sink->take_warnings();
        ASSERT_EQ(warnings.size(), 1U) << name;
        EXPECT_NE(warnings[0].find(option), std::string::npos) << warnings[0];
    }
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

namespace fs = std::filesystem;

class OverwriteTest : public WriteTest {
  protected:
    [[nodiscard]] WriteOptions over(const std::string& name, const std::string& format = "") const {
        WriteOptions options = to(name, format);
        options.overwrite = true;
        return options;
    }
};

TEST_F(OverwriteTest, ExistingDestinationsNeedAFlag) {
    for (const char* name : {"a.gpkg", "a.geojson", "a.shp"}) {
        write(to(name), 2);
        const std::string before = bytes(name);
        EXPECT_EQ(thrown<OptionError>([&] { write(to(name), 3); }),
                  quote + path(name) +
                      "\" exists; give -overwrite to replace the layers of this run in it, or -append to add "
                      "to them.");
        EXPECT_EQ(bytes(name), before);
    }
    WriteOptions both = over("b.gpkg");
    both.append = true;
    EXPECT_EQ(thrown<OptionError>([&] { write(both, 1); }),
              "-overwrite and -append exclude each other; give one of them.");
}

TEST_F(OverwriteTest, FilesAreReplacedWhole) {
    for (const char* name : {"a.geojson", "a.shp", "a.fgb", "a.csv"}) {
        write(to(name), 5);
        fs::permissions(path(name), fs::perms::owner_read | fs::perms::owner_write);
        const Names before = entries();
        write(over(name), 2);
        EXPECT_EQ(ids(path(name), "a"), (std::vector<std::int64_t>{1, 2})) << name;
        EXPECT_EQ(entries(), before) << name;
        EXPECT_EQ(fs::status(path(name)).permissions(), fs::perms::owner_read | fs::perms::owner_write)
            << name;
    }
}

TEST_F(OverwriteTest, StaleIndexOfAShapefileGoes) {
    write(to("a.shp"), 5);
    sql(path("a.shp"), "CREATE SPATIAL INDEX ON a", true);
    ASSERT_TRUE(fs::exists(path("a.qix")));
    put("a.qml", "a style of the user's");
    write(over("a.shp"), 2);
    EXPECT_FALSE(fs::exists(path("a.qix")));
    EXPECT_EQ(bytes("a.qml"), "a style of the user's");
    EXPECT_EQ(count(path("a.shp"), "a"), 2);
}

TEST_F(OverwriteTest, PackedShapefilesAreFiles) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.shz", ""}, {"b.shp.zip", "ESRI Shapefile"}}) {
        write(to(name, format), 5);
        write(over(name, format), 2);
        EXPECT_EQ(ids(path(name), buildings_layer(to(name, format))), (std::vector<std::int64_t>{1, 2}))
            << name;
    }
    EXPECT_EQ(entries(), (Names{"a.shz", "b.shp.zip"}));
}

TEST_F(OverwriteTest, FoldersAreExchanged) {
    write(to("shapes", "ESRI Shapefile"), 5);
    write(over("shapes", "ESRI Shapefile"), 2);
    EXPECT_EQ(entries(), Names{"shapes"});
    EXPECT_EQ(entries("shapes").size(), 12u);
    EXPECT_EQ(count(path("shapes"), "buildings"), 2);
    EXPECT_EQ(count(path("shapes"), "contours"), 2);
}

TEST_F(OverwriteTest, TheIndexOfAFolderIsReplacedWithIt) {
    if (GDALGetDriverByName("LIBKML") == nullptr)
        GTEST_SKIP() << "this GDAL has no LIBKML";
    write(to("folder", "LIBKML"), 5);
    ASSERT_TRUE(fs::exists(path("folder/doc.kml")));
    write(over("folder", "LIBKML"), 2);
    EXPECT_EQ(count(path("folder"), "buildings"), 2);
    EXPECT_TRUE(fs::exists(path("folder/doc.kml")));
    put("folder/mine.txt", "mine");
    EXPECT_NE(thrown<OptionError>([&] { write(over("folder", "LIBKML"), 2); }).find("mine.txt"),
              std::string::npos);
}

TEST_F(OverwriteTest, ForeignLayersAndFilesAreNotLost) {
    write(to("shapes", "ESRI Shapefile"), 5);
    put("shapes/readme.txt", "mine");
    const auto refusal = [&](const WriteOptions& options) {
        return thrown<OptionError>([&] { write(options, 2); });
    };
    EXPECT_EQ(refusal(over("shapes", "ESRI Shapefile")),
              "The folder \"" + path("shapes") +
                  "\" also holds \"readme.txt\", which -overwrite would touch: folders are replaced whole; "
                  "write to "
                  "another folder or move it away first.");
    fs::remove(path("shapes/readme.txt"));
    add_user_layer(path("shapes"), "roads", 3, "ESRI Shapefile");
    EXPECT_EQ(refusal(over("shapes", "ESRI Shapefile")),
              quote + path("shapes") +
                  "\" also holds layer \"roads\", which -overwrite would lose: ESRI Shapefile datasets are "
                  "replaced "
                  "whole; write to another destination or remove it first.");
    EXPECT_EQ(count(path("shapes"), "roads"), 3);
    EXPECT_EQ(count(path("shapes"), "buildings"), 5);
    write(to("a.kml", "KML"), 1);
    WriteOptions one = over("a.kml", "KML");
    one.layers = Layers::buildings;
    EXPECT_EQ(refusal(one),
              quote + path("a.kml") +
                  "\" also holds layer \"contours\", which -overwrite would lose: KML datasets are "
                  "replaced whole; write to another destination or remove it first.");
    write(over("a.kml", "KML"), 3);
    EXPECT_EQ(count(path("a.kml"), "contours"), 3);
}

TEST_F(OverwriteTest, WhatIsNoDatasetOfTheFormatStays) {
    for (const auto& [name, format] : std::vector<std::pair<std::string, std::string>>{
             {"a.gpkg", "GPKG"}, {"a.geojson", "GeoJSON"}, {"a.shp", "ESRI Shapefile"}}) {
        put(name, "thesis");
        EXPECT_EQ(
            thrown<OptionError>([&, file = name] { write(over(file), 1); }),
            quote + path(name) + "\" exists and is not a dataset of format " + format + "; remove it first.");
        EXPECT_EQ(bytes(name), "thesis");
    }
    fs::create_directory(path("home"));
    put("home/letter.txt", "dear");
    EXPECT_EQ(
        thrown<OptionError>([&] { write(over("home", "ESRI Shapefile"), 1); }),
        quote + path("home") + "\" exists and is not a dataset of format ESRI Shapefile; remove it first.");
    EXPECT_EQ(bytes("home/letter.txt"), "dear");
}

TEST_F(OverwriteTest, ChangesInTheMeantimeAreKept) {
    write(to("a.geojson"), 2);
    const auto sink = open_sink(over("a.geojson"), callbacks_);
    const LayerSpec spec = layer_spec("a");
    sink->begin({&spec, 1}, provenance());
    sink->add(0, square(1));
    put("a.geojson", "somebody else's");
    EXPECT_EQ(thrown<OutputError>([&] { sink->finish(); }),
              quote + path("a.geojson") + "\" changed during this run and was left alone; run again.");
    EXPECT_EQ(bytes("a.geojson"), "somebody else's");
}

TEST_F(OverwriteTest, AFileThatTurnsUpIsKept) {
    const auto sink = open_sink(to("a.geojson"), callbacks_);
    const LayerSpec spec = layer_spec("a");
    sink->begin({&spec, 1}, provenance());
    sink->add(0, square(1));
    put("a.geojson", "somebody else's");
    EXPECT_EQ(
        thrown<OutputError>([&] { sink->finish(); }),
        "Cannot write \"" + path("a.geojson") + "\": the finished result cannot be renamed (File exists).");
    EXPECT_EQ(bytes("a.geojson"), "somebody else's");
}

TEST_F(OverwriteTest, SidecarsOfOthersAreNotReplaced) {
    put("a.dbf", "a table");
    EXPECT_EQ(thrown<OptionError>([&] { write(to("a.shp"), 1); }),
              "Writing \"" + path("a.shp") + "\" would replace \"" + path("a.dbf") +
                  "\"; remove that file first or choose another name.");
    EXPECT_EQ(bytes("a.dbf"), "a table");
    put("my.city.dbf", "a table");
    EXPECT_NE(thrown<OptionError>([&] { write(to("my.city.shp"), 1); }).find(path("my.city.dbf")),
              std::string::npos);
}

TEST_F(OverwriteTest, FilesThatGdalDoesNotListAreReplaced) {
    write(to("a.gml"), 5);
    put("a.xsl", "mine");
    ASSERT_EQ(entries(), (Names{"a.gml", "a.xsd", "a.xsl"}));
    put("a.xsd", "stale");
    write(over("a.gml"), 2);
    EXPECT_EQ(count(path("a.gml"), "buildings"), 2);
    EXPECT_NE(bytes("a.xsd"), "stale");
    WriteOptions alone = over("a.gml");
    alone.dataset_options = {"XSISCHEMA=OFF"};
    write(alone, 2);
    EXPECT_EQ(entries(), (Names{"a.gml", "a.xsl"}));
    WriteOptions table = over("b.csv");
    table.layer_options = {"CREATE_CSVT=YES", "GEOMETRY=AS_WKT"};
    write(table, 5);
    put("b.csvt", "stale");
    write(table, 2);
    EXPECT_EQ(ids(path("b.csv"), "b"), (std::vector<std::int64_t>{1, 2}));
    EXPECT_EQ(entries(), (Names{"a.gml", "a.xsl", "b.csv", "b.csvt", "b.prj"}));
    EXPECT_NE(bytes("b.csvt"), "stale");
}

TEST_F(OverwriteTest, FilesOfAnotherDatasetAreNotReplaced) {
    write(to("a.shp"), 5);
    write(to("a.csv"), 5);
    put("a.prj", bytes("a.prj") + " ");
    const Names before = entries();
    const std::string crs = bytes("a.prj");
    const std::string old = bytes("a.csv");
    WriteOptions table = over("a.csv");
    table.layer_options = {"CREATE_CSVT=YES", "GEOMETRY=AS_WKT"};
    EXPECT_EQ(thrown<OptionError>([&] { write(table, 2); }),
              "Writing \"" + path("a.csv") + "\" would replace \"" + path("a.prj") +
                  "\", a file of \"a.shp\"; choose another name.");
    EXPECT_EQ(entries(), before);
    EXPECT_EQ(bytes("a.prj"), crs);
    EXPECT_EQ(bytes("a.csv"), old);
    put("c.csvt", "mine");
    WriteOptions fresh = to("c.csv");
    fresh.layer_options = {"CREATE_CSVT=YES"};
    EXPECT_EQ(thrown<OptionError>([&] { write(fresh, 2); }),
              "Writing \"" + path("c.csv") + "\" would replace \"" + path("c.csvt") +
                  "\"; remove that file first or choose another name.");
    EXPECT_EQ(bytes("c.csvt"), "mine");
}

TEST_F(OverwriteTest, AFlagOnANewDestinationIsFine) {
    write(over("a.gpkg"), 2);
    WriteOptions append = to("b.gpkg");
    append.append = true;
    EXPECT_EQ(write(append, 2), 1);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 2);
    EXPECT_EQ(count(path("b.gpkg"), "buildings"), 2);
}

}  // namespace

}  // namespace d2b::test
