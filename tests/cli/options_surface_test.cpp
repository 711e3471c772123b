#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/option_effect.hpp"
#include "cli/read_cityjson.hpp"
#include "cli/read_obj.hpp"
#include "cli/town_errors.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

using Names = std::vector<std::string>;

void expect_closed(const ReadObj& obj) {
    EXPECT_EQ(obj.open_edges(), 0);
    EXPECT_EQ(obj.flat_triangles(), 0);
}

/// Content of a surface without its name: an OBJ names its materials after itself.
std::string nameless(const std::string& file) {
    std::string bytes = read_bytes(file);
    if (const std::size_t line = bytes.find("\nmtllib "); line != std::string::npos)
        bytes.erase(line, bytes.find('\n', line + 1) - line);
    return bytes;
}

/// Sum of the layer's areas, in the plane of the CRS.
double areas(const Layer& buildings) {
    double sum = 0;
    for (const Record& record : buildings.records)
        sum += record.area();
    return sum;
}

double volumes(const Layer& buildings, const std::string& height) {
    double sum = 0;
    for (const Record& record : buildings.records)
        sum += record.area() * record.number(height);
    return sum;
}

}  // namespace

TEST_F(OptionEffect, surface) {
    find({"-surface", "town.obj", "-surface", "again.obj"});
    const ReadObj obj = read_obj(path("town.obj"));
    expect_closed(obj);
    EXPECT_EQ(obj.objects(), (Names{"building_1", "building_2", "building_3"}));
    const Layer layer = buildings();
    EXPECT_NEAR(obj.plan_area("/roof"), areas(layer), 0.001 * areas(layer));
    EXPECT_NEAR(obj.plan_area("/ground"), -areas(layer), 0.001 * areas(layer));
    EXPECT_EQ(obj.plan_area("/wall"), 0);
    EXPECT_NEAR(obj.volume(), layer.sum("volume_m3"), 0.001 * obj.volume());
    // Coordinates begin in the middle of the window, below the lowest point.
    ASSERT_GE(obj.comments.size(), 3U);
    EXPECT_EQ(obj.comments[1], "# origin: 391085 5819930 99");
    EXPECT_EQ(obj.comments[2], "# crs: ETRS89 / UTM zone 33N");
    for (const Record& record : layer.records) {
        const std::string object = "building_" + std::to_string(static_cast<int>(record.number("id")));
        const auto [low, high] = obj.heights(object);
        EXPECT_NEAR(low, record.number("ground") - 99, 0.001);
        const double mean = record.number("volume_m3") / record.number("area_m2");
        EXPECT_NEAR(high - low, mean, 0.001 * mean + 0.001);
    }
    EXPECT_EQ(nameless(path("town.obj")), nameless(path("again.obj")));
}

/// A tower on its podium, divided: two buildings in one block.
TEST_F(OptionEffect, surface__ofTouchingBuildings) {
    find({"-split_height", "3", "-surface", "town.obj"});
    const ReadObj obj = read_obj(path("town.obj"));
    expect_closed(obj);
    const Layer layer = buildings();
    EXPECT_EQ(obj.objects().size(), layer.records.size());
    EXPECT_GE(layer.records.size(), 4U);
    EXPECT_NEAR(obj.plan_area("/roof"), areas(layer), 0.001 * areas(layer));
}

/// The same triangles in the same coordinates, a solid a building.
TEST_F(OptionEffect, surface__asStl) {
    find({"-split_height", "3", "-surface", "town.stl", "-surface", "town.obj"});
    const ReadObj stl = read_stl(path("town.stl"));
    const ReadObj obj = read_obj(path("town.obj"));
    expect_closed(stl);
    EXPECT_EQ(stl.objects(), obj.objects());
    for (const std::string& name : stl.objects()) {
        std::vector<ReadObj::Triangle> triangles;
        for (const std::string group : {"/roof", "/wall", "/ground"})
            if (const auto found = obj.groups.find(name + group); found != obj.groups.end())
                triangles.insert(triangles.end(), found->second.begin(), found->second.end());
        std::vector<ReadObj::Triangle> others = stl.groups.at(name);
        std::ranges::sort(triangles);
        std::ranges::sort(others);
        EXPECT_EQ(others, triangles) << name;
    }
    ASSERT_FALSE(stl.comments.empty());
    for (const std::string& line : stl.comments)
        EXPECT_TRUE(line.ends_with(" origin 391085 5819930 99")) << line;
}

