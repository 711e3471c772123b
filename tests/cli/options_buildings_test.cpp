#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "cli/read_cityjson.hpp"
#include "cli/town_files.hpp"
#include "core/text.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

/// The building at the middle of a box.
const Record& at(const Layer& layer, const Box& box) {
    const Position middle = town_middle(box);
    for (const Record& record : layer.records) {
        const OGREnvelope around = record.box();
        if (around.MinX < middle.x && around.MaxX > middle.x && around.MinY < middle.y &&
            around.MaxY > middle.y)
            return record;
    }
    throw std::runtime_error("no building at row " + std::to_string(box.row));
}

/// A square degree or so around the town, where the terrain lies at 97.5.
RasterSpec terrain_in_degrees() {
    RasterSpec spec;
    spec.cols = spec.rows = 40;
    spec.values.assign(1600, 97.5);
    spec.transform = std::array<double, 6>{13.3, 0.005, 0, 52.6, 0, -0.005};
    spec.crs = "EPSG:4326";
    return spec;
}

}  // namespace

std::string OptionEffect::find(Arguments arguments) const {
    if (!std::filesystem::exists(path("town.tif")))
        write(path("town.tif"), town_raster(MadeTown::surface()));
    std::filesystem::remove(path("out.gpkg"));
    arguments.insert(arguments.begin(), {"-preset", "buildings", "-q", "-overwrite"});
    arguments.insert(arguments.end(), {"--", "town.tif", "out.gpkg"});
    return run_well(arguments);
}

TEST_F(OptionEffect, preset) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    preset_ = "";  // the program's default
    run_well({"-q", "town.tif", "standard.gpkg"});
    find({});
    EXPECT_EQ(layer("standard.gpkg", "buildings").metadata.at("D2B_PRESET"), "buildings");
    ASSERT_EQ(buildings().records.size(), 3U);  // and no tree
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(layer("standard.gpkg", "buildings").records[i].wkt(), buildings().records[i].wkt());
    EXPECT_EQ(contours().count(0), 0);
    run_well({"-preset", "thesis", "-q", "-nf", "4", "-fl", "112", "--", "town.tif", "thesis.gpkg"});
    const Layer thesis = layer("thesis.gpkg", "buildings");
    EXPECT_EQ(thesis.metadata.at("D2B_PRESET"), "thesis");
    EXPECT_GT(thesis.records.size(), 20U);  // trees too
    EXPECT_EQ(layer("thesis.gpkg", "contours").count(0), 1);
    EXPECT_TRUE(thesis.records[0].is_null("confidence"));
}

TEST_F(OptionEffect, ground) {
    find({});
    const double standard = at(buildings(), MadeTown::flat).number("ground");
    find({"-ground", "auto"});
    EXPECT_EQ(at(buildings(), MadeTown::flat).number("ground"), standard);
    EXPECT_EQ(buildings().metadata.at("D2B_GROUND"), "auto");
    write(path("heights.tif"), town_raster(MadeTown::heights()));
    run_well({"-preset", "buildings", "-q", "-ground", "none", "heights.tif", "heights.gpkg"});
    const Layer heights = layer("heights.gpkg", "buildings");
    EXPECT_EQ(heights.records.size(), 3U);
    EXPECT_EQ(heights.sum("ground"), 0);
    EXPECT_EQ(heights.metadata.at("D2B_GROUND"), "none");
    EXPECT_NEAR(at(heights, MadeTown::flat).number("p50"), MadeTown::flat_height, 0.1);
}

TEST_F(OptionEffect, ground__ofATerrainModelInAnotherCrs) {
    write(path("degrees.tif"), terrain_in_degrees());
    write(path("town.tif"), town_raster(MadeTown::surface()));
    // The lawn is up to 9 m above it.
    run_warned(
        {"-preset", "buildings", "-q", "-ground", "degrees.tif", "-min_height", "10", "town.tif", "out.gpkg"},
        {"The terrain 'degrees.tif' lies 5.9 m below the surface"});
    for (const Record& record : buildings().records)
        EXPECT_EQ(record.number("ground"), 97.5);
    EXPECT_NEAR(at(buildings(), MadeTown::podium).number("roof"),
                MadeTown::middle(MadeTown::podium) + MadeTown::tower_height, 0.1);
}

