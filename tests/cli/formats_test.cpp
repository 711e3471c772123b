#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include <cpl_vsi.h>
#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

/// The result does not depend on the source or destination.
class Formats : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        run_well({"-q", "-fl", "34", "--", sample("nodata.tif"), "reference.gpkg"});
    }
    void expect_as_reference(const Layer& found, const std::string& name) const {
        SCOPED_TRACE(found.name);
        const Layer reference = layer("reference.gpkg", name);
        EXPECT_EQ(found.crs, "ETRS89 / UTM zone 33N");
        EXPECT_EQ(found.fields, reference.fields);
        ASSERT_EQ(found.records.size(), reference.records.size());
        ASSERT_GT(found.records.size(), 2U);
        for (const Record& expected : reference.records) {
            const Record& record = found.where("id", expected.number("id"));
            EXPECT_TRUE(OGR_G_Equals(record.geometry(), expected.geometry()) != 0 ||
                        std::abs(record.area() - expected.area()) < 1e-6);
            for (const std::string& field : reference.fields) {
                ASSERT_EQ(record.is_null(field), expected.is_null(field)) << field;
                if (field == "status") {
                    EXPECT_EQ(record.text(field), expected.text(field));
                } else if (!record.is_null(field)) {
                    EXPECT_NEAR(record.number(field), expected.number(field),
                                1e-9 * std::abs(expected.number(field)))
                        << field;
                }
            }
        }
    }
    void expect_file(const std::string& file, const Arguments& more) const {
        SCOPED_TRACE(file);
        for (const std::string name : {"buildings", "contours"}) {
            Arguments arguments{"-q", "-layers", name, "-fl", "34", "--", sample("nodata.tif"), name + file};
            arguments.insert(arguments.begin(), more.begin(), more.end());
            run_well(arguments);
            const std::vector<std::string> names = layer_names(path(name + file));
            ASSERT_EQ(names.size(), 1U);
            expect_as_reference(layer(name + file, names[0]), name);
        }
    }
    void expect_source(const std::string& source, const ToolSetup& setup = {}) const {
        run_well({"-q", "-fl", "34", "--", source, "out.gpkg"}, setup);
        expect_as_reference(layer("out.gpkg", "buildings"), "buildings");
        expect_as_reference(layer("out.gpkg", "contours"), "contours");
    }
};

/// A placemark has a name that no other has, and a number in its layer, whichever driver writes it.
TEST_F(Formats, kmlNamesEachPlacemarkOnce) {
    for (const char* driver : {"KML", "LIBKML"}) {
        if (GDALGetDriverByName(driver) == nullptr)
            continue;
        const std::string file = std::string(driver) + ".kml";
        run_well({"-q", "-fl", "34", "-f", driver, "--", sample("nodata.tif"), file});  // without a warning
        const std::string text = read_bytes(path(file));
        std::set<std::string> names;
        std::size_t count = 0;
        const std::string tag = "<Placemark id=\"";
        for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1)) {
            names.insert(text.substr(at, text.find('>', at) - at));
            ++count;
        }
        EXPECT_EQ(names.size(), count) << driver;
        for (const char* name : {"buildings", "contours"}) {
            const Layer reference = layer("reference.gpkg", name);
            const Layer found = layer(file, name);
            EXPECT_EQ(found.records.size(), reference.records.size());
            for (const Record& expected : reference.records)
                EXPECT_NO_THROW(static_cast<void>(found.where("id", expected.number("id"))));
        }
    }
}

