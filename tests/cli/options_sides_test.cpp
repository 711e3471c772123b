#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>

#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "cli/town_files.hpp"
#include "core/text.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

using Names = std::vector<std::string>;

/// A raster as it was written, with its metadata.
struct WrittenRaster {
    explicit WrittenRaster(const std::string& path) : dataset(GDALOpen(path.c_str(), GA_ReadOnly)) {
        EXPECT_NE(dataset, nullptr) << path;
        cols = GDALGetRasterXSize(dataset.get());
        values.resize(static_cast<std::size_t>(cols * GDALGetRasterYSize(dataset.get())));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dataset.get(), 1), GF_Read, 0, 0, cols,
                               GDALGetRasterYSize(dataset.get()), values.data(), cols,
                               GDALGetRasterYSize(dataset.get()), GDT_Float64, 0, 0),
                  CE_None);
        EXPECT_EQ(GDALGetGeoTransform(dataset.get(), transform.data()), CE_None);
        crs = crs_name(GDALGetProjectionRef(dataset.get()));
        unit = GDALGetRasterUnitType(GDALGetRasterBand(dataset.get(), 1));
    }
    [[nodiscard]] double at(int row, int col) const {
        return values[static_cast<std::size_t>(row * cols + col)];
    }

    OpenDataset dataset;
    int cols = 0;
    std::vector<double> values;
    std::array<double, 6> transform{};
    std::string crs;
    std::string unit;
};

/// True where the outline of a building may leave a cell out.
bool at_corner(int row, int col) {
    return std::ranges::any_of(std::array{MadeTown::flat, MadeTown::gabled, MadeTown::podium},
                               [&](const Box& box) {
                                   return (row == box.row || row == box.row + box.rows - 1) &&
                                          (col == box.col || col == box.col + box.cols - 1);
                               });
}

void expect_town_grid(const WrittenRaster& raster) {
    EXPECT_EQ(raster.values.size(), static_cast<std::size_t>(MadeTown::rows) * MadeTown::cols);
    EXPECT_EQ(raster.transform, (std::array<double, 6>{391000, 1, 0, 5820000, 0, -1}));
    EXPECT_EQ(raster.crs, "ETRS89 / UTM zone 33N");
    EXPECT_EQ(raster.unit, "metre");
}

}  // namespace

TEST_F(OptionEffect, preview) {
    find({"-preview", "map.png"});
    const OpenDataset picture(GDALOpen(path("map.png").c_str(), GA_ReadOnly));
    ASSERT_NE(picture, nullptr);
    EXPECT_EQ(GDALGetRasterCount(picture.get()), 3);
    const int width = GDALGetRasterXSize(picture.get());
    EXPECT_EQ(std::max(width, GDALGetRasterYSize(picture.get())), 1600);
    // The middle of the flat house has the colour of its height, the ground beside it is grey. Around the map
    // there is some white.
    const int margin = 20;
    const double scale = (width - 2.0 * margin) / MadeTown::cols;
    const auto colour = [&](double row, double col) {
        std::array<unsigned char, 3> rgb{};
        EXPECT_EQ(GDALDatasetRasterIO(picture.get(), GF_Read, margin + static_cast<int>(col * scale),
                                      margin + static_cast<int>(row * scale), 1, 1, rgb.data(), 1, 1,
                                      GDT_Byte, 3, nullptr, 3, 3, 1),
                  CE_None);
        return rgb;
    };
    const Box& house = MadeTown::flat;
    const auto roof = colour(house.row + house.rows / 2.0, house.col + house.cols / 2.0);
    EXPECT_GT(roof[0], roof[2] + 50);
    const auto ground = colour(1.5, 1.5);
    EXPECT_EQ(ground[0], ground[2]);
    expect_error(2, "\"map.png\" exists; give another name, or -overwrite to replace it.",
                 {"-preview", "map.png", "town.tif", "again.gpkg"});
    expect_error(2, "a name that ends in .png, .svg or .pdf.",
                 {"-preview", "map.jpg", "town.tif", "again.gpkg"});
}