TEST_F(OptionEffect, max_building_width) {
    find({});
    const double standard = at(buildings(), MadeTown::podium).number("ground");
    EXPECT_NEAR(standard, MadeTown::middle(MadeTown::podium), 1);
    // The roof of the podium is ground if ground is looked for no farther than 8 m away; towers are not.
    find({"-max_building_width", "8"});
    double highest = 0;
    for (const Record& record : buildings().records)
        highest = std::max(highest, record.number("ground"));
    EXPECT_GT(highest, standard + 5);
}

TEST_F(OptionEffect, min_height) {
    find({"-min_height", "12"});  // the podium is 9 m high, the tower 25
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_NEAR(buildings().records[0].area(), MadeTown::tower.area(), 0.05 * MadeTown::tower.area());
}

TEST_F(OptionEffect, min_building_height) {
    find({"-write_rejected"});
    const Layer all = buildings();
    const Layer all_contours = contours();
    const Record& flat = at(all, MadeTown::flat);
    const Record& podium = at(all, MadeTown::podium);
    EXPECT_LT(flat.number("p90"), 8);
    EXPECT_GT(podium.number("p90"), 20);  // a tower on a podium of 9 m
    // Uses p90 as it is written, and whole: the podium is kept with the tower, which -min_height cuts out.
    find({"-min_building_height", number_text(podium.number("p90")), "-write_rejected"});
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].wkt(), podium.wkt());
    EXPECT_EQ(contours().records.size(),
              static_cast<std::size_t>(std::ranges::count_if(all_contours.records, [&](const Record& part) {
                  return part.number("bldg_id") == podium.number("id");
              })));
    EXPECT_EQ(contours().metadata.at("D2B_MIN_BUILDING_HEIGHT_M"), number_text(podium.number("p90")));
    const Layer rejected = layer("out.gpkg", "rejected");
    EXPECT_EQ(std::ranges::count_if(
                  rejected.records,
                  [](const Record& record) { return record.text("reason") == "building_not_tall"; }),
              2);
    EXPECT_NE(run_well({"-preset", "buildings", "-overwrite", "-min_building_height", "20", "--", "town.tif",
                        "out.gpkg"})
                  .find("2 below -min_building_height"),
              std::string::npos);
    run_warned({"-preset", "buildings", "-q", "-min_building_height", "100", "--", "town.tif", "none.gpkg"},
               {"No building was found: -min_building_height 100 leaves 3 out; a smaller value may show "
                "them."});
}

TEST_F(OptionEffect, min_confidence) {
    run_well({"-preset", "buildings", "-q", "--", sample("town.tif"), "all.gpkg"});
    const std::vector<Record> all = layer("all.gpkg", "buildings").records;
    // Written values agree with the limit, digit for digit.
    for (const char* limit : {"0.96", "0.99"}) {
        run_well({"-preset", "buildings", "-q", "-overwrite", "-min_confidence", limit, "--",
                  sample("town.tif"), "sure.gpkg"});
        const auto sure = std::ranges::count_if(
            all, [limit](const Record& record) { return record.number("confidence") >= std::stod(limit); });
        EXPECT_LT(sure, static_cast<std::ptrdiff_t>(all.size()));
        EXPECT_EQ(layer("sure.gpkg", "buildings").records.size(), static_cast<std::size_t>(sure)) << limit;
    }
    find({});
    run_warned({"-preset", "buildings", "-q", "-min_confidence", "1", "--", "town.tif", "none.gpkg"},
               {"No building was found: -min_confidence 1 leaves 3 out; a smaller value may show them."});
    EXPECT_EQ(layer("none.gpkg", "buildings").records.size(), 0U);
}

