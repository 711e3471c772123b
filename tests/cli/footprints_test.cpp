#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "pipeline/made_town.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

std::string corner(double col, double row) {
    return number_text(391000 + col) + " " + number_text(5820000 - row);
}
std::string ring_around(const Box& box) {
    const double right = box.col + box.cols;
    const double bottom = box.row + box.rows;
    return "(" + corner(box.col, box.row) + "," + corner(box.col, bottom) + "," + corner(right, bottom) +
           "," + corner(right, box.row) + "," + corner(box.col, box.row) + ")";
}
std::string polygon(const Box& box) {
    return "POLYGON(" + ring_around(box) + ")";
}

/// On the made town: its flat house, an invalid one over its gable, one far away and one without a polygon.
RowLayer cadastre() {
    RowLayer layer{"cadastre",
                   {{"Height", OFTReal}, {"name"}, {"built", OFTDate}, {"number", OFTInteger}},
                   {},
                   25833,
                   wkbPolygon};
    layer.rows = {
        {polygon(MadeTown::flat), {"6.5", "Rathaus", "1890/05/17", "7"}},
        {"POLYGON((" + corner(80, 20) + "," + corner(102, 20) + "," + corner(102, 32) + "," + corner(84, 32) +
             "," + corner(80, 28) + "," + corner(84, 28) + "," + corner(80, 32) + "," + corner(80, 20) + "))",
         {"9", {}, {}, "-3"}},
        {polygon({5000, 5000, 10, 10}), {{}, "", "2001/01/01", "0"}},
        {"", {"1", "ruin", {}, {}}}};
    return layer;
}

RasterSpec surveyed_town() {
    RasterSpec spec;
    spec.cols = MadeTown::cols;
    spec.rows = MadeTown::rows;
    spec.type = GDT_Float32;
    spec.transform = std::array<double, 6>{391000, 1, 0, 5820000, 0, -1};
    spec.crs = "EPSG:25833";
    spec.values = MadeTown::surface();
    return spec;
}

class Footprints : public OptionEffect {
  protected:
    void SetUp() override {
        OptionEffect::SetUp();
        write(path("town.tif"), surveyed_town());
        write_rows(path("mine.gpkg"), cadastre());
    }
    [[nodiscard]] std::vector<std::string> wkts(const Layer& layer) const {
        std::vector<std::string> all;
        for (const Record& record : layer.records)
            all.push_back(record.geometry() == nullptr ? "" : record.wkt());
        return all;
    }
    const Arguments measure_{"-preset", "buildings", "-q", "-footprints", "mine.gpkg"};
    Arguments with(Arguments more, const std::string& destination = "out.gpkg") const {
        Arguments all = measure_;
        all.insert(all.end(), more.begin(), more.end());
        all.insert(all.end(), {"--", "town.tif", destination});
        return all;
    }
};

const std::vector<std::string> usual_warnings{"the new ones are called d2b_height",
                                              "1 footprint is not valid"};

TEST_F(Footprints, comeBackAsTheyAre) {
    run_warned(with({}), usual_warnings);
    const Layer before = layer("mine.gpkg", "cadastre");
    const Layer after = buildings();
    EXPECT_EQ(after.type, wkbPolygon);
    EXPECT_EQ(after.crs, before.crs);
    EXPECT_EQ(wkts(after), wkts(before));
    ASSERT_EQ(after.records.size(), 4U);
    EXPECT_EQ(std::vector<std::string>(after.fields.begin(), after.fields.begin() + 4),
              (std::vector<std::string>{"Height", "name", "built", "number"}));
    EXPECT_EQ(after.fields[4], "id");
    EXPECT_EQ(after.fields[7], "d2b_height");
    for (std::size_t i = 0; i < 4; ++i)
        for (const std::string& field : before.fields) {
            EXPECT_EQ(after.records[i].is_null(field), before.records[i].is_null(field)) << i << field;
            EXPECT_EQ(after.records[i].text(field), before.records[i].text(field)) << i << field;
        }
    EXPECT_EQ(sql_value(path("out.gpkg"), "SELECT group_concat(fid) FROM buildings"), "1,2,3,4");
    EXPECT_EQ(
        sql_value(path("out.gpkg"), "SELECT type FROM pragma_table_info('buildings') WHERE name = 'built'"),
        "DATE");
}