TEST_F(OptionEffect, preview_paper) {
    find({"-preview", "map.pdf", "-preview_paper", "a3"});
    // 297 x 420 mm are 842 x 1191 points.
    std::smatch box;
    const std::string pdf = read_bytes(path("map.pdf"));
    ASSERT_TRUE(std::regex_search(pdf, box, std::regex("/MediaBox \\[ 0 0 ([0-9.]+) ([0-9.]+) \\]")));
    EXPECT_NEAR(nlohmann::json::parse(box[1].str()).get<double>(), 841.9, 0.5);
    EXPECT_NEAR(nlohmann::json::parse(box[2].str()).get<double>(), 1190.6, 0.5);
    expect_error(2, "-preview_paper must be A0, A1, A2, A3, A4 or A5, not 'a6'.",
                 {"-preview", "map.pdf", "-preview_paper", "a6", "town.tif", "again.gpkg"});
}

TEST_F(OptionEffect, preview_scale) {
    find({"-preview", "map.svg", "-preview_paper", "A5", "-preview_scale", "3000"});
    const std::string half = read_bytes(path("map.svg"));
    find({"-overwrite", "-preview", "map.svg", "-preview_paper", "A5", "-preview_scale", "1500"});
    EXPECT_TRUE(read_bytes(path("map.svg")) != half);
    find({"-overwrite", "-preview", "map.svg", "-preview_paper", "A5", "-preview_scale", "1:3000"});
    EXPECT_TRUE(read_bytes(path("map.svg")) == half);
    for (const char* text : {"1:", "1:half", "2:3000", "1/3000"})
        expect_error(
            2, "-preview_scale must be a number from 1 to 100000000, not '" + std::string(text) + "'.",
            {"-preview", "no.svg", "-preview_paper", "A5", "-preview_scale", text, "town.tif", "no.gpkg"});
    expect_error(
        2, "The area does not fit on A5 at 1:10; use -preview_scale ",
        {"-preview", "large.pdf", "-preview_paper", "A5", "-preview_scale", "10", "town.tif", "large.gpkg"});
}

TEST_F(OptionEffect, landscape) {
    find({"-preview", "map.png", "-preview_paper", "A5", "-landscape"});
    const OpenDataset picture(GDALOpen(path("map.png").c_str(), GA_ReadOnly));
    ASSERT_NE(picture, nullptr);
    EXPECT_EQ(GDALGetRasterXSize(picture.get()), 1240);  // 210 mm at 150 pixels per inch
    EXPECT_EQ(GDALGetRasterYSize(picture.get()), 874);
}

TEST_F(OptionEffect, title) {
    find({"-preview", "map.png"});
    find({"-overwrite", "-preview", "titled.png", "-title", "Old town"});
    const OpenDataset plain(GDALOpen(path("map.png").c_str(), GA_ReadOnly));
    const OpenDataset titled(GDALOpen(path("titled.png").c_str(), GA_ReadOnly));
    // Letters in the row at which a map without a title begins.
    const auto darkest = [](GDALDatasetH picture) {
        std::vector<unsigned char> row(static_cast<std::size_t>(GDALGetRasterXSize(picture)));
        EXPECT_EQ(GDALDatasetRasterIO(picture, GF_Read, 0, 40, GDALGetRasterXSize(picture), 1, row.data(),
                                      GDALGetRasterXSize(picture), 1, GDT_Byte, 1, nullptr, 0, 0, 0),
                  CE_None);
        return std::pair{std::ranges::count(row, 255),
                         std::ranges::count_if(row, [](int v) { return v < 60; })};
    };
    const auto [white, letters] = darkest(titled.get());
    EXPECT_GT(white, 1000);
    EXPECT_GT(letters, 10);
    EXPECT_LT(darkest(plain.get()).first, 100);
}