TEST_F(OptionEffect, mask) {
    write(path("mask.tif"), town_raster(MadeTown::in({MadeTown::gabled}, 1, 0)));
    find({"-mask", "mask.tif"});
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_NEAR(at(buildings(), MadeTown::gabled).area(), MadeTown::gabled.area(), 8);
    // Polygons, in degrees, around the flat house and the podium.
    VectorLayer polygons;
    polygons.epsg = 4326;
    polygons.features = {{"POLYGON ((13.393 52.5,13.39463 52.5,13.39463 52.55,13.393 52.55,13.393 52.5))"}};
    write_layer(path("mask.gpkg"), polygons);
    find({"-mask", "mask.gpkg"});
    const Layer found = buildings();
    for (const Record& record : found.records)
        EXPECT_LT(record.box().MaxX, 391085);
    EXPECT_EQ(found.metadata.at("D2B_MASK"), "mask.gpkg");
}

TEST_F(OptionEffect, mask_layer) {
    const auto file = [this](const std::string& name, const Box& box) {
        const auto at = [](int row, int col) {
            return std::to_string(391000 + col) + " " + std::to_string(5820000 - row);
        };
        const int bottom = box.row + box.rows;
        const int right = box.col + box.cols;
        write_text(path(name + ".csv"), "id,WKT\n1,\"POLYGON ((" + at(box.row, box.col) + "," +
                                            at(box.row, right) + "," + at(bottom, right) + "," +
                                            at(bottom, box.col) + "," + at(box.row, box.col) + "))\"\n");
        return "<OGRVRTLayer name=\"" + name + "\"><SrcDataSource relativeToVRT=\"1\">" + name +
               ".csv</SrcDataSource><SrcLayer>" + name +
               "</SrcLayer><LayerSRS>EPSG:25833</LayerSRS>"
               "</OGRVRTLayer>";
    };
    write_text(path("areas.vrt"), "<OGRVRTDataSource>" + file("one", MadeTown::flat) +
                                      file("other", MadeTown::gabled) + "</OGRVRTDataSource>");
    find({"-mask", "areas.vrt", "-mask_layer", "other"});
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_NEAR(at(buildings(), MadeTown::gabled).area(), MadeTown::gabled.area(), 8);
}

TEST_F(OptionEffect, ndvi) {
    find({});
    const double standard = at(buildings(), MadeTown::gabled).number("confidence");
    const double other = at(buildings(), MadeTown::flat).number("confidence");
    write(path("ndvi.tif"), town_raster(MadeTown::in({MadeTown::gabled}, 0.75, -0.125)));
    find({"-ndvi", "ndvi.tif", "-min_confidence", "0"});
    EXPECT_LT(at(buildings(), MadeTown::gabled).number("confidence"), standard);
    EXPECT_EQ(at(buildings(), MadeTown::flat).number("confidence"), other);
    EXPECT_EQ(buildings().metadata.at("D2B_NDVI"), "ndvi.tif");
}

TEST_F(OptionEffect, split_height) {
    find({"-split_height", "5"});
    ASSERT_EQ(buildings().records.size(), 4U);
    double area = 0;
    for (const Record& record : buildings().records)
        area += record.area();
    const double expected = MadeTown::flat.area() + MadeTown::gabled.area() + MadeTown::podium.area();
    EXPECT_NEAR(area, expected, 0.03 * expected);
    find({"-split_height", "20"});  // the tower rises by 16
    EXPECT_EQ(buildings().records.size(), 3U);
}