TEST_F(Footprints, getHeights) {
    run_warned(with({}), usual_warnings);
    const Layer after = buildings();
    ASSERT_EQ(after.records.size(), 4U);
    EXPECT_NEAR(after.records[0].number("p50"), MadeTown::flat_height, 0.3);
    EXPECT_NEAR(after.records[0].number("area_m2"), MadeTown::flat.area(), 0.3);
    EXPECT_NEAR(after.records[1].number("d2b_height"), MadeTown::ridge, 0.5);
    EXPECT_TRUE(after.records[2].is_null("p50"));
    EXPECT_TRUE(after.records[3].is_null("p50"));
    for (const Record& record : after.records)
        EXPECT_EQ(record.text("status"), "given");
    // The podium with its tower has no footprint.
    EXPECT_EQ(layer("out.gpkg", "missing").records.size(), 1U);
    EXPECT_NEAR(layer("out.gpkg", "missing").records[0].area(), MadeTown::podium.area(), 20);
}

TEST_F(Footprints, areCounted) {
    Arguments words = with({});
    words.erase(words.begin() + 2);  // -q
    const ToolResult result = run(words);
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.out.find("2 footprints with heights of 4 (1 outside the raster, 1 without a polygon), "),
              std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find(" and 1 building without a footprint in out.gpkg"), std::string::npos)
        << result.out;
}

TEST_F(Footprints, reportAsJson) {
    const ToolResult result = run(with({"-json"}));
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["footprints"],
              nlohmann::json::parse(R"({"given": 4, "measured": 2, "outside": 1, "without_cell": 0,
                "without_data": 0, "without_polygon": 1, "invalid": 1, "flat": 0, "missing": 1})"));
}

TEST_F(Footprints, mayLieInTheFileOfTheResult) {
    const std::vector<std::string> before = wkts(layer("mine.gpkg", "cadastre"));
    run_warned(with({"-overwrite", "-nln", "measured"}, "mine.gpkg"), usual_warnings);
    EXPECT_EQ(layer_names(path("mine.gpkg")),
              (std::vector<std::string>{"cadastre", "measured", "measured_contours", "measured_missing"}));
    EXPECT_EQ(wkts(layer("mine.gpkg", "cadastre")), before);
    EXPECT_EQ(wkts(layer("mine.gpkg", "measured")), before);
}

TEST_F(Footprints, areNeverReplaced) {
    expect_error(2,
                 "The layer \"cadastre\" of \"mine.gpkg\" is that of -footprints, which -overwrite would "
                 "replace; give another name with -nln.",
                 with({"-overwrite", "-nln", "cadastre"}, "mine.gpkg"));
    run_well({"-preset", "buildings", "-q", "-layers", "buildings", "--", "town.tif", "mine.geojson"});
    expect_error(
        2,
        "\"mine.geojson\" is the file of -footprints, which -overwrite would replace; write to another "
        "file.",
        {"-preset", "buildings", "-q", "-footprints", "mine.geojson", "-overwrite", "--", "town.tif",
         "mine.geojson"});
}

/// A format with one layer gets the footprints alone.
TEST_F(Footprints, fitIntoAGeoJson) {
    run_warned(with({"-layers", "buildings"}, "out.geojson"), usual_warnings);
    const Layer after = layer("out.geojson", "out");
    ASSERT_EQ(after.records.size(), 4U);
    EXPECT_NEAR(after.records[0].number("p50"), MadeTown::flat_height, 0.3);
    EXPECT_EQ(after.records[0].text("name"), "Rathaus");
}

/// This format is tried before the run, and drops features without a geometry.
TEST_F(Footprints, fitIntoAFlatGeobuf) {
    RowLayer layer = cadastre();
    layer.rows.pop_back();
    write_rows(path("drawn.gpkg"), layer);
    run_warned({"-preset", "buildings", "-q", "-footprints", "drawn.gpkg", "--", "town.tif", "out.fgb"},
               {"\"out.fgb\" holds one layer; only the footprints are written; use a GeoPackage for their "
                "contours and for buildings without one.",
                usual_warnings[0], usual_warnings[1]});
    EXPECT_EQ(this->layer("out.fgb", "out").records.size(), 3U);
}

TEST_F(Footprints, mayHaveNoFields) {
    RowLayer layer = cadastre();
    layer.fields.clear();
    layer.rows.resize(1);
    layer.rows[0].values.clear();
    write_rows(path("bare.gpkg"), layer);
    run_warned({"-preset", "buildings", "-q", "-footprints", "bare.gpkg", "--", "town.tif", "out.gpkg"}, {});
    const Layer after = buildings();
    ASSERT_EQ(after.records.size(), 1U);
    EXPECT_EQ(after.fields[0], "id");
    EXPECT_NEAR(after.records[0].number("p50"), MadeTown::flat_height, 0.3);
}