TEST_F(Formats, geoPackage) {
    EXPECT_EQ(layer_names(path("reference.gpkg")), (std::vector<std::string>{"buildings", "contours"}));
    expect_as_reference(layer("reference.gpkg", "contours"), "contours");
    EXPECT_EQ(sql_value(path("reference.gpkg"), "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(sql_value(path("reference.gpkg"), "SELECT count(*) FROM rtree_contours_geom"),
              sql_value(path("reference.gpkg"), "SELECT count(*) FROM contours"));
}

/// GDAL counts the rows of a view that is listed in the GeoPackage, also while its table is away.
TEST_F(Formats, aListedViewOfAGeoPackageStays) {
    const OpenDataset before(GDALOpenEx(path("reference.gpkg").c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE,
                                        nullptr, nullptr, nullptr));
    for (const char* statement :
         {"CREATE VIEW tall AS SELECT fid, id, geom FROM buildings",
          "INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES ('tall', 'features', "
          "'tall', 25833)",
          "INSERT INTO gpkg_geometry_columns VALUES ('tall', 'geom', 'MULTIPOLYGON', 25833, 0, 0)"})
        GDALDatasetExecuteSQL(before.get(), statement, nullptr, nullptr);
    GDALFlushCache(before.get());
    run_well({"-q", "-overwrite", "-fl", "34", "--", sample("nodata.tif"), "reference.gpkg"});
    EXPECT_EQ(layer("reference.gpkg", "tall").records.size(),
              layer("reference.gpkg", "buildings").records.size());
}

TEST_F(Formats, spatiaLite) {
    run_well({"-q", "-fl", "34", "--", sample("nodata.tif"), "out.sqlite"});
    EXPECT_EQ(layer_names(path("out.sqlite")), (std::vector<std::string>{"buildings", "contours"}));
    expect_as_reference(layer("out.sqlite", "buildings"), "buildings");
}

TEST_F(Formats, shapefileFolder) {
    run_well({"-q", "-f", "ESRI Shapefile", "-fl", "34", "--", sample("nodata.tif"), "folder"});
    for (const char* name : {"buildings", "contours"}) {
        expect_as_reference(layer("folder", name), name);
        for (const char* extension : {".shp", ".shx", ".dbf", ".prj", ".cpg"})
            EXPECT_TRUE(std::filesystem::exists(path(std::string("folder/") + name + extension)));
    }
}

/// Rings of a drawing are those of the layers, and texts are the heights of buildings.
TEST_F(Formats, drawing) {
    run_well({"-q", "-fl", "34", "--", sample("nodata.tif"), "out.dxf"});
    const Layer entities = layer("out.dxf", "entities");
    for (const char* name : {"buildings", "contours"}) {
        std::multiset<double> areas;
        for (const Record& record : entities.records)
            if (record.text("Layer") == name) {
                OGRGeometryH ring = OGR_G_ForceToPolygon(OGR_G_Clone(record.geometry()));
                areas.insert(std::round(OGR_G_Area(ring) * 1000));
                OGR_G_DestroyGeometry(ring);
            }
        std::multiset<double> expected;
        for (const Record& record : layer("reference.gpkg", name).records)
            for (int part = 0; part < OGR_G_GetGeometryCount(record.geometry()); ++part) {
                OGRGeometryH polygon = OGR_G_GetGeometryRef(record.geometry(), part);
                for (int ring = 0; ring < OGR_G_GetGeometryCount(polygon); ++ring)
                    expected.insert(std::round(OGR_G_Area(OGR_G_GetGeometryRef(polygon, ring)) * 1000));
            }
        EXPECT_EQ(areas, expected);
        EXPECT_GT(areas.size(), 2U);
    }
    std::multiset<std::string> texts;
    for (const Record& record : entities.records)
        if (record.text("Layer") == "heights")
            texts.insert(record.text("Text"));
    std::multiset<std::string> expected;
    for (const Record& record : layer("reference.gpkg", "buildings").records) {
        const auto text = [](double height) {
            std::array<char, 40> buffer{};
            std::snprintf(buffer.data(), buffer.size(), height < 10 ? "%.1f" : "%.0f", height);
            return std::string(buffer.data());
        };
        const double p50 = record.number("p50");
        const double p90 = record.number("p90");
        expected.insert((p90 - p50 > 5 ? text(p50) + "-" : "") + text(p90));
    }
    EXPECT_EQ(texts, expected);
}

/// Several rasters, a folder of them and their mosaic are the raster that they were cut from.
TEST_F(Formats, severalSources) {
    std::filesystem::create_directory(path("tiles"));
    for (const char* side : {"west", "east"}) {
        const std::string file = path("tiles/" + std::string(side) + ".tif");
        const bool west = side == std::string("west");
        ASSERT_EQ(run_tool({"gdal_translate", "-q", "-srcwin", west ? "0" : "50", "0", west ? "50" : "70",
                            "100", sample("nodata.tif"), file})
                      .status,
                  0);
    }
    int number = 0;
    const auto expect = [&](const Arguments& sources, const std::string& said, const std::string& name) {
        const std::string out = std::to_string(++number) + ".gpkg";
        Arguments arguments{"-json", "-fl", "34", "--"};
        arguments.insert(arguments.end(), sources.begin(), sources.end());
        arguments.push_back(out);
        EXPECT_EQ(nlohmann::json::parse(run_well(arguments)).at("input").at("name"), name);
        for (const char* role : {"buildings", "contours"})
            expect_as_reference(layer(out, role), role);
        EXPECT_EQ(layer(out, "buildings").metadata.at("D2B_SOURCE"), said);
    };
    expect({"tiles/west.tif", "tiles/east.tif"}, "tiles/west.tif tiles/east.tif",
           "tiles/west.tif and 1 other");
    expect({"tiles"}, "tiles", "tiles");
    expect({"tiles/"}, "tiles/", "tiles/");
    // No raster of a run may be replaced by it, neither as a picture nor as another raster.
    for (const Arguments& sources : {Arguments{"tiles"}, {"tiles/east.tif", "tiles/west.tif"}}) {
        Arguments arguments{"-q", "-preset", "buildings", "-overwrite", "-write_height", "tiles/west.tif"};
        arguments.insert(arguments.end(), sources.begin(), sources.end());
        arguments.emplace_back("out.gpkg");
        expect_error(2, "\"tiles/west.tif\" is already read or written by this run; choose another name.",
                     arguments);
    }
}

TEST_F(Formats, geojsonInMetresGetsAHint) {
    const auto said = [&](const Arguments& more) {
        Arguments arguments{"-fl", "34", "-layers", "buildings", "-overwrite"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ToolResult result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out;
    };
    const std::string hint =
        "The GeoJSON has projected coordinates, but most programs expect degrees: -t_srs EPSG:4326 "
        "writes degrees.\n";
    const std::string file = sample("nodata.tif");
    EXPECT_TRUE(said({file, "out.geojson"}).ends_with(hint));
    EXPECT_TRUE(said({"-f", "GeoJSON", file, "out.json"}).ends_with(hint));
    for (const Arguments& other : {Arguments{"-t_srs", "EPSG:4326", file, "out.geojson"},
                                   {"-lco", "RFC7946=YES", file, "out.geojson"},
                                   {sample("degrees.tif"), "out.geojson"},
                                   {file, "out.gpkg"}})
        EXPECT_EQ(said(other).find("GeoJSON"), std::string::npos);
}

TEST_F(Formats, singleFiles) {
    expect_file(".shp", {});
    expect_file(".geojson", {});
    expect_file(".fgb", {});
    expect_file(".json", {"-f", "GeoJSON"});
}

TEST_F(Formats, standardOutput) {
    const Arguments common{"-f",   "GeoJSON",   "-layers",           "buildings",
                           "-nln", "buildings", sample("nodata.tif")};
    Arguments to_stdout = common;
    to_stdout.push_back("/vsistdout/");
    Arguments to_file = common;
    to_file.insert(to_file.end(), {"-q", "out.geojson"});
    const std::string text = run_well(to_stdout);  // quiet of its own accord
    run_well(to_file);
    EXPECT_GT(text.size(), 1000U);
    EXPECT_EQ(text, read_bytes(path("out.geojson")));
}

TEST_F(Formats, standardInput) {
    expect_source("/vsistdin/", {.stdin_text = read_bytes(sample("nodata.tif"))});
}

TEST_F(Formats, zippedSource) {
    const std::string bytes = read_bytes(sample("nodata.tif"));
    VSILFILE* file = VSIFOpenL(("/vsizip/" + path("dems.zip") + "/folder/nodata.tif").c_str(), "wb");
    ASSERT_NE(file, nullptr);
    EXPECT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), file), bytes.size());
    EXPECT_EQ(VSIFCloseL(file), 0);
    expect_source("/vsizip/" + path("dems.zip") + "/folder/nodata.tif");
}