TEST_F(OptionEffect, levels) {
    const auto thresholds = [&] {
        std::set<double> distinct;
        for (const Record& record : contours().records)
            if (record.number("level") > 1)
                distinct.insert(record.number("threshold"));
        return distinct;
    };
    // Around the podium; of four slices the highest lies between its roof and that of the tower.
    const nlohmann::json report =
        nlohmann::json::parse(find({"-levels", "global", "-srcwin", "25", "70", "46", "42", "-json"}));
    ASSERT_EQ(thresholds().size(), 1U);
    EXPECT_NEAR(
        *thresholds().begin(),
        report["input"]["mean"].get<double>() + 0.6 * report["input"]["standard_deviation"].get<double>(),
        1e-9);
    find({"-levels", "building", "-lod", "1"});
    EXPECT_EQ(thresholds().size(), 2U);  // that of the gabled roof and that of the tower
    EXPECT_EQ(contours().metadata.at("D2B_LEVELS"), "building");
    // Everything of the podium, 16 m lower, is below the break of its tower.
    find({"-levels", "natural", "-lod", "1"});
    EXPECT_EQ(thresholds().size(), 2U);
    for (const Record& record : contours().records) {
        if (record.number("level") != 2 || record.number("tier_z") < 20)
            continue;
        EXPECT_LT(record.number("elev_max") - record.number("elev_min"), 3);
    }
    EXPECT_EQ(contours().metadata.at("D2B_LEVELS"), "natural");
}

TEST_F(OptionEffect, detail) {
    const auto vertices = [&](const char* detail) {
        return nlohmann::json::parse(
                   find({"-levels", "natural", "-detail", detail, "-json"}))["output"]["vertices"]
            .get<int>();
    };
    const int all = vertices("0");
    const int clean = vertices("1");
    EXPECT_LT(clean, all);
    EXPECT_LT(vertices("30"), clean);  // no tower is left, which rises by 16 m
    EXPECT_EQ(contours().metadata.at("D2B_DETAIL_M"), "30");
}