TEST_F(OptionEffect, credit) {
    find({"-preview", "map.png", "-preview_size", "700"});
    find({"-overwrite", "-preview", "credited.png", "-preview_size", "700", "-credit", "City of Old Town"});
    const OpenDataset plain(GDALOpen(path("map.png").c_str(), GA_ReadOnly));
    const OpenDataset credited(GDALOpen(path("credited.png").c_str(), GA_ReadOnly));
    EXPECT_LE(GDALGetRasterXSize(credited.get()), GDALGetRasterXSize(plain.get()));  // a line of text more
    EXPECT_TRUE(read_bytes(path("map.png")) != read_bytes(path("credited.png")));
}

TEST_F(OptionEffect, preview_size) {
    find({"-preview", "map.png", "-preview_size", "700"});
    const OpenDataset picture(GDALOpen(path("map.png").c_str(), GA_ReadOnly));
    ASSERT_NE(picture, nullptr);
    EXPECT_EQ(std::max(GDALGetRasterXSize(picture.get()), GDALGetRasterYSize(picture.get())), 700);
    find({"-overwrite", "-preview", "map.svg", "-preview_size", "900"});
    std::ifstream svg(path("map.svg"));
    const std::string text((std::istreambuf_iterator<char>(svg)), std::istreambuf_iterator<char>());
    EXPECT_NE(text.find("=\"900px\""), std::string::npos);
    expect_error(2, "-preview_size needs -preview <file>; it is the size of its picture.",
                 {"-preview_size", "700", "town.tif", "again.gpkg"});
    expect_error(2, "-preview_size must be",
                 {"-preview", "a.png", "-preview_size", "299", "town.tif", "a.gpkg"});
}

TEST_F(OptionEffect, write_ground) {
    find({"-write_ground", "ground.tif"});
    const WrittenRaster ground(path("ground.tif"));
    expect_town_grid(ground);
    for (const Box& box : {MadeTown::flat, MadeTown::gabled, MadeTown::podium, Box{120, 20, 10, 10}}) {
        const int row = box.row + box.rows / 2;
        const int col = box.col + box.cols / 2;
        EXPECT_NEAR(ground.at(row, col), MadeTown::ground(row, col), 0.4);
    }
}

TEST_F(OptionEffect, write_height) {
    find({"-write_height", "height.tif", "-write_ground", "ground.tif"});
    const WrittenRaster height(path("height.tif"));
    const WrittenRaster ground(path("ground.tif"));
    expect_town_grid(height);
    const std::vector<double> surface = MadeTown::surface();
    for (std::size_t i = 0; i < surface.size(); ++i)
        ASSERT_NEAR(height.values[i], surface[i] - ground.values[i], 1e-4);
    EXPECT_NEAR(height.at(27, 29), MadeTown::flat_height, 0.5);
}

TEST_F(OptionEffect, write_canopy) {
    find({"-write_canopy", "canopy.tif"});
    const WrittenRaster canopy(path("canopy.tif"));
    expect_town_grid(canopy);
    EXPECT_EQ(canopy.at(27, 29), 0);   // a roof
    EXPECT_EQ(canopy.at(125, 20), 0);  // a lawn
    int trees = 0;
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < MadeTown::cols; ++c) {
            trees += canopy.at(r, c) > 4 ? 1 : 0;
            ASSERT_TRUE(canopy.at(r, c) == 0 || MadeTown::wood.holds(r, c) || at_corner(r, c))
                << r << " " << c;
        }
    EXPECT_GT(trees, 500);
    find({"-write_canopy", "canopy.tif", "-min_height", "8"});  // replaced
    const WrittenRaster higher(path("canopy.tif"));
    EXPECT_TRUE(std::ranges::all_of(higher.values, [](double z) { return z == 0 || z > 8; }));
}