/// Names of the columns of a GeoPackage are free for fields.
TEST_F(Footprints, mayHaveFieldsNamedLikeColumns) {
    RowLayer layer{"odd",
                   {{"fid", OFTInteger}, {"geom"}},
                   {{polygon(MadeTown::flat), {"12", "stone"}}},
                   25833,
                   wkbPolygon,
                   "GeoJSON"};
    write_rows(path("odd.geojson"), layer);
    run_well({"-preset", "buildings", "-q", "-footprints", "odd.geojson", "--", "town.tif", "odd.gpkg"});
    const Layer after = this->layer("odd.gpkg", "buildings");
    ASSERT_EQ(after.records.size(), 1U);
    EXPECT_EQ(after.records[0].number("fid"), 12);
    EXPECT_EQ(after.records[0].text("geom"), "stone");
    EXPECT_NEAR(after.records[0].number("p50"), MadeTown::flat_height, 0.3);
}

TEST_F(Footprints, followTheCrsOfTheOutput) {
    run_warned(with({"-t_srs", "EPSG:4326"}), usual_warnings);
    const Layer after = buildings();
    ASSERT_EQ(after.records.size(), 4U);
    EXPECT_EQ(after.crs, "WGS 84");
    EXPECT_LT(after.records[0].box().MaxX, 180);
    EXPECT_NEAR(after.records[0].number("p50"), MadeTown::flat_height, 0.3);
    EXPECT_NEAR(after.records[0].number("area_m2"), MadeTown::flat.area(), 0.3);
}

TEST_F(Footprints, ofWhichNoneGetsHeights) {
    const auto warned = [&](const std::string& file, const std::string& reason) {
        std::filesystem::remove(path("out.gpkg"));
        run_warned({"-preset", "buildings", "-q", "-footprints", file, "--", "town.tif", "out.gpkg"},
                   {"None of the footprints of '" + file + "' gets heights, because " + reason});
    };
    write_rows(path("far.gpkg"),
               {"far", {}, {{polygon({5000, 5000, 10, 10}), {}}, {"", {}}}, 25833, wkbPolygon});
    warned("far.gpkg",
           "their polygons lie outside of 'town.tif' or the used part of it; check the CRS of both");
    write_rows(path("points.gpkg"), {"points", {}, {{"POINT(391020 5819980)", {}}}, 25833, wkbPoint});
    warned("points.gpkg",
           "they have no polygons; give a dataset of polygons, or another of its layers with "
           "-footprints_layer.");
    const std::string small = "POLYGON((" + corner(25.1, 25.1) + "," + corner(25.3, 25.1) + "," +
                              corner(25.3, 25.3) + "," + corner(25.1, 25.1) + "))";
    write_rows(path("small.gpkg"), {"small", {}, {{small, {}}}, 25833, wkbPolygon});
    warned("small.gpkg", "no centre of a cell of 'town.tif' lies in their polygons; give a raster of finer");
}

TEST_F(Footprints, withMistakes) {
    expect_error(1, "The footprint dataset 'none.gpkg' cannot be opened: ",
                 {"-preset", "buildings", "-q", "-footprints", "none.gpkg", "--", "town.tif", "out.gpkg"});
    expect_error(2, "The footprint dataset 'mine.gpkg' has no layer 'roofs'; it has 'cadastre'.",
                 with({"-footprints_layer", "roofs"}));
    write_rows(path("empty.gpkg"), {"none", {}, {}, 25833, wkbPolygon});
    expect_error(1,
                 "The layer 'none' of the footprint dataset 'empty.gpkg' has no features; give a layer with "
                 "footprints.",
                 {"-preset", "buildings", "-q", "-footprints", "empty.gpkg", "--", "town.tif", "out.gpkg"});
    RasterSpec plain;
    plain.cols = plain.rows = 30;
    plain.crs = "";
    write(path("plain.tif"), plain);
    expect_error(
        1,
        "The footprint dataset 'mine.gpkg' has a coordinate reference system and 'plain.tif' has none; "
        "give the DEM's with -a_srs.",
        {"-preset", "buildings", "-q", "-footprints", "mine.gpkg", "--", "plain.tif", "out.gpkg"}, {}, 1);
}

}  // namespace
}  // namespace d2b::test