namespace {

std::string rectangle(double left, double low, double right, double high) {
    const auto at = [](double x, double y) {
        return number_text(391000 + x) + " " + number_text(5820000 - y);
    };
    return "POLYGON((" + at(left, low) + "," + at(right, low) + "," + at(right, high) + "," + at(left, high) +
           "," + at(left, low) + "))";
}

constexpr double flat_middle = MadeTown::flat.col + MadeTown::flat.cols / 2.0;
constexpr double podium_middle = MadeTown::podium.row + MadeTown::podium.rows / 2.0;

VectorLayer halves_of_flat() {
    return {"lots",
            {{rectangle(0, 0, flat_middle, 50), 7}, {rectangle(flat_middle, 0, 60, 50), 8}},
            25833,
            "lot",
            OFTInteger};
}

std::set<std::string> parcels_of(const Layer& layer) {
    std::set<std::string> parcels;
    for (const Record& record : layer.records)
        parcels.insert(record.is_null("parcel") ? "none" : record.text("parcel"));
    return parcels;
}

TEST_F(OptionEffect, split_by) {
    write_layer(path("lots.gpkg"), halves_of_flat());
    const nlohmann::json report = nlohmann::json::parse(find({"-split_by", "lots.gpkg", "-json"}));
    ASSERT_EQ(buildings().records.size(), 4U);
    EXPECT_EQ(parcels_of(buildings()), (std::set<std::string>{"1", "2", "none"}));
    for (const Record& record : buildings().records)
        if (!record.is_null("parcel")) {
            EXPECT_NEAR(record.area(), MadeTown::flat.area() / 2, 4);
            EXPECT_NEAR(record.number("p90"), MadeTown::flat_height, 0.5);
            EXPECT_EQ(record.number("num_floors"), 2);
        }
    EXPECT_EQ(buildings().metadata.at("D2B_SPLIT_BY"), "lots.gpkg");
    EXPECT_NEAR(report["parcels"]["cut_length_m"].get<double>(), MadeTown::flat.rows, 4);
    EXPECT_NEAR(report["parcels"]["inside_m2"].get<double>(), MadeTown::flat.area(), 6);
    find({});
    EXPECT_EQ(buildings().records.size(), 3U);
    for (const std::string& field : buildings().fields)
        EXPECT_NE(field, "parcel");
}

/// Half of the flat house and a column; a third of the podium, which a margin makes more than half.
VectorLayer bridges() {
    return {"bridges", {{rectangle(20, 20, 30, 34)}, {rectangle(30, 83, 66, 94)}}, 25833};
}

TEST_F(OptionEffect, exclude) {
    write_layer(path("bridges.gpkg"), bridges());
    const nlohmann::json report = nlohmann::json::parse(find({"-exclude", "bridges.gpkg", "-json"}));
    EXPECT_EQ(buildings().records.size(), 2U);
    at(buildings(), MadeTown::gabled);
    at(buildings(), MadeTown::podium);
    for (const Record& record : contours().records)
        EXPECT_FALSE(record.box().MaxX < 391045 && record.box().MinY > 5819960);
    EXPECT_EQ(report["dropped"]["building_excluded"], 1);
    EXPECT_EQ(buildings().metadata.at("D2B_EXCLUDE"), "bridges.gpkg");
}

/// Footprints are measured all the same; the layer of those without one loses the podium.
TEST_F(OptionEffect, exclude__besideFootprints) {
    write_layer(path("mine.gpkg"), {"mine", {{rectangle(20, 20, 38, 34)}}, 25833, "storeys"});
    write_layer(path("water.gpkg"), {"water", {{rectangle(0, 0, 70, 140)}}, 25833});
    find({"-footprints", "mine.gpkg", "-exclude", "water.gpkg"});
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_NEAR(buildings().records[0].number("p50"), MadeTown::flat_height, 0.5);
    ASSERT_EQ(layer("out.gpkg", "missing").records.size(), 1U);
    at(layer("out.gpkg", "missing"), MadeTown::gabled);
}

TEST_F(OptionEffect, exclude__isNamedWhereItIsMuch) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    write_layer(path("most.gpkg"), {"most", {{rectangle(0, 0, 70, 140)}}, 25833});
    write_layer(path("all.gpkg"), {"all", {{rectangle(0, 0, 170, 140)}}, 25833});
    const auto with = [](const std::string& file) {
        return Arguments{"-preset", "buildings", "-q",       "-overwrite", "-exclude",
                         file,      "--",        "town.tif", "out.gpkg"};
    };
    run_warned(with("most.gpkg"),
               {"-exclude 'most.gpkg' leaves out 2 of 3 buildings that were found; check that its polygons "
                "are bridges, water and the like"});
    EXPECT_EQ(buildings().records.size(), 1U);
    run_warned(with("all.gpkg"), {"No building was found: -exclude 'all.gpkg' leaves out 3 of 3 buildings"});
}

TEST_F(OptionEffect, exclude__isNotReplaced) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    write_layer(path("bridges.geojson"),
                {"bridges", {{rectangle(80, 20, 102, 32)}}, 25833, "", OFTReal, wkbPolygon, "GeoJSON"});
    for (const std::string option : {"-exclude", "-split_by"})
        expect_error(2,
                     "\"bridges.geojson\" is the file of " + option +
                         ", which -overwrite would replace; write to another file.",
                     {"-preset", "buildings", "-q", "-overwrite", option, "bridges.geojson", "-layers",
                      "buildings", "--", "town.tif", "bridges.geojson"});
}

/// A GeoPackage may hold inputs and results, but not under one name.
TEST_F(OptionEffect, exclude__itsLayerIsNotReplaced) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    write_layer(path("city.gpkg"), {"parcels", {{rectangle(0, 0, 170, 140)}}, 25833});
    const auto with = [](const std::string& option, const std::string& name) {
        return Arguments{"-preset", "buildings", "-q", "-overwrite", option,     "city.gpkg",
                         "-nln",    name,        "--", "town.tif",   "city.gpkg"};
    };
    for (const std::string option : {"-exclude", "-split_by", "-mask", "-cutline"})
        expect_error(2,
                     "The layer \"parcels\" of \"city.gpkg\" is that of " + option +
                         ", which -overwrite would replace; give another name with -nln.",
                     with(option, "parcels"));
    EXPECT_EQ(layer("city.gpkg", "parcels").records.size(), 1U);
    run_well(with("-split_by", "found"));
    EXPECT_EQ(layer_names(path("city.gpkg")),
              (std::vector<std::string>{"parcels", "found", "found_contours"}));
}