/// The same surface with numbers of single precision, and attributes.
TEST_F(OptionEffect, surface__asGltf) {
    find({"-split_height", "3", "-surface", "town.glb", "-surface", "town.obj"});
    const ReadObj glb = read_glb(path("town.glb"));
    const ReadObj obj = read_obj(path("town.obj"));
    expect_closed(glb);
    EXPECT_EQ(glb.objects(), obj.objects());
    EXPECT_NEAR(glb.volume(), obj.volume(), 1e-5 * obj.volume());
    for (const auto& [name, triangles] : obj.groups)
        EXPECT_EQ(glb.groups.at(name).size(), triangles.size()) << name;
    for (const std::string ending : {"/roof", "/ground"})
        EXPECT_NEAR(glb.plan_area(ending), obj.plan_area(ending), 1e-3);
    for (const std::string& object : obj.objects())
        EXPECT_EQ(glb.heights(object), obj.heights(object));
    const auto asset = nlohmann::json::parse(glb.comments.at(0));
    EXPECT_EQ(asset.at("origin"), (nlohmann::json{391085.0, 5819930.0, 99.0}));
    const Layer layer = buildings();
    ASSERT_EQ(glb.comments.size(), layer.records.size() + 1);
    for (std::size_t i = 1; i < glb.comments.size(); ++i) {
        const auto extras = nlohmann::json::parse(glb.comments[i]);
        const Record& record = layer.where("id", extras.at("id").get<double>());
        EXPECT_EQ(extras.at("p90").get<double>(), record.number("p90"));
        EXPECT_EQ(extras.size(), layer.fields.size());
    }
}

/// All formats in one run, byte for byte.
TEST_F(OptionEffect, surface__isTheSameWhateverTheThreads) {
    const std::vector<std::string> endings{".city.json", ".obj", ".stl", ".glb"};
    for (const std::string threads : {"1", "4"}) {
        Arguments arguments{"-split_height", "3", "-threads", threads};
        for (const std::string& ending : endings)
            arguments.insert(arguments.end(), {"-surface", threads + ending});
        find(arguments);
    }
    for (const std::string& ending : endings) {
        const std::string one = nameless(path("1" + ending));
        EXPECT_GT(one.size(), 1000U);
        EXPECT_TRUE(one == nameless(path("4" + ending))) << ending;
    }
}

/// Metadata of a surface name the files of its source and options without their folders.
TEST_F(OptionEffect, surface__holdsNoPathOfTheUsers) {
    write(path("secret_mask.tif"), town_raster(std::vector<double>(MadeTown::surface().size(), 1)));
    find({"-mask", path("secret_mask.tif"), "-surface", path("town.obj"), "-surface", path("town.stl"),
          "-surface", path("town.glb"), "-surface", path("town.city.json")});
    for (const std::string name : {"town.obj", "town.mtl", "town.stl", "town.glb", "town.city.json"}) {
        const std::string bytes = read_bytes(path(name));
        EXPECT_GT(bytes.size(), 50U);
        EXPECT_EQ(bytes.find(path("").substr(0, path("").size() - 1)), std::string::npos) << name;
    }
    EXPECT_NE(read_bytes(path("town.obj")).find("\nmtllib town.mtl\n"), std::string::npos);
    EXPECT_NE(read_bytes(path("town.obj")).find("# D2B_MASK: secret_mask.tif\n"), std::string::npos);
}

