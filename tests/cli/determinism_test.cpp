#include <algorithm>
#include <locale.h>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

/// The same input and options give the same result, to the bit.
class Determinism : public CliTest {
  protected:
    struct Result {
        std::string bytes;
        json report;  ///< without what differs from run to run: seconds and memory
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

TEST_F(Determinism, ofBuildings) {
    const Arguments buildings{"-preset", "buildings", "-split_height", "3", "-write_doubtful"};
    Arguments other = buildings;
    other.insert(other.end(), {"--config", "GDAL_CACHEMAX=1", "--config", "GDAL_NUM_THREADS=4"});
    expect_same("out.gpkg", buildings, other);
}

TEST_F(Determinism, theCacheDoesNotMatter) {
    expect_same("out.gpkg", {}, {"--config", "GDAL_CACHEMAX=1", "--config", "GDAL_NUM_THREADS=4"});
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

}  // namespace
}  // namespace d2b::test