TEST_F(OptionEffect, exclude_layer) {
    write_layer(path("bridges.gpkg"), bridges());
    write_layer(path("bridges.gpkg"), {"ships", {{rectangle(80, 20, 102, 32)}}, 25833});
    find({"-exclude", "bridges.gpkg", "-exclude_layer", "ships"});
    EXPECT_EQ(buildings().records.size(), 2U);
    at(buildings(), MadeTown::flat);
    at(buildings(), MadeTown::podium);
}

TEST_F(OptionEffect, exclude_buffer) {
    write_layer(path("bridges.gpkg"), bridges());
    write(path("town.tif"), town_raster(MadeTown::surface()));
    run_warned({"-preset", "buildings", "-q", "-exclude", "bridges.gpkg", "-exclude_buffer", "4", "--",
                "town.tif", "out.gpkg"},
               {"-exclude 'bridges.gpkg' leaves out 2 of 3 buildings that were found"});
    ASSERT_EQ(buildings().records.size(), 1U);
    at(buildings(), MadeTown::gabled);
}

/// Points, a line and a polygon in layers of their own: the wood is a building, the flat house is none, and
/// the podium is cut through its middle.
void write_town_corrections(const std::string& path) {
    const std::vector<RowField> kind{{"kind"}};
    write_rows(path, {.name = "points",
                      .fields = kind,
                      .rows = {{"POINT(391029.5 5819973.5)", {"no building"}},
                               {"POINT(391005 5819995)", {"building"}}},
                      .epsg = 25833});
    write_rows(path, {.name = "lines",
                      .fields = kind,
                      .rows = {{"LINESTRING(391036 5819930,391036 5819890)", {"cut"}}},
                      .epsg = 25833});
    write_rows(path, {.name = "areas",
                      .fields = kind,
                      .rows = {{rectangle(105, 80, 145, 120), {"building"}}},
                      .epsg = 25833});
}

TEST_F(OptionEffect, corrections) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    write_town_corrections(path("edits.gpkg"));
    const ToolResult result =
        run({"-preset", "buildings", "-json", "-corrections", "edits.gpkg", "--", "town.tif", "out.gpkg"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find("1 correction of 'edits.gpkg' had no effect: feature 2 of 'points' "
                              "('building'); nothing is there that could be changed"),
              std::string::npos)
        << result.err;
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["corrections"], nlohmann::json::parse(R"({"building": 2, "no_building": 1, "cut": 1,
        "outside": 0, "without_effect": 1, "unusable": 0})"));
    EXPECT_EQ(report["dropped"]["building_denied"], 1);
    // The gable, two parts of the podium and the wood.
    const Layer found = buildings();
    double podium = 0;
    double wood = 0;
    for (const Record& record : found.records) {
        if (record.box().MaxX < 391070) {
            EXPECT_LT(record.box().MaxY, 5819930);
            EXPECT_TRUE(record.box().MaxX < 391037 || record.box().MinX > 391035);
            podium += record.area();
        }
        if (record.box().MinX > 391103) {
            EXPECT_EQ(record.number("confidence"), 1);
            EXPECT_TRUE(record.is_null("doubt"));
            wood += record.area();
        }
    }
    EXPECT_NEAR(podium, MadeTown::podium.area(), 0.03 * MadeTown::podium.area());
    // Four fifths of its cells are trees, and one in seven of these is lower than 2 m.
    EXPECT_GT(wood, 0.5 * MadeTown::wood.area());
    at(found, MadeTown::gabled);
    EXPECT_EQ(found.metadata.at("D2B_CORRECTIONS"), "edits.gpkg");
}