/// Excluded objects are no buildings.
TEST_F(OptionEffect, write_canopy__withExclude) {
    write_layer(path("bridges.gpkg"),
                {"bridges",
                 {{"POLYGON((391020 5819980,391038 5819980,391038 5819966,391020 5819966,391020 5819980))"}},
                 25833});
    find({"-exclude", "bridges.gpkg", "-write_canopy", "canopy.tif"});
    const WrittenRaster canopy(path("canopy.tif"));
    EXPECT_NEAR(canopy.at(27, 29), MadeTown::flat_height, 0.5);
    EXPECT_EQ(canopy.at(26, 91), 0);  // another roof
}

TEST_F(OptionEffect, write_doubtful) {
    const std::string town = sample("town.tif");
    run_well({"-preset", "buildings", "-q", "--", town, "all.gpkg"});
    const std::size_t all = layer("all.gpkg", "buildings").records.size();
    constexpr double limit = 0.99;
    run_well({"-preset", "buildings", "-q", "-write_doubtful", "-min_confidence", number_text(limit), "--",
              town, "out.gpkg"});
    EXPECT_EQ(layer_names(path("out.gpkg")), (Names{"buildings", "contours", "doubtful"}));
    const Layer unsure = layer("out.gpkg", "doubtful");
    ASSERT_GE(unsure.records.size(), 2U);
    EXPECT_EQ(unsure.records.size() + buildings().records.size(), all);
    EXPECT_EQ(unsure.fields, buildings().fields);
    for (const Record& record : unsure.records) {
        EXPECT_LT(record.number("confidence"), limit);
        EXPECT_TRUE(record.valid());
    }
    run_well({"-preset", "buildings", "-q", "-overwrite", "-write_doubtful", "-min_confidence",
              number_text(limit), "-nln", "roofs", "-layers", "buildings", "--", town, "out.gpkg"});
    EXPECT_EQ(layer("out.gpkg", "roofs_doubtful").records.size(), unsure.records.size());
}

namespace {

/// Lowest and highest elevation of the vertices of a feature.
std::pair<double, double> elevations(const Record& record) {
    OGREnvelope3D box{};
    OGR_G_GetEnvelope3D(record.geometry(), &box);
    return {box.MinZ, box.MaxZ};
}

}  // namespace

/// The flat house has one face; the gable rises from 5 to 9 m above the ground over 6 m.
TEST_F(OptionEffect, roofs) {
    find({});
    const Names before = buildings().fields;
    find({"-roofs"});
    EXPECT_EQ(layer_names(path("out.gpkg")), (Names{"buildings", "contours", "roofs"}));
    Names added = before;
    added.insert(added.end(), {"roof_type", "flat_m2", "ridge_z", "eave_z", "roof_rmse"});
    EXPECT_EQ(buildings().fields, added);
    const Layer faces = layer("out.gpkg", "roofs");
    EXPECT_EQ(faces.type, wkbMultiPolygon25D);
    EXPECT_EQ(faces.fields, (Names{"id", "bldg_id", "part_id", "slope", "azimuth", "area_m2", "roof_m2",
                                   "z_low", "z_high", "rmse_m", "n_cells", "kind"}));
    EXPECT_NEAR(faces.sum("area_m2"), buildings().sum("area_m2"), 0.1);
    const double ground = MadeTown::middle(MadeTown::gabled);
    int pitched = 0;
    for (const Record& face : faces.records) {
        EXPECT_TRUE(face.valid());
        const auto [low, high] = elevations(face);
        EXPECT_EQ(face.number("z_low"), low);
        EXPECT_EQ(face.number("z_high"), high);
        if (face.text("kind") != "pitched")
            continue;
        ++pitched;
        EXPECT_NEAR(face.number("slope"), 33.69, 0.5);
        EXPECT_NEAR(std::abs(std::remainder(face.number("azimuth") - 90, 180)), 90, 1);
        EXPECT_NEAR(low, ground + MadeTown::eaves, 0.15);
        EXPECT_NEAR(high, ground + MadeTown::ridge, 0.1);
    }
    EXPECT_EQ(pitched, 2);
    // Ids go on after the largest of all layers.
    const auto count = static_cast<double>(faces.records.size());
    const double largest = std::max(static_cast<double>(contours().records.size()), count);
    run_well({"-preset", "buildings", "-q", "-append", "-roofs", "--", "town.tif", "out.gpkg"});
    EXPECT_EQ(layer("out.gpkg", "roofs").records.size(), 2 * faces.records.size());
    EXPECT_EQ(layer("out.gpkg", "roofs").sum("bldg_id"), 2 * faces.sum("bldg_id") + largest * count);
    EXPECT_EQ(layer("out.gpkg", "roofs").sum("id"), 2 * faces.sum("id") + largest * count);
    find({"-roofs", "-nln", "town", "-layers", "buildings"});
    EXPECT_EQ(layer("out.gpkg", "town_roofs").records.size(), faces.records.size());
}