TEST_F(Formats, virtualSource) {
    const OpenDataset dem(GDALOpen(sample("nodata.tif").c_str(), GA_ReadOnly));
    const OpenDataset copy(GDALCreateCopy(GDALGetDriverByName("VRT"), path("dem.vrt").c_str(), dem.get(),
                                          FALSE, nullptr, nullptr, nullptr));
    ASSERT_TRUE(copy);
    GDALFlushCache(copy.get());
    expect_source("dem.vrt");
}

TEST_F(Formats, sourceInOtherFormats) {
    const OpenDataset dem(GDALOpen(sample("nodata.tif").c_str(), GA_ReadOnly));
    for (const auto& [format, name] : {std::pair("HFA", "dem.img"), {"ENVI", "dem.bin"}}) {
        {
            const OpenDataset copy(GDALCreateCopy(GDALGetDriverByName(format), path(name).c_str(), dem.get(),
                                                  FALSE, nullptr, nullptr, nullptr));
            ASSERT_TRUE(copy) << format;
        }
        run_well({"-q", "-overwrite", "-fl", "34", "--", name, "out.gpkg"});
        EXPECT_EQ(layer("out.gpkg", "contours").sum("n_points"),
                  layer("reference.gpkg", "contours").sum("n_points"))
            << format;
    }
}

