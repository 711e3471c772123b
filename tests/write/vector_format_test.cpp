#include "write/vector/vector_format.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gtest/gtest.h>
#include <ogr_api.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/wkb.hpp"
#include "write/vector/layer_names.hpp"
#include "write/write_fixture.hpp"

namespace d2b::writing {

namespace {

using namespace test;

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
    // Takes the first of two drivers for an extension, as ogr2ogr does.
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
    for (const char* format : {"Nonesuch", "GTiff", "VICAR", "TopoJSON", "Memory"})
        EXPECT_EQ(message(named("a.gpkg", format)),
                  "Format \"" + std::string(format) +
                      "\" cannot hold a new vector dataset; -f takes, among others: " + some + ".");
    for (const char* name : {"a", "a.tif", "a.gpkg.d/b", "gpkg", "/vsistdout/"})
        EXPECT_EQ(message(named(name)), "The name \"" + std::string(name) +
                                            "\" does not show its format; give it an extension such as "
                                            ".gpkg, or give the format with -f: " +
                                            some + ", ...");
    EXPECT_EQ(message(named("")), "The name of the destination is empty; give a file, e.g. buildings.gpkg.");
}

TEST_F(FormatTest, SaysThatThereIsNoPostgresql) {
    const GDALDriverH driver = GDALGetDriverByName("PostgreSQL");
    if (driver != nullptr)
        GDALDeregisterDriver(driver);
    for (const char* name : {"PG:dbname=town", "pg:dbname=town", "postgresql://server/town"})
        EXPECT_EQ(
            thrown<OptionError>([&] { static_cast<void>(format_for(named(name))); }),
            "\"" + std::string(name) +
                "\" is in PostgreSQL, which this program was built without; write a GeoPackage, and load it "
                "with ogr2ogr.");
    if (driver != nullptr)
        GDALRegisterDriver(driver);
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
    return writing::name_of(options, format_for(options), role, layers);
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

/// Of both drivers GDAL says that letters become small, and ' - # become _.
TEST_F(FormatTest, LayersAreCalledAsTheDriverLaundersThem) {
    WriteOptions options = named("a.sqlite");
    options.layer_name = "Town-2026";
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "town_2026");
    EXPECT_EQ(name_of(options, LayerRole::contours, Layers::both), "town_2026_contours");
    options.layer_options = {"LAUNDER=NO"};
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "Town-2026");
    options = named("a.gpkg");
    options.layer_name = "Town-2026";
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "Town-2026");
    if (GDALGetDriverByName("PostgreSQL") == nullptr)
        return;
    options = named("PG:dbname=town");
    for (const auto& [name, laundered] : {std::pair<const char*, const char*>{"Town-2026", "town_2026"},
                                          {"ort#1", "ort_1"},
                                          {"o'hara's", "o_hara_s"},
                                          {"part (1)", "part _1_"},
                                          {"say \"hi\"", "say \"hi\""},
                                          {"\xC3\x84rger", "\xC3\x84rger"}}) {
        options.layer_name = name;
        EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), laundered);
        EXPECT_EQ(name_of(options, LayerRole::contours, Layers::both), std::string(laundered) + "_contours");
    }
    // Room for the suffixes of an index in 63 bytes, or a letter of two bytes may be cut in half.
    options.layer_name.clear();
    for (int i = 0; i < 40; ++i)
        options.layer_name += "\xC3\xA4";
    for (const LayerRole role : {LayerRole::buildings, LayerRole::contours})
        EXPECT_LE(name_of(options, role, Layers::both).size() + std::string("_geom_geom_idx").size(), 63U);
    options.layer_options = {"LAUNDER=NO"};
    options.layer_name = "Town-2026";
    EXPECT_EQ(name_of(options, LayerRole::buildings, Layers::both), "Town-2026");
}