/// Each face of the gable has 132 m2, the flat roof 252 and the podium 984 without the tower of 168.
TEST_F(OptionEffect, roof_min_area) {
    find({"-roofs"});
    const auto pitched = [&] {
        return std::ranges::count_if(layer("out.gpkg", "roofs").records,
                                     [](const Record& face) { return face.text("kind") == "pitched"; });
    };
    EXPECT_EQ(pitched(), 2);
    EXPECT_EQ(layer("out.gpkg", "roofs").records.size(), 5U);
    find({"-roofs", "-roof_min_area", "150"});
    EXPECT_EQ(layer("out.gpkg", "roofs").records.size(), 4U);
    find({"-roofs", "-roof_min_area", "200"});
    EXPECT_EQ(layer("out.gpkg", "roofs").records.size(), 3U);
    expect_error(2, "-roof_min_area needs -roofs or -surface_of roofs; it is the size of their faces.",
                 {"-preset", "buildings", "-roof_min_area", "15", "town.tif", "again.gpkg"});
    expect_error(2, "-roof_min_area must be",
                 {"-preset", "buildings", "-roofs", "-roof_min_area", "-1", "town.tif", "again.gpkg"});
}

TEST_F(OptionEffect, write_rejected) {
    const std::string town = sample("town.tif");
    preset_ = "thesis";
    run_well({"-q", "-write_rejected", "-nf", "40", "--", town, "out.gpkg"});
    EXPECT_EQ(layer_names(path("out.gpkg")), (Names{"buildings", "contours", "rejected"}));
    const Layer dropped = layer("out.gpkg", "rejected");
    ASSERT_GT(dropped.records.size(), 10U);
    for (const Record& record : dropped.records) {
        EXPECT_TRUE(record.valid());
        EXPECT_GT(record.number("area_m2"), 0);
    }
    run_well({"-q", "-overwrite", "-write_rejected", "-nf", "40", "-nln", "roofs", "--", town, "out.gpkg"});
    EXPECT_EQ(layer("out.gpkg", "roofs_rejected").records.size(), dropped.records.size());
}

TEST_F(OptionEffect, fields) {
    find({"-fields", "own"});
    const Names own = buildings().fields;
    const double height = buildings().records[0].number("p90");
    const auto changed = [&](const char* names) {
        std::filesystem::remove(path("out.gpkg"));
        find({"-fields", names});
        Names others;
        for (const std::string& field : buildings().fields)
            if (std::ranges::count(own, field) == 0)
                others.push_back(field);
        EXPECT_EQ(buildings().fields.size(), own.size());
        EXPECT_EQ(std::ranges::count(contours().fields, "bldg_id"), 1);  // contours have theirs
        return others;
    };
    EXPECT_EQ(changed("urock"), (Names{"ID_BUILD", "ROOF_HEIGHT"}));
    EXPECT_EQ(buildings().records[0].number("ROOF_HEIGHT"), height);
    EXPECT_EQ(changed("city4cfd"), (Names{"unique_id", "base_height", "floors"}));
    EXPECT_EQ(changed("osm"), (Names{"ele", "building:levels"}));
}

}  // namespace d2b::test
