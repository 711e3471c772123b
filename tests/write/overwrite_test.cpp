#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

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

TEST_F(OverwriteTest, FoldersAreExchanged) {
    write(to("shapes", "ESRI Shapefile"), 5);
    write(over("shapes", "ESRI Shapefile"), 2);
    EXPECT_EQ(entries(), Names{"shapes"});
    EXPECT_EQ(entries("shapes").size(), 12u);
    EXPECT_EQ(count(path("shapes"), "buildings"), 2);
    EXPECT_EQ(count(path("shapes"), "contours"), 2);
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
            thrown<OptionError>([&, name = name] { write(over(name), 1); }),
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