/// Names that are not UTF-8, as archives of another time unpack: "Gebäude" in Latin-1.
class WrittenNames : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path(dem_), blocks());
    }
    /// All bytes of all files in the folder but the DEM, and the files' own names.
    [[nodiscard]] std::string written() const {
        std::string bytes;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
            if (entry.is_regular_file() && entry.path().filename() != dem_)
                bytes += read_bytes(entry.path().string());
        return bytes;
    }
    void expect_text(const std::string& of) const {
        const std::string bytes = written();
        EXPECT_NE(bytes.find(readable_), std::string::npos) << of;
        EXPECT_EQ(bytes.find(raw_), std::string::npos) << of;
    }

    const std::string raw_ = "Geb\xE4ude";
    const std::string readable_ = "Geb\xEF\xBF\xBDude";
    const std::string dem_ = raw_ + ".tif";
};

TEST_F(WrittenNames, areTextInEveryFormat) {
    for (const char* extension : {".gpkg", ".sqlite", ".geojson", ".fgb", ".kml", ".jml", ".gml"}) {
        SCOPED_TRACE(extension);
        const std::string file = raw_ + extension;
        // An element of XML cannot have the name.
        const Arguments named = file.ends_with(".gml") ? Arguments{} : Arguments{"-nln", raw_};
        Arguments arguments{"-q", "-layers", "buildings", dem_, file};
        arguments.insert(arguments.begin() + 1, named.begin(), named.end());
        run_well(arguments);
        EXPECT_EQ(written().find(raw_), std::string::npos);
        ASSERT_FALSE(layer_names(path(file)).empty());
        EXPECT_FALSE(layer(file, layer_names(path(file)).front()).records.empty());
        for (const std::string& name : entries())
            if (name != dem_)
                std::filesystem::remove(path(name));
    }
}

TEST_F(WrittenNames, ofFilesAreTextBesideThem) {
    run_well({"-q", "-surface", "town.obj", "-surface", raw_ + ".glb", "-surface", raw_ + ".city.json",
              "-preview", raw_ + ".svg", dem_, raw_ + ".gpkg"});
    for (const char* extension : {".glb", ".city.json", ".svg", ".gpkg"})
        EXPECT_TRUE(std::filesystem::exists(path(raw_ + extension))) << extension;
    expect_text("what is written beside");
}

TEST_F(WrittenNames, ofASingleShapefileKeepTheirBytes) {
    run_well({"-q", "-layers", "buildings", dem_, raw_ + ".shp"});
    for (const char* extension : {".shp", ".dbf", ".qml"})
        EXPECT_TRUE(std::filesystem::exists(path(raw_ + extension))) << extension;
}

TEST_F(WrittenNames, inOptionsOfFormatsAreText) {
    std::filesystem::create_directory(path(raw_));
    run_well({"-q", "-lco", "TEMPORARY_DIR=" + path(raw_), "-layers", "buildings", dem_, "town.fgb"});
    run_well({"-q", "-lco", "IDENTIFIER=" + raw_, "-lco", "DESCRIPTION=" + raw_, "-layers", "buildings", dem_,
              "town.gpkg"});
    expect_text("-lco");
}

TEST_F(WrittenNames, inFieldsOfParcelsAreText) {
    write_text(path("parcels.csv"), "name,WKT\n\"" + raw_ +
                                        "\",\"POLYGON ((391000 5820000,391030 5820000,391030 5819980,391000 "
                                        "5819980,391000 5820000))\"\n");
    const ToolResult result =
        run({"-q", "-preset", "buildings", "-ground", "none", "-min_height", "3", "-min_area", "10",
             "-split_by", "parcels.csv", "-split_field", "name", dem_, "town.gpkg"});
    EXPECT_EQ(result.status, 0) << result.err;
    std::filesystem::remove(path("parcels.csv"));
    expect_text("-split_field");
}

TEST_F(WrittenNames, ofLayersAreFoundAgain) {
    run_well({"-q", "-nln", raw_, dem_, "town.gpkg"});
    run_well({"-q", "-nln", raw_, "-append", dem_, "town.gpkg"});
    const std::size_t twice = layer("town.gpkg", readable_).records.size();
    run_well({"-q", "-nln", raw_, "-overwrite", dem_, "town.gpkg"});
    EXPECT_EQ(2 * layer("town.gpkg", readable_).records.size(), twice);
}

}  // namespace
}  // namespace d2b::test