/// PostgreSQL keeps 63 bytes of a name, three of them for the key: no layer may get the name of another.
TEST_F(FormatTest, LongNamesStayApartInPostgreSql) {
    if (GDALGetDriverByName("PostgreSQL") == nullptr)
        return;
    WriteOptions options = named("PG:dbname=town");
    const auto names = [&](const std::string& name) {
        options.layer_name = name;
        return Names{name_of(options, LayerRole::buildings, Layers::both),
                     name_of(options, LayerRole::contours, Layers::both),
                     name_of(options, LayerRole::doubtful, Layers::both)};
    };
    EXPECT_EQ(names(std::string(51, 'a'))[1], std::string(51, 'a') + "_contours");
    EXPECT_EQ(names(std::string(60, 'a'))[0], std::string(60, 'a'));
    std::set<std::string> all;
    for (const char* end : {"x", "y", "\xC3\xA4", "\xC3\xA4\xC3\xA4"})
        for (const std::size_t length : {55U, 62U, 63U, 64U, 80U})
            for (const std::string& name : names(std::string(length, 'a') + end)) {
                EXPECT_LE(name.size(), 60U);
                EXPECT_TRUE(CPLIsUTF8(name.c_str(), -1)) << name;
                all.insert(name);
            }
    EXPECT_EQ(all.size(), 4U * 5U * 3U);
    EXPECT_TRUE(names(std::string(80, 'a'))[1].ends_with("_contours"));
    // A character of two bytes is not cut.
    std::string umlauts;
    for (int i = 0; i < 40; ++i)
        umlauts += "\xC3\xA4";
    for (const std::string& name : names(umlauts))
        EXPECT_TRUE(CPLIsUTF8(name.c_str(), -1)) << name;
}

/// Drivers round as their documentation says of their options.
TEST_F(FormatTest, KnowsHowCoordinatesAreRounded) {
    const auto rounding = [&](const std::string& name, const Names& layer_options) {
        WriteOptions options = to(name);
        options.layer_options = layer_options;
        Provenance of_degrees = provenance();
        of_degrees.crs_wkt = wkt_of(4326);
        const auto sink = open_sink(options, callbacks_);
        sink->preflight(std::vector<LayerSpec>{layer_spec("buildings")}, of_degrees, {13.4, 52.5});
        return sink->rounding();
    };
    using To = CoordinateRounding::To;
    const auto expect = [&](const CoordinateRounding& found, To to, int digits, const std::string& cause) {
        EXPECT_EQ(found.to, to);
        EXPECT_EQ(found.digits, digits);
        EXPECT_EQ(found.cause, cause);
    };
    expect(rounding("a.gpkg", {}), To::nothing, 0, "");
    expect(rounding("a.fgb", {}), To::nothing, 0, "");
    expect(rounding("a.shp", {}), To::nothing, 0, "");
    expect(rounding("a.geojson", {"COORDINATE_PRECISION=3"}), To::decimals, 3, "-lco COORDINATE_PRECISION=3");
    expect(rounding("a.geojson", {"RFC7946=YES"}), To::decimals, 7, "-lco RFC7946=YES");
    expect(rounding("a.geojsonl", {"COORDINATE_PRECISION=5"}), To::decimals, 5,
           "-lco COORDINATE_PRECISION=5");
    // Fifteen significant digits, two of them before the point.
    expect(rounding("a.csv", {}), To::decimals, 13, "The format CSV");
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

}  // namespace d2b::writing

namespace {

std::string as_wkt(const d2b::Feature& feature, bool with_z, bool with_arcs = false) {
    d2b::MultiPolygonWkb wkb(with_z, with_arcs);
    const auto bytes = wkb.encode(feature);
    OGRGeometryH geometry = nullptr;
    EXPECT_EQ(OGR_G_CreateFromWkb(bytes.data(), nullptr, &geometry, static_cast<int>(bytes.size())),
              OGRERR_NONE);
    EXPECT_EQ(OGR_G_WkbSize(geometry), static_cast<int>(bytes.size()));
    char* text = nullptr;
    OGR_G_ExportToIsoWkt(geometry, &text);
    std::string wkt = text;
    CPLFree(text);
    OGR_G_DestroyGeometry(geometry);
    return wkt;
}

TEST(MultiPolygonWkb, APlaceIsAPoint) {
    d2b::Feature feature;
    feature.place = d2b::Position{1.5, -2};
    EXPECT_EQ(as_wkt(feature, false), "POINT (1.5 -2)");
}

d2b::Feature two_parts() {
    d2b::Feature feature;
    feature.parts = {{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{1, 1}, {1, 2}, {2, 2}}, {{5, 5}, {5, 6}, {6, 6}}}},
                     {{{20, 20}, {21, 20}, {20, 21}}, {}}};
    feature.z = 2.5;
    return feature;
}