TEST_F(OptionEffect, corrections_layer) {
    write_town_corrections(path("edits.gpkg"));
    find({"-corrections", "edits.gpkg", "-corrections_layer", "lines"});
    EXPECT_EQ(buildings().records.size(), 4U);
    at(buildings(), MadeTown::flat);
}

/// Below the level of certainty only buildings that an editor confirms are left.
TEST_F(OptionEffect, corrections__beatTheLeastConfidence) {
    write_rows(path("edits.gpkg"), {.name = "points",
                                    .fields = {{"kind"}},
                                    .rows = {{"POINT(391029.5 5819973.5)", {"building"}}},
                                    .epsg = 25833});
    find({"-corrections", "edits.gpkg", "-min_confidence", "1"});
    at(buildings(), MadeTown::flat);
    for (const Record& record : buildings().records)
        EXPECT_EQ(record.number("confidence"), 1);
}

TEST_F(OptionEffect, storey_height) {
    find({});
    EXPECT_EQ(at(buildings(), MadeTown::flat).number("num_floors"), 2);
    find({"-storey_height", "3.5"});
    EXPECT_EQ(at(buildings(), MadeTown::flat).number("num_floors"), 2);
    EXPECT_EQ(at(buildings(), MadeTown::podium).number("num_floors"), 7);
    find({"-storey_height", "2.3"});
    EXPECT_EQ(at(buildings(), MadeTown::flat).number("num_floors"), 3);
}

TEST_F(OptionEffect, footprints) {
    write_layer(path("mine.gpkg"), {"mine", {{rectangle(18, 18, 40, 36)}}, 25833, "storeys"});
    find({"-footprints", "mine.gpkg"});
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_NEAR(buildings().records[0].area(), 22 * 18, 1e-3);
    EXPECT_NEAR(buildings().records[0].number("seen"), MadeTown::flat.area() / (22 * 18), 0.01);
    // The ground falls by some decimetres along the footprint.
    EXPECT_NEAR(buildings().records[0].number("p50"), MadeTown::flat_height, 0.5);
    EXPECT_EQ(buildings().metadata.at("D2B_FOOTPRINTS"), "mine.gpkg");
    EXPECT_EQ(layer("out.gpkg", "missing").records.size(), 2U);
}

TEST_F(OptionEffect, footprints_layer) {
    write_layer(path("mine.gpkg"), {"old", {{rectangle(18, 18, 40, 36)}}, 25833, "storeys"});
    write_layer(path("mine.gpkg"),
                {"new", {{rectangle(0, 0, 9, 9)}, {rectangle(18, 18, 40, 36)}}, 25833, "storeys"});
    find({"-footprints", "mine.gpkg", "-footprints_layer", "new"});
    EXPECT_EQ(buildings().records.size(), 2U);
}

/// The two halves are parts of one building.
TEST_F(OptionEffect, split_by__inACityJson) {
    write_layer(path("lots.gpkg"), halves_of_flat());
    find({"-split_by", "lots.gpkg", "-surface", "town.city.json"});
    const ReadCityJson city = read_cityjson(path("town.city.json"));
    EXPECT_EQ(city.solids.size(), 4U);
    ASSERT_EQ(city.parts.size(), 1U);
    std::set<std::string> lots;
    for (const std::string& part : city.parts.begin()->second)
        lots.insert(city.root["CityObjects"][part]["attributes"]["parcel"].get<std::string>());
    EXPECT_EQ(lots, (std::set<std::string>{"1", "2"}));
}

/// A line across the house.
TEST_F(OptionEffect, split_by__lines) {
    const std::string x = number_text(391000 + flat_middle);
    write_layer(path("walls.gpkg"), {"walls", {{"LINESTRING(" + x + " 5819900," + x + " 5820000)"}}, 25833});
    find({"-split_by", "walls.gpkg"});
    EXPECT_EQ(buildings().records.size(), 4U);
    EXPECT_EQ(parcels_of(buildings()), std::set<std::string>{"none"});
}

