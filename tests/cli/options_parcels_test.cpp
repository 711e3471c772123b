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

/// What is doubtful of parcels is one sentence with its figure, and the blocks are cut all the same.
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