TEST(MultiPolygonWkb, ClosesRingsAndKeepsTheirOrder) {
    EXPECT_EQ(
        as_wkt(two_parts(), false),
        "MULTIPOLYGON (((0 0,9 0,9 9,0 9,0 0),(1 1,1 2,2 2,1 1),(5 5,5 6,6 6,5 5)),((20 20,21 20,20 21,20 "
        "20)))");
}

TEST(MultiPolygonWkb, GivesEveryVertexTheHeight) {
    d2b::Feature feature = two_parts();
    feature.parts.erase(feature.parts.begin());
    EXPECT_EQ(as_wkt(feature, true), "MULTIPOLYGON Z (((20 20 2.5,21 20 2.5,20 21 2.5,20 20 2.5)))");
}

TEST(MultiPolygonWkb, ArcsAreCircularStrings) {
    d2b::Feature feature = two_parts();
    // A stadium: half circles left and right.
    feature.parts[0] = {{{4, 9}, {3, 6}, {4, 3}, {8, 3}, {9, 6}, {8, 9}}, {}, {{0, 0, 2}, {0, 3, 2}}};
    EXPECT_EQ(as_wkt(feature, false, true),
              "MULTISURFACE (CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (4 9,3 6,4 3),(4 3,8 "
              "3),CIRCULARSTRING (8 3,9 "
              "6,8 9),(8 9,4 9))),((20 20,21 20,20 21,20 20)))");
    EXPECT_EQ(as_wkt(feature, false),
              "MULTIPOLYGON (((4 9,3 6,4 3,8 3,9 6,8 9,4 9)),((20 20,21 20,20 21,20 20)))");
}

TEST(MultiPolygonWkb, AnArcMayGoRoundTheEndOfItsRing) {
    d2b::Feature feature;
    feature.parts = {
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 2}, {2, 3}, {3, 4}, {4, 3}}}, {{1, 2, 2}, {1, 0, 2}}}};
    feature.z = 1;
    EXPECT_EQ(as_wkt(feature, true, true),
              "MULTISURFACE Z (CURVEPOLYGON Z ((0 0 1,9 0 1,9 9 1,0 9 1,0 0 1),COMPOUNDCURVE Z "
              "(CIRCULARSTRING Z (3 2 "
              "1,2 3 1,3 4 1),CIRCULARSTRING Z (3 4 1,4 3 1,3 2 1))))");
}

TEST(MultiPolygonWkb, WhatIsForgottenIsMadeAnew) {
    d2b::Feature ring;
    ring.parts.emplace_back();
    for (int i = 0; i < (1 << 17); ++i)  // 2 MiB
        ring.parts.front().exterior.push_back({1.0 * i, 0.5 * i});
    d2b::MultiPolygonWkb wkb(false);
    const auto first = wkb.encode(ring);
    const std::vector<std::byte> kept(first.begin(), first.end());
    wkb.forget_large();
    EXPECT_LT(wkb.room(), first.size());
    const auto second = wkb.encode(ring);
    EXPECT_TRUE(std::ranges::equal(second, kept));
    wkb.forget_large();
    // 9 bytes of a multipolygon, twice 9 of a polygon, 4 rings of 4, 5 + 4 + 4 + 4 positions of 16.
    EXPECT_EQ(wkb.encode(two_parts()).size(), 9u + 2u * 9u + 4u * 4u + 17u * 16u);
}

TEST(MultiPolygonWkb, RefusesWhatIsNoPolygon) {
    d2b::MultiPolygonWkb wkb(false);
    d2b::Feature feature;
    try {
        static_cast<void>(wkb.encode(feature));
        FAIL();
    } catch (const d2b::OutputError& error) {
        EXPECT_STREQ(error.what(), "A feature without a polygon cannot be written.");
    }
    feature.parts = {{{{0, 0}, {1, 1}}, {}}};
    try {
        static_cast<void>(wkb.encode(feature));
        FAIL();
    } catch (const d2b::OutputError& error) {
        EXPECT_STREQ(error.what(),
                     "A polygon has a ring of fewer than three positions and cannot be written.");
    }
}

}  // namespace