TEST_F(OptionEffect, split_layer) {
    write_layer(path("lots.gpkg"), halves_of_flat());
    write_layer(
        path("lots.gpkg"),
        {"blocks", {{rectangle(0, 60, 90, podium_middle)}, {rectangle(0, podium_middle, 90, 120)}}, 25833});
    find({"-split_by", "lots.gpkg", "-split_layer", "blocks"});
    EXPECT_EQ(buildings().records.size(), 4U);
    for (const Record& record : buildings().records)
        EXPECT_EQ(record.is_null("parcel"), record.box().MinY > 5819940);
}

TEST_F(OptionEffect, split_field) {
    write_layer(path("lots.gpkg"), halves_of_flat());
    find({"-split_by", "lots.gpkg", "-split_field", "lot"});
    EXPECT_EQ(parcels_of(buildings()), (std::set<std::string>{"7", "8", "none"}));
}

TEST_F(OptionEffect, split_width) {
    write_layer(path("lots.gpkg"), halves_of_flat());
    find({"-split_by", "lots.gpkg", "-split_width", "8"});
    EXPECT_EQ(buildings().records.size(), 4U);
    find({"-split_by", "lots.gpkg", "-split_width", "12"});  // the halves are nine metres wide
    EXPECT_EQ(buildings().records.size(), 3U);
}

/// Doubts about parcels are one sentence with its figure, and the blocks are cut all the same.
class ParcelWarnings : public OptionEffect {
  protected:
    void warned(const VectorLayer& lots, const std::string& sentence, std::size_t buildings_cut) {
        write(path("town.tif"), town_raster(MadeTown::surface()));
        write_layer(path("lots.gpkg"), lots);
        run_warned({"-preset", "buildings", "-q", "-split_by", "lots.gpkg", "--", "town.tif", "out.gpkg"},
                   {sentence});
        EXPECT_EQ(buildings().records.size(), buildings_cut);
    }
};

/// The second lot reaches three metres into the first.
TEST_F(ParcelWarnings, overlap) {
    warned(
        {"lots", {{rectangle(0, 0, flat_middle, 50)}, {rectangle(flat_middle - 3, 0, 60, 50)}}, 25833},
        " % of the building area in parcels of 'lots.gpkg' lies in more than one parcel and goes to the one "
        "with the lowest id; ",
        4);
}

/// A ring around the house that crosses itself beside it.
TEST_F(ParcelWarnings, notValid) {
    std::string ring;
    for (const auto& [x, y] : std::vector<std::pair<double, double>>{
             {0, 0}, {60, 0}, {60, 50}, {3, 50}, {0, 53}, {3, 53}, {0, 50}, {0, 0}})
        ring += (ring.empty() ? "" : ",") + number_text(391000 + x) + " " + number_text(5820000 - y);
    warned({"lots", {{"POLYGON((" + ring + "))"}}, 25833}, "Parcels of 'lots.gpkg' that are invalid hold ",
           3);
}

TEST_F(ParcelWarnings, besideAllBuildings) {
    warned({"lots", {{rectangle(0, 0, 3, 3)}}, 25833},
           "No parcel of 'lots.gpkg' touches a building, so none was cut; give the parcels of the same place",
           3);
}

TEST_F(ParcelWarnings, elsewhere) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    write_layer(path("lots.gpkg"), {"lots", {{rectangle(9000, 0, 9003, 3)}}, 25833});
    expect_error(1, "has no polygon and no line in the part of 'town.tif' that is used; give the parcels of ",
                 {"-preset", "buildings", "-q", "-split_by", "lots.gpkg", "--", "town.tif", "out.gpkg"});
}

}  // namespace
}  // namespace d2b::test
