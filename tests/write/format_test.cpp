#include "dem2buildings/open_sinks.hpp"
#include "write/layer_choice.hpp"
#include "write/vector_format.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

WriteOptions named(const std::string& destination, const std::string& format = "") {
    WriteOptions options;
    options.destination = destination;
    options.format = format;
    return options;
}

class FormatTest : public WriteTest {};

TEST_F(FormatTest, ExtensionTellsTheFormat) {
    const std::pair<const char*, const char*> expected[] = {{"a.gpkg", "GPKG"},
                                                            {"a.GPKG", "GPKG"},
                                                            {"a.shp", "ESRI Shapefile"},
                                                            {"a.json", "GeoJSON"},
                                                            {"a.geojson", "GeoJSON"},
                                                            {"a.fgb", "FlatGeobuf"},
                                                            {"a.gml", "GML"},
                                                            {"a.sqlite", "SQLite"},
                                                            {"a.geojsonl", "GeoJSONSeq"},
                                                            {"a.geojsons", "GeoJSONSeq"},
                                                            {"a.csv", "CSV"},
                                                            {"a.b.gpkg", "GPKG"},
                                                            {"x.y/a.gpkg", "GPKG"}};
    for (const auto& [name, format] : expected)
        EXPECT_EQ(format_for(named(name)).name, format) << name;
    // As ogr2ogr, the first of two drivers for an extension.
    EXPECT_EQ(format_for(named("a.kml")).name, GDALGetDriverByName("LIBKML") == nullptr ? "KML" : "LIBKML");
}

TEST_F(FormatTest, FormatIsTakenInAnyCaseAndBeforeTheExtension) {
    EXPECT_EQ(format_for(named("a.geojson", "gpkg")).name, "GPKG");
    EXPECT_EQ(format_for(named("a", "esri shapefile")).name, "ESRI Shapefile");
    EXPECT_TRUE(format_for(named("a", "esri shapefile")).folder);
    EXPECT_TRUE(format_for(named("a.gpkg")).transactions);
    EXPECT_FALSE(format_for(named("a.shp")).transactions);
}

TEST_F(FormatTest, UnusableFormatsAreRefusedWithOthersThatServe) {
    const std::string some = "GPKG, ESRI Shapefile, GeoJSON, FlatGeobuf, GML, KML, SQLite, CSV";
    const auto message = [](const WriteOptions& options) {
        return thrown<OptionError>([&] { static_cast<void>(format_for(options)); });
    };
    EXPECT_EQ(message(named("a.gpkg", "Nonesuch")),
              "There is no format \"Nonesuch\" in this GDAL; -f takes, among others: " + some + ".");
    for (const char* format : {"GTiff", "VICAR", "TopoJSON", "Memory"}) {
        if (GDALGetDriverByName(format) == nullptr)
            continue;
        EXPECT_EQ(message(named("a.gpkg", format)),
                  "Format \"" + std::string(format) +
                      "\" cannot hold a new vector dataset; -f takes, among others: " + some + ".");
    }
    for (const char* name : {"a", "a.tif", "a.gpkg.d/b", "gpkg", "/vsistdout/"})
        EXPECT_EQ(message(named(name)),
                  "The name \"" + std::string(name) +
                      "\" does not tell its format; give it an extension such as .gpkg, or say "
                      "the format with -f: " +
                      some + ", ...");
    EXPECT_EQ(message(named("")), "The name of the destination is empty; give a file, e.g. buildings.gpkg.");
}

TEST_F(FormatTest, KnowsWhatHoldsBothLayers) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.gpkg", ""},
                                                          {"a.sqlite", ""},
                                                          {"a.gml", ""},
                                                          {"a.kml", ""},
                                                          {"a", "ESRI Shapefile"},
                                                          {"a", "CSV"},
                                                          {"a", "FlatGeobuf"},
                                                          {"a", "MapInfo File"}})
        EXPECT_EQ(layers_for(named(name, format)), Layers::both) << name << format;
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.geojson", ""},
                                                          {"a.geojsonl", ""},
                                                          {"a.shp", ""},
                                                          {"a.fgb", ""},
                                                          {"a.csv", ""},
                                                          {"a.tab", ""},
                                                          {"a", "GeoJSON"},
                                                          {"/vsistdout/", "GeoJSON"},
                                                          {"/vsistdout/", "CSV"}})
        EXPECT_EQ(layers_for(named(name, format)), Layers::buildings) << name << format;
}

