#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <locale.h>
#include <map>

#include <gdal.h>
#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// The same input and options give the same result, to the bit.
class Determinism : public CliTest {
  protected:
    struct Result {
        std::string bytes;
        json report;  ///< without values that differ from run to run: seconds and memory
    };
    Result result_of(const std::string& file, Arguments arguments, std::vector<std::string> environment = {},
                     const std::string& dem = sample("town.tif")) const {
        environment.emplace_back("OGR_CURRENT_DATE=2001-02-03T04:05:06.000Z");
        arguments.insert(arguments.end(), {"-json", "--", dem, file});
        Result result;
        result.report = json::parse(run_well(arguments, {.environment = environment}));
        EXPECT_TRUE(result.report.contains("stages"));
        result.report.erase("stages");
        result.bytes = read_bytes(path(file));
        std::filesystem::remove(path(file));
        EXPECT_GT(result.bytes.size(), 100'000U);
        return result;
    }
    void expect_same(const std::string& file, const Arguments& arguments, const Arguments& other,
                     const std::vector<std::string>& environment = {}) const {
        const Result one = result_of(file, arguments);
        const Result two = result_of(file, other, environment);
        EXPECT_TRUE(one.bytes == two.bytes) << file;
        EXPECT_EQ(one.report, two.report);
    }
};

TEST_F(Determinism, twoRunsGiveTheSameBytes) {
    const Arguments plain{"-lod", "4"};
    const Arguments all{"-trace", "cells", "-simplify", "0.8", "-disjoint", "-t_srs", "EPSG:4326", "-3d"};
    expect_same("out.gpkg", plain, plain);
    expect_same("out.gpkg", all, all);
    expect_same("out.geojson", {"-layers", "contours"}, {"-layers", "contours"});
}

TEST_F(Determinism, theCacheDoesNotMatter) {
    for (const Arguments& options : {Arguments{}, Arguments{"-preset", "buildings", "-split_height", "3",
                                                            "-write_doubtful", "-roofs"}}) {
        Arguments other = options;
        other.insert(other.end(), {"--config", "GDAL_CACHEMAX=1", "--config", "GDAL_NUM_THREADS=4"});
        expect_same("out.gpkg", options, other);
    }
}

/// Writes the town with other blocks.
void write_town(const std::string& copy, const std::vector<std::string>& creation) {
    GDALAllRegister();
    std::vector<const char*> options;
    for (const std::string& option : creation)
        options.push_back(option.c_str());
    options.push_back(nullptr);
    const GDALDatasetH town = GDALOpen(sample("town.tif").c_str(), GA_ReadOnly);
    EXPECT_NE(town, nullptr);
    const GDALDatasetH written = GDALCreateCopy(GDALGetDriverByName("GTiff"), copy.c_str(), town, FALSE,
                                                const_cast<char**>(options.data()), nullptr, nullptr);
    EXPECT_NE(written, nullptr);
    GDALClose(written);
    GDALClose(town);
}

TEST_F(Determinism, theBlocksOfTheFileDoNotMatter) {
    const std::vector<std::vector<std::string>> kinds{
        {"BLOCKYSIZE=1"},
        {"BLOCKYSIZE=7", "COMPRESS=DEFLATE"},
        {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=48", "COMPRESS=LZW", "PREDICTOR=3"},
        {"TILED=YES", "BLOCKXSIZE=512", "BLOCKYSIZE=512", "COMPRESS=DEFLATE", "SPARSE_OK=TRUE"},
        {"BLOCKYSIZE=100000"}};
    const std::string copy = path("town.tif");  // always the same, since its name is in the metadata
    for (const char* preset : {"thesis", "buildings"}) {
        const Arguments arguments{"-preset", preset, "-threads", "2"};
        write_town(copy, {});
        const Result one = result_of("out.gpkg", arguments, {}, copy);
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            write_town(copy, kinds[i]);
            const Result two = result_of("out.gpkg", arguments, {}, copy);
            EXPECT_TRUE(one.bytes == two.bytes) << preset << ' ' << i;
        }
    }
    std::filesystem::remove(copy);
}

TEST_F(Determinism, theLocaleDoesNotMatter) {
    const char* name = "de_DE.UTF-8";
    const locale_t german = ::newlocale(LC_ALL_MASK, name, nullptr);
    if (german == nullptr)
        GTEST_SKIP() << "the locale " << name << " is not installed; locale-gen or localedef makes it";
    ::freelocale(german);
    const Arguments options{"-simplify", "0.5", "-fl", "220.25", "231.5"};
    Arguments set_by_gdal{"--locale", name};
    set_by_gdal.insert(set_by_gdal.end(), options.begin(), options.end());
    for (const char* file : {"out.gpkg", "out.geojson"}) {
        Arguments one_layer = options;
        Arguments other = set_by_gdal;
        for (Arguments* arguments : {&one_layer, &other})
            arguments->insert(arguments->begin(), {"-layers", "contours"});
        expect_same(file, one_layer, one_layer, {std::string("LC_ALL=") + name});
        expect_same(file, one_layer, other);
    }
}

using Metadata = std::map<std::string, std::string>;

/// Repeats a run from the metadata of its result.
class Repeat : public CliTest {
  protected:
    /// @param layer of it; nullptr for the file as a whole
    [[nodiscard]] Metadata metadata_of(const std::string& file, const char* layer = nullptr) const {
        const GDALDatasetH dataset = GDALOpenEx(path(file).c_str(), 0, nullptr, nullptr, nullptr);
        Metadata metadata;
        const GDALMajorObjectH object =
            layer == nullptr ? dataset : GDALDatasetGetLayerByName(dataset, layer);
        for (CSLConstList item = GDALGetMetadata(object, nullptr); item != nullptr && *item != nullptr;
             ++item) {
            const std::string text = *item;
            metadata[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
        }
        GDALClose(dataset);
        return metadata;
    }
    /// Has a shell run the command in a result's metadata.
    void repeat(const std::string& file, const char* layer, const std::string& again) const {
        const Metadata said = metadata_of(file, layer);
        const std::string command = D2B_TOOL " -q " + said.at("D2B_OPTIONS") + " -- \"$0\" \"$1\"";
        const ToolResult result = run_tool({"/bin/sh", "-c", command, said.at("D2B_SOURCE"), again},
                                           {.environment = {dated}, .working_directory = folder_.string()});
        EXPECT_EQ(result.status, 0) << result.err;
    }
    static constexpr const char* dated = "OGR_CURRENT_DATE=2001-02-03T04:05:06Z";
};

TEST_F(Repeat, whatAResultSaysMakesItAgainByteForByte) {
    write(path("bob's blocks.tif"), blocks());
    Arguments arguments{"-q",  "-srcwin", "0",  "0",   "24", "20",  "-snodata",       "6",
                        "-fl", "5",       "15", "-nf", "0",  "-3d", "-write_rejected"};
    arguments.insert(arguments.end(), {"-nln", "bob's roofs", "-lco", "DESCRIPTION=a $HOME; `b` \"c\" \\d",
                                       "bob's blocks.tif", "out.gpkg"});
    run_well(arguments, {.environment = {dated}});
    EXPECT_EQ(metadata_of("out.gpkg", "bob's roofs").at("D2B_OPTIONS"),
              "-snodata 6 -srcwin 0 0 24 20 -preset thesis -fl 5 15 -nf 0 -3d -lco 'DESCRIPTION=a $HOME; `b` "
              "\"c\" \\d' -nln 'bob'\\''s roofs' -write_rejected");
    repeat("out.gpkg", "bob's roofs", "again.gpkg");
    EXPECT_EQ(read_bytes(path("again.gpkg")), read_bytes(path("out.gpkg")));
}

TEST_F(Repeat, rastersBesideTheLayersSayItToo) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    run_well(
        {"-q", "-preset", "buildings", "-min_height", "2", "-write_height", "h.tif", "town.tif", "out.gpkg"});
    EXPECT_EQ(metadata_of("h.tif").at("D2B_OPTIONS"), "-preset buildings -min_height 2");
}

TEST_F(Repeat, nothingIsLeftOfWhatIsReplaced) {
    write(path("blocks.tif"), blocks());
    run_well({"-q", "-lod", "3", "-min_area", "2", "blocks.tif", "out.gpkg"});
    EXPECT_EQ(metadata_of("out.gpkg", "buildings").at("D2B_LOD"), "3");
    const GDALDatasetH own =
        GDALOpenEx(path("out.gpkg").c_str(), GDAL_OF_UPDATE | GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    GDALSetMetadataItem(own, "TITLE", "the user's own", nullptr);
    GDALClose(own);
    // Newer versions of GDAL may copy all items of the file to another one, which they read, too.
    std::filesystem::remove(path("out.gpkg.aux.xml"));
    run_well({"-q", "-overwrite", "-fl", "5", "blocks.tif", "out.gpkg"});
    const Metadata said = metadata_of("out.gpkg", "buildings");
    EXPECT_FALSE(said.contains("D2B_LOD"));
    EXPECT_EQ(said.at("D2B_OPTIONS"), "-preset thesis -fl 5");
    EXPECT_EQ(said.at("D2B_MIN_AREA_M2"), "0");
    Metadata of_file = metadata_of("out.gpkg");
    EXPECT_EQ(of_file["TITLE"], "the user's own");
    of_file.erase("TITLE");
    EXPECT_GT(of_file.size(), 10U);
    for (const auto& [name, value] : of_file)
        EXPECT_EQ(said.at(name), value) << name;
}

using Transform = std::array<double, 6>;

/// The same grid in another place must give the same contours.
class Variants : public CliTest {
  protected:
    static RasterSpec sample_grid(const std::string& name) {
        const OpenDataset dem(GDALOpen(sample(name).c_str(), GA_ReadOnly));
        RasterSpec spec = blocks();
        spec.cols = GDALGetRasterXSize(dem.get());
        spec.rows = GDALGetRasterYSize(dem.get());
        spec.values.resize(static_cast<std::size_t>(spec.cols * spec.rows));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dem.get(), 1), GF_Read, 0, 0, spec.cols, spec.rows,
                               spec.values.data(), spec.cols, spec.rows, GDT_Float64, 0, 0),
                  CE_None);
        return spec;
    }
    static RasterSpec upside_down(RasterSpec spec) {
        for (int row = 0; row < spec.rows / 2; ++row)
            std::swap_ranges(spec.values.begin() + row * spec.cols,
                             spec.values.begin() + (row + 1) * spec.cols,
                             spec.values.begin() + (spec.rows - 1 - row) * spec.cols);
        return spec;
    }
    /// (level, area in the plane) of every contour, sorted.
    std::vector<std::pair<double, double>> areas(RasterSpec spec, const Transform& transform,
                                                 const char* mode) const {
        spec.transform = transform;
        write(path("dem.tif"), spec);
        run_well({"-q", "-trace", mode, "-overwrite", "dem.tif", "out.gpkg"});
        std::vector<std::pair<double, double>> result;
        for (const Record& record : layer("out.gpkg", "contours").records) {
            EXPECT_TRUE(record.valid());
            result.emplace_back(record.number("level"), record.area());
        }
        std::sort(result.begin(), result.end());
        return result;
    }
    void expect_same(const RasterSpec& spec, const RasterSpec& other, const Transform& transform) const {
        const Transform north_up{391000, 1, 0, 5820000, 0, -1};
        for (const char* mode : {"points", "cells"}) {
            const auto expected = areas(spec, north_up, mode);
            const auto found = areas(other, transform, mode);
            ASSERT_EQ(found.size(), expected.size()) << mode;
            ASSERT_GT(found.size(), 2U);
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].first, expected[i].first);
                // Coordinates of seven digits before the point are exact to 1e-9.
                EXPECT_NEAR(found[i].second, expected[i].second, 1e-6);
            }
        }
    }
};

