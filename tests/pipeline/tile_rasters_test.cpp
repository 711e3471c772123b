#include "pipeline/tiles/tile_rasters.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/open_sources.hpp"
#include "pipeline/random_town.hpp"
#include "pipeline/run.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b::tiles {
namespace {

using namespace test;

namespace fs = std::filesystem;

constexpr detect::UnitSize many_units{0, 64};

/// A raster as its readers see it.
struct Seen {
    DemInfo info;
    std::vector<double> values;
};

Seen seen(const fs::path& path) {
    ReadOptions options;
    options.source = path.string();
    const auto source = open_dem(options);
    Seen raster{source->info(), {}};
    raster.values.resize(static_cast<std::size_t>(raster.info.window.points()));
    source->read(raster.info.window, raster.values);
    return raster;
}

void expect_same(const Seen& a, const Seen& b) {
    EXPECT_EQ(a.info.window, b.info.window);
    EXPECT_EQ(a.info.transform, b.info.transform);
    EXPECT_EQ(a.info.crs_wkt, b.info.crs_wkt);
    ASSERT_EQ(a.values.size(), b.values.size());
    const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    EXPECT_TRUE(std::ranges::equal(a.values, b.values, same));
}

std::vector<std::int64_t> shuffled(std::int64_t count, unsigned seed) {
    std::vector<std::int64_t> tiles(static_cast<std::size_t>(count));
    std::iota(tiles.begin(), tiles.end(), 0);
    std::shuffle(tiles.begin(), tiles.end(), std::mt19937(seed));
    return tiles;
}

/// Names the rasters in a folder, by their endings.
void name_rasters(Options& options, const fs::path& folder, const std::string& extension) {
    options.write.ground = (folder / ("ground" + extension)).string();
    options.write.height = (folder / ("height" + extension)).string();
    options.write.canopy = (folder / ("canopy" + extension)).string();
}

/// @param window of the town, which is placed already
void compare_rasters(MemorySource& dem, Options options) {
    const TemporaryFolder folder;
    options.ground.max_building_width = 20;  // units see 100 cells around
    name_rasters(options, folder.path(), ".tif");
    {
        const AuxiliarySinks sinks = open_auxiliary_sinks(options, dem.info());
        Result whole;
        (void)pipeline::run_in_units(options, {dem},
                                     {whole.sink, sinks.ground.get(), sinks.height.get(), sinks.canopy.get()},
                                     {}, many_units);
    }
    for (const std::int32_t side : {1, 2}) {
        const fs::path work = folder.path() / ("work" + std::to_string(side));
        fs::create_directory(work);
        name_rasters(options, work, ".vrt");
        StepsInTiles steps({dem}, options, {work, some_plan, side, many_units});
        const std::int64_t count = steps.count();
        for (const std::int64_t tile : shuffled(count, static_cast<unsigned>(side)))
            steps.find(tile);
        steps.join();
        for (const std::string name : {"ground", "height", "canopy"}) {
            SCOPED_TRACE(name + ", -tile " + std::to_string(side));
            const Seen whole = seen(folder.path() / (name + ".tif"));
            expect_same(seen(work / (name + ".vrt")), whole);
            EXPECT_GT(std::ranges::count_if(whole.values, [](double z) { return z > 3; }), 20);
            EXPECT_EQ(std::distance(fs::directory_iterator(work / name), {}), count);
        }
    }
}

TEST(TileRasters, AreThoseOfOneRun) {
    MemorySource dem = random_town(3, {150, 190, 30, true, true});
    place_in_utm(dem, 1);
    compare_rasters(dem, {});
    dem.edit().window = {31, 17, 110, 150};
    compare_rasters(dem, {});
}

TEST(TileRasters, OfRotatedGrids) {
    MemorySource dem = random_town(4, {110, 130, 15, false, true});
    dem.edit().transform = {600000, 0.8, -0.6, 5800000, -0.6, -0.8};
    dem.edit().crs_wkt = "";
    Options options;
    options.read.crs = "EPSG:25832";
    compare_rasters(dem, options);
}

/// A town of six tiles.
class RastersOfATown : public testing::Test {
  protected:
    RastersOfATown() : dem_(random_town(4, {110, 130, 15, false, true})) {
        place_in_utm(dem_, 1);
        options_.ground.max_building_width = 20;
        options_.write.ground = (folder_.path() / "ground.vrt").string();
    }
    [[nodiscard]] StepsInTiles steps() {
        return {{dem_}, options_, {folder_.path(), some_plan, 1, many_units}};
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    MemorySource dem_;
    Options options_;
    TemporaryFolder folder_;
};

TEST_F(RastersOfATown, AreMadeAgainWhereTheyAreGone) {
    for (std::int64_t tile = 0; tile < steps().count(); ++tile)
        steps().find(tile);
    const Seen first = seen(path("ground/1.tif"));
    fs::remove(path("ground/1.tif"));
    fs::create_directory(path("ground/.dem2buildings.killed"));
    steps().find(1);
    expect_same(seen(path("ground/1.tif")), first);
    steps().join();
    EXPECT_FALSE(fs::exists(path("ground/.dem2buildings.killed")));
    EXPECT_TRUE(fs::exists(path("ground.vrt")));
}

TEST_F(RastersOfATown, AreMadeByTwoAtATime) {
    PlannedSink nowhere(Layers::both);
    TileRun run({folder_.path(), some_plan, 1, many_units}, options_, {dem_}, nowhere, {});
    const Window own = run.tiles().whole(0).own;
    const std::vector<float> values(static_cast<std::size_t>(own.points()), 7.5F);
    AuxiliarySinks first = open_tile_rasters(run, 0);
    AuxiliarySinks second = open_tile_rasters(run, 0);
    first.ground->write(own, values);
    second.ground->write(own, values);
    finish_tile_rasters(run, 0, first);
    finish_tile_rasters(run, 0, second);
    EXPECT_EQ(seen(path("ground/0.tif")).values, std::vector<double>(values.begin(), values.end()));
    // Reports a raster that cannot be written at all.
    AuxiliarySinks third = open_tile_rasters(run, 1);
    EXPECT_THROW(finish_tile_rasters(run, 1, third), OutputError);
    EXPECT_FALSE(fs::exists(path("ground/1.tif")));
}

TEST_F(RastersOfATown, AreNotShownWithoutTheFirst) {
    for (std::int64_t tile = 0; tile < steps().count(); ++tile)
        steps().find(tile);
    std::ofstream(path("ground/0.tif")) << "no raster";
    const std::string said = refusal([&] { steps().join(); });
    EXPECT_TRUE(said.starts_with("'" + path("ground/0.tif") + "' cannot be read: ")) << said;
    EXPECT_TRUE(said.ends_with("; delete it and run 'find' of tile 0 again.")) << said;
    EXPECT_FALSE(fs::exists(path("ground.vrt")));
}

TEST_F(RastersOfATown, NeedAFolder) {
    std::ofstream(path("ground")) << "no folder";
    EXPECT_EQ(refusal([&] { steps().find(0); }),
              "\"" + path("ground") +
                  "\" cannot be made: Not a directory; free some space, or allow writing to it.");
}

TEST_F(RastersOfATown, HaveNamesOfTheirOwn) {
    const auto said = [&](const std::string& ground, const std::string& height) {
        Options options;
        options.write.ground = ground;
        options.write.height = height;
        return refusal([&] { require_raster_names(options); });
    };
    EXPECT_EQ(said("", ""), "(nothing)");
    EXPECT_EQ(said(path("a.vrt"), path("b.vrt")), "(nothing)");
    EXPECT_EQ(said(path("a.vrt"), path("a.vrt")),
              "\"" + path("a.vrt") + "\" is the name of two rasters; give each its own.");
    for (const std::string name : {"a.tif", "/vsimem/a.vrt"})
        EXPECT_EQ(said(name, ""),
                  "-write_ground in tiles is one file per tile and a VRT that joins them; give the name of "
                  "the VRT on a disk, such as a.vrt, not \"" +
                      name + "\".");
    EXPECT_TRUE(said("", "a.tif").starts_with("-write_height in tiles is "));
    fs::create_directory(path("there"));
    EXPECT_EQ(said(path("there.vrt"), ""),
              "\"" + path("there") +
                  "\" exists, and tiles do not replace rasters; give another name, or delete it.");
}

}  // namespace
}  // namespace d2b::tiles