TEST_F(FormatTest, AskedLayersAreTakenWhereTheyFit) {
    WriteOptions options = named("a.gpkg");
    options.layers = Layers::contours;
    EXPECT_EQ(layers_for(options), Layers::contours);
    options = named("a.geojson");
    options.layers = Layers::contours;
    EXPECT_EQ(layers_for(options), Layers::contours);
    options.layers = Layers::both;
    EXPECT_EQ(
        thrown<OptionError>([&] { static_cast<void>(layers_for(options)); }),
        "\"a.geojson\" holds one layer (format GeoJSON); use -layers buildings or -layers contours, or a "
        "GeoPackage for both.");
}

std::string name_of(const WriteOptions& options, LayerRole role, Layers layers) {
    return d2b::name_of(options, format_for(options), role, layers);
}

TEST_F(FormatTest, LayerNames) {
    WriteOptions options = named("x/city.gpkg");
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "buildings");
    EXPECT_EQ(name_of(options, LayerRole::contours, Layers::both), "contours");
    EXPECT_EQ(name_of(options, LayerRole::doubtful, Layers::both), "doubtful");
    options.layer_name = "blocks";
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "blocks");
    EXPECT_EQ(name_of(options, LayerRole::contours, Layers::both), "blocks_contours");
    EXPECT_EQ(name_of(options, LayerRole::contours, Layers::contours), "blocks");
    EXPECT_EQ(name_of(options, LayerRole::doubtful, Layers::both), "blocks_doubtful");
    EXPECT_EQ(name_of(options, LayerRole::rejected, Layers::both), "blocks_rejected");
    EXPECT_EQ(name_of(options, LayerRole::problems, Layers::both), "blocks_problems");
    EXPECT_EQ(name_of(options, LayerRole::doubtful, Layers::buildings), "blocks_doubtful");
    for (const char* name : {"x/city.shp", "x/city.geojson", "city.fgb", "/vsimem/city.csv"})
        EXPECT_EQ(name_of(named(name), LayerRole::buildings, Layers::buildings), "city") << name;
    const WriteOptions stream = named("/vsistdout/", "GeoJSON");
    EXPECT_EQ(name_of(stream, LayerRole::buildings, Layers::buildings), "buildings");
    EXPECT_EQ(name_of(stream, LayerRole::contours, Layers::contours), "contours");
    const WriteOptions folder = named("city", "ESRI Shapefile");
    EXPECT_EQ(name_of(folder, LayerRole::contours, Layers::both), "contours");
    EXPECT_EQ(name_of(folder, LayerRole::doubtful, Layers::both), "doubtful");
}

TEST_F(FormatTest, NamesOfAllLayersThatAreWritten) {
    WriteOptions options = named("a.gpkg");
    const auto names = [&](Layers layers) { return names_of(options, format_for(options), layers); };
    EXPECT_EQ(names(Layers::both), (Names{"buildings", "contours"}));
    options.doubtful = true;
    EXPECT_EQ(names(Layers::both), (Names{"buildings", "contours", "doubtful"}));
    EXPECT_EQ(names(Layers::contours), (Names{"contours", "doubtful"}));
    options.layer_name = "roofs";
    EXPECT_EQ(names(Layers::buildings), (Names{"roofs", "roofs_doubtful"}));
}

TEST_F(FormatTest, DoubtfulBuildingsNeedALayerOfTheirOwn) {
    WriteOptions options = named("a", "ESRI Shapefile");
    options.doubtful = true;
    EXPECT_EQ(layers_for(options), Layers::both);
    for (const std::optional<Layers> layers :
         {std::optional<Layers>(), {Layers::buildings}, {Layers::contours}}) {
        options = named("a.geojson");
        options.doubtful = true;
        options.layers = layers;
        EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(layers_for(options)); }),
                  "\"a.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -write_doubtful.");
    }
}

}  // namespace

}  // namespace d2b::test