/// Mirrored, turned, sheared, of cells that are not square, and with rows that run north.
TEST_F(Variants, anyTransformGivesTheSameContours) {
    std::vector<Transform> transforms{
        {391500, -1, 0, 5820000, 0, -1}, {391000, 0.5, 0, 5820000, 0, -2}, {391000, 1, 0.5, 5820000, 0, -1}};
    for (const double degrees : {30.0, 90.0, 137.0}) {
        const double c = std::cos(degrees * M_PI / 180);
        const double s = std::sin(degrees * M_PI / 180);
        transforms.push_back({391000, c, s, 5820000, s, -c});
    }
    for (const char* name : {"courtyard_utm.tif", "thesis_50x36.tif", "hotel_70x85.tif"}) {
        const RasterSpec spec = sample_grid(name);
        for (const Transform& transform : transforms)
            expect_same(spec, spec, transform);
        expect_same(spec, upside_down(spec), {391000, 1, 0, 5820000.0 - spec.rows, 0, 1});
    }
}

TEST_F(Variants, southUpAtTheSamePlaces) {
    const RasterSpec spec = blocks();
    write(path("north.tif"), spec);
    RasterSpec south = upside_down(spec);
    south.transform = Transform{391000, 1, 0, 5819980, 0, 1};
    write(path("south.tif"), south);
    run_well({"-q", "-fl", "5", "--", "north.tif", "north.gpkg"});
    run_well({"-q", "-fl", "5", "--", "south.tif", "south.gpkg"});
    const Layer north = layer("north.gpkg", "buildings");
    const Layer found = layer("south.gpkg", "buildings");
    ASSERT_EQ(found.records.size(), north.records.size());
    for (const Record& record : north.records) {
        // The rings may begin elsewhere.
        const auto covers = [&](const Record& other) {
            return OGR_G_Contains(other.geometry(), record.geometry()) != 0 && other.area() == record.area();
        };
        EXPECT_EQ(std::count_if(found.records.begin(), found.records.end(), covers), 1);
    }
}

}  // namespace
}  // namespace d2b::test