/// Solids as they stand in the layer, in its coordinates, with its attributes.
TEST_F(OptionEffect, surface__asCityJson) {
    find({"-split_height", "3", "-surface", "town.city.json"});
    const ReadCityJson city = read_cityjson(path("town.city.json"));
    const Layer layer = buildings();
    EXPECT_EQ(city.solids.size(), layer.records.size());
    EXPECT_NEAR(city.plan_area(FaceKind::roof), areas(layer), 0.001 * areas(layer));
    EXPECT_NEAR(city.plan_area(FaceKind::ground), areas(layer), 0.001 * areas(layer));
    EXPECT_NEAR(city.volume(), layer.sum("volume_m3"), 0.001 * city.volume());
    EXPECT_EQ(city.root["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/25833");
    for (const SurfacePart& solid : city.solids)
        for (const SurfacePoint& point : solid.points) {
            const auto at = city.frame().coordinates(point);
            EXPECT_GT(at[0], 391000);
            EXPECT_LT(at[0], 391000 + MadeTown::cols);
            EXPECT_LT(at[1], 5820000);
            EXPECT_GT(at[1], 5820000 - MadeTown::rows);
        }
    for (const Record& record : layer.records) {
        const auto id = static_cast<std::int64_t>(record.number("id"));
        const nlohmann::json& attributes = city.attributes(id);
        for (const std::string field : {"id", "ground", "p70", "p90", "n_points", "area_m2", "confidence"})
            EXPECT_EQ(attributes.at(field).get<double>(), record.number(field)) << field;
        EXPECT_TRUE(attributes.at("doubt").is_null());
        EXPECT_EQ(attributes.size(), layer.fields.size());
        for (const std::string& field : layer.fields)
            EXPECT_TRUE(attributes.contains(field)) << field;
    }
    EXPECT_EQ(city.root["CityObjects"]["building_1"]["geometry"][0]["lod"], "1.3");
    // The tower and its podium are one building, the others are not divided.
    ASSERT_EQ(city.parts.size(), 1U);
    const auto& [whole, parts] = *city.parts.begin();
    EXPECT_EQ(parts.size(), layer.records.size() - 2);
    EXPECT_EQ("building_" + whole.substr(std::string("whole_").size()), *std::ranges::min_element(parts));
    find({"-surface", "town.city.json", "-fields", "osm"});
    const ReadCityJson undivided = read_cityjson(path("town.city.json"));
    EXPECT_EQ(undivided.root["CityObjects"]["building_1"]["geometry"][0]["lod"], "1.2");
    EXPECT_TRUE(undivided.attributes(1).contains("building:levels"));
    EXPECT_TRUE(undivided.parts.empty());
}

/// A solid of tiers is their union.
TEST_F(OptionEffect, surface_of__asCityJson) {
    find({"-surface", "tiers.city.json", "-surface_of", "contours"});
    const ReadCityJson city = read_cityjson(path("tiers.city.json"));
    double volume = 0;
    for (const Record& record : contours().records)
        volume += record.area() * (record.number("top") - record.number("base"));
    EXPECT_NEAR(city.volume(), volume, 0.001 * volume);
    EXPECT_EQ(city.solids.size(), buildings().records.size());
    EXPECT_EQ(city.root["CityObjects"]["building_1"]["geometry"][0]["lod"], "1.3");
    trace({"-overwrite", "-surface", "thesis.city.json"});
    EXPECT_NEAR(read_cityjson(path("thesis.city.json")).plan_area(FaceKind::roof), 63 + 6, 1e-3);
}

/// Layers limit only the written features.
TEST_F(OptionEffect, surface__doesNotDependOnLayers) {
    find({"-surface", "both.obj"});
    find({"-surface", "contours.obj", "-layers", "contours"});
    std::ifstream both(path("both.obj"));
    std::ifstream one_layer(path("contours.obj"));
    const auto without_comments = [](std::istream& in) {
        std::vector<std::string> lines;
        for (std::string line; std::getline(in, line);)
            if (!line.starts_with("#") && !line.starts_with("mtllib "))
                lines.push_back(line);
        return lines;
    };
    EXPECT_EQ(without_comments(both), without_comments(one_layer));
}

TEST_F(OptionEffect, surface_of) {
    find({"-surface", "tiers.obj", "-surface_of", "contours"});
    const ReadObj obj = read_obj(path("tiers.obj"));
    expect_closed(obj);
    const Layer tiers = contours();
    double volume = 0;
    double footprints = 0;
    for (const Record& record : tiers.records) {
        volume += record.area() * (record.number("top") - record.number("base"));
        footprints += record.number("level") == 1 ? record.area() : 0;
    }
    // The prisms of a stack stand on each other.
    EXPECT_NEAR(obj.volume(), volume, 0.001 * volume);
    EXPECT_NEAR(obj.plan_area("/roof"), footprints, 0.001 * footprints);
    find({"-surface", "blocks.obj", "-surface_of", "buildings"});
    EXPECT_LT(read_obj(path("blocks.obj")).groups.at("building_2/roof").size(),
              obj.groups.at("building_2/roof").size());
}

/// The thesis's preset makes its stack a surface.
TEST_F(OptionEffect, surface_of__inTheThesis) {
    trace({"-surface", "thesis.obj"});
    const ReadObj obj = read_obj(path("thesis.obj"));
    expect_closed(obj);
    EXPECT_NEAR(obj.plan_area("/roof"), areas(buildings()), 1e-3);
    EXPECT_NEAR(obj.plan_area("/roof"), 63 + 6, 1e-3);
    trace({"-overwrite", "-surface", "thesis.obj", "-surface_of", "buildings"});
    expect_closed(read_obj(path("thesis.obj")));
}

TEST_F(OptionEffect, surface_roof) {
    // The mean is the default, and encloses the layer's volumes, block by block.
    find({"-surface", "mean.city.json", "-surface", "mean.obj", "-surface_roof", "mean"});
    const ReadCityJson blocks = read_cityjson(path("mean.city.json"));
    const Layer layer = buildings();
    EXPECT_EQ(blocks.solids.size(), layer.records.size());
    for (const SurfacePart& solid : blocks.solids) {
        const Record& record = layer.where("id", static_cast<double>(solid.buildings[0].id));
        const double volume = record.number("volume_m3");
        EXPECT_NEAR(blocks.volume_of(solid), volume, 0.001 * volume) << solid.buildings[0].id;
    }
    find({"-surface", "town.obj"});
    EXPECT_EQ(nameless(path("town.obj")), nameless(path("mean.obj")));
    for (const std::string roof : {"p50", "p70", "p90", "p95"}) {
        find({"-surface", "town.obj", "-surface_roof", roof});
        const ReadObj obj = read_obj(path("town.obj"));
        EXPECT_NEAR(obj.volume(), volumes(buildings(), roof), 0.002 * volumes(buildings(), roof)) << roof;
    }
    find({"-surface", "town.obj", "-surface_roof", "max"});
    const ReadObj highest = read_obj(path("town.obj"));
    EXPECT_NEAR(highest.volume(), volumes(buildings(), "height"), 0.002 * highest.volume());
}

/// Blocks hold the layer's volumes in a CRS with a plane 0.14 % larger than the ground; where lengths are
/// half as long again, heights stay as they are.
TEST_F(OptionEffect, surface_roof__inOtherPlanes) {
    const auto volumes_differ = [&](const std::string& file) {
        const ReadCityJson city = read_cityjson(path(file));
        const Layer layer = buildings();
        double most = 0;
        for (const SurfacePart& solid : city.solids) {
            const Record& record = layer.where("id", static_cast<double>(solid.buildings[0].id));
            most = std::max(most, std::abs(city.volume_of(solid) / record.number("volume_m3") - 1));
        }
        return most;
    };
    find({"-surface", "utm.city.json", "-t_srs", "EPSG:25832"});
    EXPECT_LT(volumes_differ("utm.city.json"), 0.0005);
    std::filesystem::remove(path("out.gpkg"));
    run_warned({"-preset", "buildings", "-q", "-surface", "web.city.json", "-t_srs", "EPSG:3857", "--",
                "town.tif", "out.gpkg"},
               {"-surface: 'WGS 84 / Pseudo-Mercator' shows areas here "});
    const ReadCityJson web = read_cityjson(path("web.city.json"));
    const Layer layer = buildings();
    EXPECT_GT(volumes_differ("web.city.json"), 1);
    for (const SurfacePart& solid : web.solids) {
        const Record& record = layer.where("id", static_cast<double>(solid.buildings[0].id));
        const auto [low, high] = std::ranges::minmax(solid.points, {}, &SurfacePoint::z);
        const double mean = record.number("volume_m3") / record.number("area_m2");
        EXPECT_NEAR(static_cast<double>(high.z - low.z) / 1000, mean, 0.001 * mean + 0.001);
    }
}

/// One object, or solid, has the same triangles as one for each building.
TEST_F(OptionEffect, surface_solids) {
    find({"-split_height", "3", "-surface", "each.obj", "-surface", "each.stl"});
    find({"-split_height", "3", "-surface", "one.obj", "-surface", "one.stl", "-surface_solids", "one"});
    const auto sorted = [](const ReadObj& obj, const std::string& ending) {
        std::vector<ReadObj::Triangle> all;
        for (const auto& [name, triangles] : obj.groups)
            if (name.ends_with(ending))
                all.insert(all.end(), triangles.begin(), triangles.end());
        std::ranges::sort(all);
        return all;
    };
    const ReadObj one = read_obj(path("one.obj"));
    EXPECT_EQ(one.objects(), Names{"buildings"});
    expect_closed(one);
    for (const std::string group : {"/roof", "/wall", "/ground"})
        EXPECT_EQ(sorted(one, group), sorted(read_obj(path("each.obj")), group)) << group;
    const ReadObj solid = read_stl(path("one.stl"));
    EXPECT_EQ(solid.objects(), Names{"buildings"});
    EXPECT_EQ(solid.comments.size(), 1U);
    expect_closed(solid);
    EXPECT_EQ(sorted(solid, ""), sorted(read_stl(path("each.stl")), ""));
}

TEST_F(OptionEffect, surface_origin) {
    find({"-surface", "town.obj", "-surface_origin", "391000", "5820000", "-50"});
    const ReadObj obj = read_obj(path("town.obj"));
    expect_closed(obj);
    EXPECT_EQ(obj.comments[1], "# origin: 391000 5820000 -50");
    for (const auto& [name, triangles] : obj.groups)
        for (const ReadObj::Triangle& triangle : triangles)
            for (const ReadObj::Corner& corner : triangle) {
                EXPECT_GT(corner[0], 0);
                EXPECT_LT(corner[0], MadeTown::cols);
                EXPECT_LT(corner[1], 0);
                EXPECT_GT(corner[1], -MadeTown::rows);
                EXPECT_GT(corner[2], 149);
            }
}

/// Rows to the north, another CRS: rounded to a grid, and as closed.
TEST_F(OptionEffect, surface__ofOtherGrids) {
    const auto looked_for = [&](const Arguments& more) {
        std::filesystem::remove(path("out.gpkg"));
        Arguments arguments{"-preset",  "buildings",   "-q",       "-overwrite",
                            "-surface", "o.city.json", "-surface", "o.obj"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run_well(arguments);
        return read_obj(path("o.obj"));
    };
    RasterSpec turned = town_raster(MadeTown::surface());
    turned.transform = std::array<double, 6>{391000, 0.8, 0.6, 5820000, 0.6, -0.8};
    write(path("turned.tif"), turned);
    ReadObj obj = looked_for({"-split_height", "3", "--", "turned.tif", "out.gpkg"});
    expect_closed(obj);
    EXPECT_NEAR(obj.plan_area("/roof"), areas(buildings()), 0.001 * areas(buildings()));
    RasterSpec south_up = town_raster(MadeTown::surface());
    south_up.transform = std::array<double, 6>{391000, 1, 0, 5820000, 0, 1};
    write(path("south_up.tif"), south_up);
    obj = looked_for({"-split_height", "3", "--", "south_up.tif", "out.gpkg"});
    expect_closed(obj);
    EXPECT_NEAR(obj.plan_area("/roof"), areas(buildings()), 0.001 * areas(buildings()));
    write(path("town.tif"), town_raster(MadeTown::surface()));
    obj = looked_for({"-split_height", "3", "-t_srs", "EPSG:25832", "--", "town.tif", "out.gpkg"});
    expect_closed(obj);
    EXPECT_NEAR(obj.plan_area("/roof"), areas(buildings()), 0.001 * areas(buildings()));
    EXPECT_EQ(obj.comments[2], "# crs: ETRS89 / UTM zone 32N");
    EXPECT_NEAR(read_cityjson(path("o.city.json")).plan_area(FaceKind::roof), areas(buildings()),
                0.001 * areas(buildings()));
    // Feet are metres in the file.
    RasterSpec feet = town_raster(MadeTown::surface());
    for (double& z : feet.values)
        z /= 0.3048;
    write(path("feet.tif"), feet);
    run_well({"-preset", "buildings", "-q", "-overwrite", "-surface", "o.obj", "-zunit", "ft", "--",
              "feet.tif", "out.gpkg"});
    obj = read_obj(path("o.obj"));
    EXPECT_NEAR(obj.volume(), buildings().sum("volume_m3"), 0.001 * obj.volume());
}

class SurfaceErrors : public TownErrors {};

TEST_F(SurfaceErrors, names) {
    refused(
        2,
        "Surfaces are written as CityJSON, OBJ, STL or glTF; give \"a.ply\" a name that ends in .city.json, "
        ".obj, .stl or .glb.",
        {"-surface", "a.ply"});
    refused(2, "\"a.obj\" is already read or written by this run; choose another name.",
            {"-surface", "a.obj", "-surface", "a.obj"});
    refused(1, "no file can be created in \"no/such\" (", {"-surface", "no/such/a.obj"});
    std::ofstream(path("there.obj")) << "# made by hand\nv 1 2 3\n";
    refused(2, "\"there.obj\" exists; give another name, or -overwrite to replace it.",
            {"-surface", "there.obj"});
    std::ofstream(path("other.obj")) << "Dear diary\n";
    refused(2, "\"other.obj\" exists and is not a surface of this format; remove it first.",
            {"-overwrite", "-surface", "other.obj"});
    for (const std::string name : {"other.stl", "other.glb", "other.city.json"}) {
        std::ofstream(path(name)) << "Dear diary\n";
        refused(2, "\"" + name + "\" exists; give another name, or -overwrite to replace it.",
                {"-append", "-surface", name});
        refused(2, "\"" + name + "\" exists and is not a surface of this format; remove it first.",
                {"-overwrite", "-surface", name});
    }
    std::filesystem::create_directory(path("folder.obj"));
    refused(2, "is a folder, and a surface is written as a file", {"-surface", "folder.obj"});
    run_well(
        {"-preset", "buildings", "-q", "-overwrite", "-surface", "there.obj", "--", "town.tif", "o.gpkg"});
    EXPECT_EQ(read_obj(path("there.obj")).objects().size(), 3U);
}

/// A run that adds to the layers writes its own buildings alone.
TEST_F(SurfaceErrors, append) {
    const Arguments west{"-preset", "buildings", "-q", "-srcwin", "0", "0", "85", "140"};
    const auto with = [](Arguments arguments, const Arguments& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    run_well(with(west, {"-surface", "west.city.json", "--", "town.tif", "o.gpkg"}));
    const std::size_t first = layer("o.gpkg", "buildings").records.size();
    run_well({"-preset", "buildings", "-q", "-srcwin", "85", "0", "85", "140", "-append", "-surface",
              "east.city.json", "-surface", "east.glb", "--", "town.tif", "o.gpkg"});
    const std::size_t all = layer("o.gpkg", "buildings").records.size();
    EXPECT_GT(first, 0U);
    EXPECT_GT(all, first);
    EXPECT_EQ(read_cityjson(path("west.city.json")).solids.size(), first);
    const ReadCityJson east = read_cityjson(path("east.city.json"));
    EXPECT_EQ(east.solids.size(), all - first);
    EXPECT_EQ(read_glb(path("east.glb")).objects().size(), all - first);
}

/// CityJSON has one unit for all three coordinates.
TEST_F(SurfaceErrors, units) {
    refused(2,
            "CityJSON has heights in the unit of x and y, which is the metre in 'ETRS89 / UTM zone 33N', and "
            "the elevations are in the unit 'foot'; give a CRS in that unit with -t_srs, or their true unit "
            "with -zunit.",
            {"-surface", "a.city.json", "-zunit", "ft"});
    RasterSpec nowhere = town_raster(MadeTown::surface());
    nowhere.crs = "";
    write(path("nowhere.tif"), nowhere);
    expect_error(2, "the unit of the elevations is unknown; give it with -zunit",
                 {"-preset", "buildings", "-q", "-surface", "a.city.json", "--", "nowhere.tif", "o.gpkg"}, {},
                 1);
    run_warned({"-preset", "buildings", "-q", "-surface", "a.city.json", "-zunit", "m", "--", "nowhere.tif",
                "o.gpkg"},
               {"has no coordinate reference system"});
    EXPECT_EQ(read_cityjson(path("a.city.json")).solids.size(), 3U);
    run_warned({"-preset", "buildings", "-q", "-overwrite", "-surface", "a.city.json", "-zunit", "us-ft",
                "-t_srs", "EPSG:2225", "--", "town.tif", "o.gpkg"},
               {"times as large as on the ground"});  // it is a CRS of another continent
}

TEST_F(SurfaceErrors, coordinates) {
    refused(2,
            "-surface needs coordinates in a unit of length, and those of 'WGS 84' are angles; convert them "
            "to a projected CRS with -t_srs, such as the UTM zone of the area.",
            {"-surface", "a.obj", "-t_srs", "EPSG:4326"});
    refused(
        2,
        "-surface has coordinates up to 391170 m from their origin, where single precision, in which OBJ, "
        "STL and glTF are read, cannot resolve steps of 0.0009765625 m apart; use a window of at most 16382 "
        "x 16382 cells (-srcwin, -projwin or -te) with an origin in its middle (-surface_origin).",
        {"-surface", "a.obj", "-surface_origin", "0", "5820000", "0"});
    for (const std::string name : {"a.stl", "a.glb"}) {
        refused(2, "-surface has coordinates up to 391170 m from their origin",
                {"-surface", "a.city.json", "-surface", name, "-surface_origin", "0", "5820000", "0"});
        refused(2, "-surface has heights 10000 m from their origin",
                {"-surface", name, "-surface_origin", "391000", "5820000", "-9900"});
        refused(2, "-surface needs coordinates in a unit of length",
                {"-surface", name, "-t_srs", "EPSG:4326"});
    }
    refused(2, "-surface needs coordinates in a unit of length",
            {"-surface", "a.city.json", "-t_srs", "EPSG:4326"});
    // Whole numbers have no such limit.
    run_well({"-preset", "buildings", "-q", "-surface", "far.city.json", "-surface_origin", "0", "5820000",
              "0", "--", "town.tif", "far.gpkg"});
    EXPECT_EQ(read_cityjson(path("far.city.json")).solids.size(), 3U);
    refused(2, "-surface has heights 10000 m from their origin",
            {"-surface", "a.obj", "-surface_origin", "391000", "5820000", "-9900"});
    refused(2, "-surface_origin must be three whole numbers, not '1 2 3.5'.",
            {"-surface", "a.obj", "-surface_origin", "1", "2", "3.5"});
    refused(2, "-surface_roof needs -surface <file>; it is the height of its flat roofs.",
            {"-surface_roof", "p90"});
    refused(2,
            "-write_problems needs -surface <file>, -flow_ready <m>, -min_gap <m> or -min_wall <m>; it "
            "writes the problems of a surface or a flow solver.",
            {"-write_problems"});
    refused(2,
            "-surface_solids needs -surface <file>; it says how many objects an OBJ has, or solids an STL.",
            {"-surface_solids", "one"});
    refused(2,
            "-surface_solids has no effect without an OBJ or STL; give a -surface whose name ends in .obj or "
            ".stl.",
            {"-surface", "a.city.json", "-surface", "a.glb", "-surface_solids", "one"});
    refused(2, "-surface_roof has no effect with -surface_of contours; tiers have heights of their own.",
            {"-surface", "a.obj", "-surface_of", "contours", "-surface_roof", "p90"});
}

/// A file without objects, and the warning that there is nothing.
TEST_F(SurfaceErrors, nothingFound) {
    run_warned({"-preset", "buildings", "-q", "-min_building_height", "80", "-surface", "none.obj", "--",
                "town.tif", "o.gpkg"},
               {"No building was found"});
    run_warned({"-preset", "buildings", "-q", "-overwrite", "-min_building_height", "80", "-surface",
                "none.stl", "-surface", "none.glb", "-surface", "none.city.json", "--", "town.tif", "o.gpkg"},
               {"No building was found",
                "There is no building for \"none.stl\", and an STL needs a solid; no file is written.",
                "There is no building for \"none.glb\", and a glTF without a mesh shows nothing; no file is "
                "written."});
    EXPECT_FALSE(std::filesystem::exists(path("none.stl")));
    EXPECT_FALSE(std::filesystem::exists(path("none.glb")));
    EXPECT_TRUE(read_cityjson(path("none.city.json")).solids.empty());
    const ReadObj obj = read_obj(path("none.obj"));
    EXPECT_TRUE(obj.groups.empty());
    EXPECT_GE(obj.comments.size(), 3U);
}

}  // namespace d2b::test
