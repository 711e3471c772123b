#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "pipeline/block_town.hpp"
#include "pipeline/random_town.hpp"
#include "pipeline/run.hpp"
#include "pipeline/tiles/drawn_tile.hpp"
#include "pipeline/tiles_case.hpp"

namespace d2b::tiles {
namespace {

using namespace test;
using test::Box;  // not that of geometry

Options options_of(unsigned seed) {
    Options options;
    options.ground.max_building_width = 20;  // units see 100 cells around
    options.outline.walls = std::array{Walls::automatic, Walls::automatic, Walls::off, Walls::free}[seed % 4];
    options.levels.source = seed % 5 == 0 ? LevelSource::global : LevelSource::natural;
    options.filter.noise_factor = static_cast<int>(seed % 3 * 8);
    options.detect.min_building_height = seed % 4 == 1 ? 7 : 0;
    options.detect.split_height = seed % 3 == 1 ? 2 : 0;
    options.write.doubtful = seed % 2 == 0;
    options.outline.disjoint = seed % 7 == 3;
    options.write.roofs = seed % 5 != 2;
    return options;
}

void compare(MemorySource& dem, const Options& options, const detect::UnitSize& units,
             const TileOrder& order) {
    Result whole;
    expect_same_in_tiles({dem}, options, units, order, whole);
    EXPECT_GT(whole.report.buildings, 0);
}

/// North up in metres, rotated in metres, or in degrees.
void place_somehow(MemorySource& dem, unsigned seed) {
    place_in_utm(dem, 1);
    if (seed % 6 == 4)
        dem.edit().transform = {600000, 0.8, -0.6, 5800000, -0.6, -0.8};
    if (seed % 6 != 5)
        return;
    dem.edit().transform = {9, 1.5e-5, 0, 52, 0, -9e-6};
    dem.edit().crs_wkt = Crs("EPSG:4326").wkt();
}

/// Undeclared no data values are decided on the whole window before a tile is found.
TEST(Tiles, UndeclaredNoDataIsThatOfOneRun) {
    MemorySource dem = random_town(3, {270, 330, 60, false, false});
    std::vector<double> values(static_cast<std::size_t>(dem.info().window.points()));
    dem.read(dem.info().window, values);
    for (int row = 0; row < 270; ++row)
        for (int col = 0; col < 330; ++col)
            if (row + col < 150)
                values[static_cast<std::size_t>(row * 330 + col)] = -100;
    MemorySource collared(270, 330, values);
    place_in_utm(collared, 1);
    Result whole;
    expect_same_in_tiles({collared}, options_of(3), {0, 90}, {2, true, false, 2}, whole);
    EXPECT_EQ(whole.report.counted(Reason::elevation_undeclared_nodata), 150 * 151 / 2);
}

TEST(Tiles, CellsBlendedWithNoDataAreThoseOfOneRun) {
    MemorySource dem = random_town(3, {270, 330, 60, false, false});
    std::vector<double> values(static_cast<std::size_t>(dem.info().window.points()));
    dem.read(dem.info().window, values);
    for (int row = 0; row < 270; ++row)
        for (int col = 0; col < 330; ++col) {
            double& z = values[static_cast<std::size_t>(row * 330 + col)];
            z = row + col < 150 ? std::numeric_limits<double>::quiet_NaN() : row + col < 151 ? z / 2 : z;
        }
    MemorySource blended(270, 330, values);
    place_in_utm(blended, 1);
    blended.edit().nodata = 0;
    Result whole;
    expect_same_in_tiles({blended}, options_of(3), {0, 90}, {2, true, false, 2}, whole);
    // Two rows and columns from the diagonal. Each next diagonal has one cell more, but at both ends of the
    // last two the missing cells are farther away.
    EXPECT_EQ(whole.report.counted(Reason::elevation_blended), 151 + 152 + (153 - 2) + (154 - 4));
}

class RandomTownInTiles : public testing::TestWithParam<unsigned> {};

TEST_P(RandomTownInTiles, IsThatOfOneRun) {
    const unsigned seed = GetParam();
    MemorySource dem = random_town(seed, {270, 330, 60, seed % 3 == 0, seed % 2 == 0});
    place_somehow(dem, seed);
    const detect::UnitSize units{0, std::array{64, 90, 150, 300}[seed % 4]};
    const TileOrder order{std::array{1, 2, 5}[seed % 3], seed % 2 == 1, seed % 5 == 0,
                          1 + static_cast<int>(seed % 2)};
    compare(dem, options_of(seed), units, order);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTownInTiles, testing::Range(0U, 16U));

/// Options for a town of blocks, and the units that it is looked at in.
Options options_for_blocks() {
    Options options;
    options.ground.max_building_width = 30;  // units see 150 cells around
    return options;
}

/// Blocks that the seams of units of 100 x 100 cells cut in every way.
BlockTown cut_town() {
    BlockTown town(400, 500);
    // Over two, three and four units, longer than three, around a corner where four meet, and walls on seams.
    for (const Box& box :
         {Box{30, 90, 14, 22}, Box{88, 184, 24, 14}, Box{102, 196, 10, 22}, Box{190, 290, 22, 22},
          Box{250, 40, 14, 420}, Box{284, 184, 34, 10}, Box{284, 208, 34, 10}, Box{284, 194, 10, 14},
          Box{308, 194, 10, 14}, Box{20, 280, 16, 20}, Box{184, 40, 16, 18}})
        town.build(box, 7);
    for (const Box& box : {Box{20, 300, 16, 20}, Box{200, 40, 16, 18}})
        town.build(box, 13);
    // A row of houses wall to wall over four units in a row.
    for (int house = 0; house < 28; ++house)
        town.build({340 + house % 2, 60 + 13 * house, 12, 13}, 5 + 2.0 * (house % 5));
    return town;
}

/// Contours that a tile has left to merge, of all tiles.
std::size_t left_over(const std::filesystem::path& work, std::int64_t tiles) {
    std::size_t left = 0;
    for (std::int64_t tile = 0; tile < tiles; ++tile) {
        CheckpointFile file({work / "draw" / std::to_string(tile), TileStep::draw, some_plan,
                             static_cast<std::uint32_t>(tile)});
        ByteReader reader = file.body();
        left += load_drawn_tile(reader).left.size();
    }
    return left;
}

TEST(Tiles, OfBlocksThatSeamsCut) {
    MemorySource dem = cut_town().source();
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.write.roofs = true;
    const detect::UnitSize units{0, 100};
    for (const double split : {0.0, 3.0}) {
        options.detect.split_height = split;
        Result whole;
        whole.report = pipeline::run_in_units(options, {dem}, {whole.sink}, {}, units);
        EXPECT_GE(whole.report.buildings, 7);
        for (const std::int32_t side : {1, 2, 5}) {
            TemporaryFolder folder;
            Result tiles;
            StepsInTiles steps({dem}, options, {folder.path(), some_plan, side, units});
            steps.run({side, false, false, 2}, tiles);
            EXPECT_EQ(steps.count(), side == 1 ? 20 : side == 2 ? 6 : 1);
            expect_same(tiles, whole);
            // A cluster that two tiles share is drawn by neither; all others are.
            const std::size_t left = left_over(folder.path(), steps.count());
            EXPECT_EQ(left > 0, side < 5 && split > 0);
            EXPECT_LT(left, static_cast<std::size_t>(whole.report.contours));
        }
    }
}

TEST(Tiles, OfAClusterOverTwelveUnits) {
    BlockTown town(130, 1200);
    for (int house = 0; house < 80; ++house)
        town.build({60 + house % 2, 40 + 14 * house, 12, 14}, 5 + 3.0 * (house % 4));
    MemorySource dem = town.source();
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.detect.split_height = 2;
    options.write.roofs = true;
    const TemporaryFolder folder;
    Result whole;
    whole.report = pipeline::run_in_units(options, {dem}, {whole.sink}, {}, {0, 100});
    EXPECT_GE(whole.report.buildings, 60);
    Result tiles;
    StepsInTiles steps({dem}, options, {folder.path(), some_plan, 1, {0, 100}});
    steps.run({1, true}, tiles);
    EXPECT_EQ(steps.count(), 2 * 12);
    expect_same(tiles, whole);
    // All houses are one cluster, which merge draws.
    EXPECT_EQ(left_over(folder.path(), steps.count()), static_cast<std::size_t>(whole.report.contours));
}

TEST(Tiles, OfRotatedGridsAndDegrees) {
    MemorySource dem = cut_town().source();
    const detect::UnitSize units{0, 100};
    dem.edit().transform = {600000, 0.8, -0.6, 5800000, -0.6, -0.8};
    dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Options options = options_for_blocks();
    options.detect.split_height = 3;
    options.write.roofs = true;
    compare(dem, options, units, {2});
    dem.edit().transform = {9, 1.5e-5, 0, 52, 0, -9e-6};
    dem.edit().crs_wkt = Crs("EPSG:4326").wkt();
    compare(dem, options, units, {2});
    options.outline.target_crs = "EPSG:25832";
    options.outline.walls = Walls::off;  // corners that others have on them
    compare(dem, options, units, {1});
}

TEST(Tiles, OfAWindowOfALargerRaster) {
    MemorySource dem = cut_town().source();
    place_in_utm(dem, 1);
    dem.edit().window = {15, 25, 370, 440};
    Options options = options_for_blocks();
    options.write.roofs = true;
    compare(dem, options, {0, 97}, {1, true});
}

constexpr std::size_t roof_layer = 2;  // after buildings and contours

/// The town of blocks, with gables that rise by half a metre a cell, along seams and over them.
BlockTown gabled_town() {
    BlockTown town = cut_town();
    for (const Box& box : {Box{60, 30, 12, 20}, Box{94, 120, 12, 22}, Box{290, 95, 20, 12},
                           Box{140, 292, 14, 20}, Box{150, 420, 12, 24}})
        for (int r = 0; r < box.rows; ++r)
            for (int c = 0; c < box.cols; ++c) {
                const int across =
                    box.rows < box.cols ? std::min(r, box.rows - 1 - r) : std::min(c, box.cols - 1 - c);
                const std::size_t cell = town.index(box.row + r, box.col + c);
                town.z[cell] = BlockTown::ground(box.row, box.col) + 4 + 0.5 * across + town.noise[cell];
            }
    return town;
}

/// Parts of a building are known by its lowest id, whichever tiles draw them.
TEST(Tiles, OfRoofsThatSeamsCut) {
    MemorySource dem = gabled_town().source();
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.write.roofs = true;
    options.detect.split_height = 3;
    for (const auto& [side, cells] : {std::pair{1, 100}, std::pair{1, 70}, std::pair{3, 90}}) {
        Result whole;
        expect_same_in_tiles({dem}, options, {0, cells}, {side, cells == 70, false, 2}, whole);
        std::set<std::string> kinds;
        std::set<std::int64_t> parts;
        std::set<std::int64_t> named;
        for (std::size_t i = 0; i < whole.sink.features.at(roof_layer).size(); ++i) {
            kinds.insert(std::get<std::string>(whole.sink.value(roof_layer, i, "kind")));
            if (whole.sink.value(roof_layer, i, "part_id") == FieldValue{})
                continue;
            parts.insert(whole.sink.whole(roof_layer, i, "bldg_id"));
            named.insert(whole.sink.whole(roof_layer, i, "part_id"));
        }
        EXPECT_TRUE(kinds.contains("flat") && kinds.contains("pitched"));
        EXPECT_GE(named.size(), 2U);
        EXPECT_GE(parts.size(), 2 * named.size());
        EXPECT_TRUE(std::ranges::includes(parts, named));
    }
}

/// Where a destination has features already, ids of faces and those that they refer to follow them.
TEST(Tiles, OfRoofsThatAreAdded) {
    MemorySource dem = gabled_town().source();
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.write.roofs = true;
    options.detect.split_height = 3;
    const detect::UnitSize units{0, 100};
    Result alone;
    alone.report = pipeline::run_in_units(options, {dem}, {alone.sink}, {}, units);
    Result whole;
    whole.sink.first = 101;
    whole.report = pipeline::run_in_units(options, {dem}, {whole.sink}, {}, units);
    ASSERT_EQ(whole.sink.features.at(roof_layer).size(), alone.sink.features.at(roof_layer).size());
    for (std::size_t i = 0; i < whole.sink.features[roof_layer].size(); ++i)
        for (const char* field : {"id", "bldg_id", "part_id"}) {
            const FieldValue before = alone.sink.value(roof_layer, i, field);
            const FieldValue after = whole.sink.value(roof_layer, i, field);
            if (const auto* id = std::get_if<std::int64_t>(&before))
                EXPECT_EQ(after, FieldValue{*id + 100}) << field;
            else
                EXPECT_EQ(after, before) << field;
        }
    const TemporaryFolder folder;
    Result tiles;
    tiles.sink.first = 101;
    StepsInTiles({dem}, options, {folder.path(), some_plan, 1, units}).run({}, tiles);
    expect_same(tiles, whole);
}

/// Whether walls are blurred is decided of the whole window, not of a tile.
TEST(Tiles, OfRoofsWithBlurredWalls) {
    const BlockTown town = gabled_town();
    constexpr int reach = 2;
    MemorySource dem = town.on_grid([&](int row, int col) {
        double sum = 0;
        int count = 0;
        for (int r = std::max(0, row - reach); r <= std::min(town.rows - 1, row + reach); ++r)
            for (int c = std::max(0, col - reach); c <= std::min(town.cols - 1, col + reach); ++c, ++count)
                sum += town.z[town.index(r, c)];
        return sum / count;
    });
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.write.roofs = true;
    options.detect.split_height = 3;
    Result whole;
    expect_same_in_tiles({dem}, options, {0, 100}, {1}, whole);
    ASSERT_TRUE(whole.report.roofs);
    EXPECT_TRUE(whole.report.roofs->level);
    EXPECT_GT(whole.report.roofs->faces(), 10);
}

TEST(Tiles, OfContoursOrBuildingsAlone) {
    MemorySource dem = cut_town().source();
    place_in_utm(dem, 1);
    Options options = options_for_blocks();
    options.detect.split_height = 3;
    const detect::UnitSize units{0, 100};
    for (const Layers layers : {Layers::buildings, Layers::contours}) {
        options.write.layers = layers;
        options.write.roofs = layers == Layers::buildings;
        Result whole;
        whole.report = pipeline::run_in_units(options, {dem}, {whole.sink}, {}, units);
        TemporaryFolder folder;
        Result tiles;
        StepsInTiles({dem}, options, {folder.path(), some_plan, 1, units}, layers).run({}, tiles);
        EXPECT_GT(whole.sink.features.at(0).size(), 5U);
        expect_same(tiles, whole);
    }
}

TEST(Tiles, OfOneColumnAndOfNothing) {
    const std::vector<double> nothing(18000, std::nan(""));
    for (const auto& [rows, cols, z] :
         {std::tuple{700, 1, std::vector<double>(700, 5)}, std::tuple{90, 200, nothing}}) {
        MemorySource dem(rows, cols, z);
        place_in_utm(dem, 1);
        Result whole;
        whole.report = pipeline::run_in_units(options_for_blocks(), {dem}, {whole.sink}, {}, {0, 64});
        TemporaryFolder folder;
        Result tiles;
        StepsInTiles({dem}, options_for_blocks(), {folder.path(), some_plan, 1, {0, 64}}).run({}, tiles);
        EXPECT_EQ(whole.report.buildings, 0);
        EXPECT_FALSE(whole.report.warnings.empty());
        expect_same(tiles, whole);
    }
}

/// Rasters beside a town: its terrain, where to look, and green cells.
struct Beside {
    explicit Beside(const BlockTown& town)
        : terrain(town.on_grid([&](int r, int c) { return town.ground(r, c); })),
          mask(town.on_grid([](int r, int c) { return r < 250 || c > 180 ? 1.0 : 0.0; })),
          ndvi(town.on_grid([](int r, int c) { return (r + c) % 90 < 45 ? 0.5 : -0.2; })) {}

    MemorySource terrain;
    MemorySource mask;
    MemorySource ndvi;
};

TEST(Tiles, WithWhatLiesBesideTheDem) {
    const BlockTown town = cut_town();
    MemorySource dem = town.source();
    Beside beside(town);
    for (MemorySource* source : {&dem, &beside.terrain, &beside.mask, &beside.ndvi})
        place_in_utm(*source, 1);
    Options options;
    options.ground.mode = GroundMode::given;
    options.ground.terrain = "terrain";
    options.detect.mask = "mask";
    options.detect.ndvi = "ndvi";
    for (const std::int32_t side : {1, 2}) {
        Result whole;
        expect_same_in_tiles({dem, &beside.terrain, &beside.mask, &beside.ndvi}, options, {0, 100}, {side},
                             whole);
        EXPECT_GT(whole.report.buildings, 3);
    }
}

/// Terrain with values that can be no ground in some cells, which is reported when all have been read.
class DoubtfulTerrain final : public DemSource {
  public:
    explicit DoubtfulTerrain(MemorySource& sound)
        : sound_(sound), seen_(static_cast<std::size_t>(sound.info().window.points())) {}
    [[nodiscard]] const DemInfo& info() const override { return sound_.info(); }
    void read(const Window& part, std::span<double> elevations) override {
        sound_.read(part, elevations);
        const std::lock_guard lock(mutex_);
        for (std::int32_t row = part.row; row < part.end_row(); ++row)
            for (std::int32_t col = part.col; col < part.end_col(); ++col) {
                const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(info().cols) +
                                  static_cast<std::size_t>(col);
                if (seen_[cell])
                    continue;
                seen_[cell] = true;
                outside_ += row % 100 < 3 && col < 5 ? 1 : 0;
                ++read_;
            }
    }
    [[nodiscard]] std::int64_t cells_outside_range() const override { return outside_; }
    [[nodiscard]] std::vector<std::string> take_warnings() override {
        if (read_ < std::ssize(seen_) || std::exchange(told_, true))
            return {};
        return {std::to_string(outside_) + " cells are no ground."};
    }

  private:
    MemorySource& sound_;
    std::mutex mutex_;
    std::vector<bool> seen_;
    std::int64_t read_ = 0;
    std::int64_t outside_ = 0;
    bool told_ = false;
};

TEST(Tiles, OfATerrainThatIsPartlyNone) {
    const BlockTown town = cut_town();
    MemorySource dem = town.source();
    MemorySource sound = town.on_grid([&](int r, int c) { return town.ground(r, c); });
    for (MemorySource* source : {&dem, &sound})
        place_in_utm(*source, 1);
    Options options;
    options.ground.mode = GroundMode::given;
    options.ground.terrain = "terrain";
    const detect::UnitSize units{0, 100};
    Result whole;
    {
        DoubtfulTerrain terrain(sound);
        whole.report = pipeline::run_in_units(options, {dem, &terrain}, {whole.sink}, {}, units);
    }
    EXPECT_EQ(whole.report.counted(Reason::terrain_outside_range), 4 * 3 * 5);
    ASSERT_FALSE(whole.report.warnings.empty());
    EXPECT_EQ(whole.report.warnings.front(), "60 cells are no ground.");
    DoubtfulTerrain terrain(sound);
    const TemporaryFolder folder;
    Result tiles;
    StepsInTiles({dem, &terrain}, options, {folder.path(), some_plan, 1, units}).run({}, tiles);
    expect_same(tiles, whole);
}

class TilesOfATown : public testing::Test {
  protected:
    TilesOfATown() : dem_(cut_town().source()) { place_in_utm(dem_, 1); }
    [[nodiscard]] StepsInTiles steps(std::uint64_t plan = some_plan) {
        // The town has no undeclared values, as plan would have found.
        return {{dem_}, options_for_blocks(), {folder_.path(), plan, 2, {0, 100}, UndeclaredNodata{}}};
    }
    [[nodiscard]] std::string name(const std::string& file) const {
        return "'" + (folder_.path() / file).string() + "'";
    }
    void change(const std::string& file, const std::function<void(std::string&)>& how) const {
        std::string bytes = bytes_of(file);
        how(bytes);
        std::ofstream(folder_.path() / file, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::string bytes_of(const std::string& file) const {
        std::ifstream in(folder_.path() / file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    MemorySource dem_;
    TemporaryFolder folder_;
};

TEST_F(TilesOfATown, AreNotDoneAgain) {
    Result first;
    steps().run({2}, first);
    const int reads = dem_.reads;
    Result second;
    steps().run({2, true, true}, second);
    EXPECT_EQ(dem_.reads, reads);
    expect_same(second, first);
    // Lost files are made again.
    std::filesystem::remove(folder_.path() / "draw" / "3");
    Result third;
    EXPECT_NE(refusal([&] { steps().merge(third); }), "(nothing)");
    steps().draw(3);
    EXPECT_GT(dem_.reads, reads);
    Result fourth;
    steps().merge(fourth);
    expect_same(fourth, first);
}

TEST_F(TilesOfATown, LeaveNothingOfStepsThatWereKilled) {
    const auto begun = [&](const std::string& file) {
        std::ofstream(folder_.path() / file) << "a part of one";
        return folder_.path() / file;
    };
    for (std::int64_t tile = 0; tile < 6; ++tile)
        steps().find(tile);
    const auto found = begun("find/.3.17.4");
    steps().join();
    EXPECT_FALSE(std::filesystem::exists(found));
    for (std::int64_t tile = 0; tile < 6; ++tile)
        steps().draw(tile);
    const auto drawn = begun("draw/.0.17.4");
    Result result;
    steps().merge(result);
    EXPECT_FALSE(std::filesystem::exists(drawn));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "draw" / "0"));
}

TEST_F(TilesOfATown, AreDoneByTwoAtATime) {
    Result alone;
    steps().run({2}, alone);
    for (const char* step : {"find", "join", "draw"})
        std::filesystem::remove_all(folder_.path() / step);
    const auto both = [&](const auto& step) {
        std::thread other(step);
        step();
        other.join();
    };
    for (std::int64_t tile = 0; tile < 6; ++tile)
        both([&] { steps().find(tile); });
    both([&] { steps().join(); });
    for (std::int64_t tile = 0; tile < 6; ++tile)
        both([&] { steps().draw(tile); });
    Result together;
    steps().merge(together);
    expect_same(together, alone);
}

TEST_F(TilesOfATown, WaitForTheStepsBefore) {
    EXPECT_EQ(refusal([&] { steps().join(); }),
              name("find/0") + " cannot be read: No such file or directory; run 'find' of tile 0 first.");
    for (std::int64_t tile = 0; tile < 6; ++tile)
        steps().find(tile);
    EXPECT_EQ(refusal([&] { steps().draw(4); }),
              name("join/4") + " cannot be read: No such file or directory; run 'join' first.");
    steps().join();
    Result result;
    EXPECT_EQ(refusal([&] { steps().merge(result); }),
              name("draw/0") + " cannot be read: No such file or directory; run 'draw' of tile 0 first.");
    EXPECT_FALSE(result.sink.finished);
}

TEST_F(TilesOfATown, RefuseFilesThatAreNotTheirs) {
    Result result;
    steps().run({2}, result);
    std::filesystem::remove(folder_.path() / "join" / "frame");
    const std::string again = "; delete it and run 'find' of tile 2 again.";
    const std::string whole = bytes_of("find/2");
    const auto said = [&](const std::function<void(std::string&)>& how) {
        change("find/2", how);
        const std::string text = refusal([&] { steps().join(); });
        change("find/2", [&](std::string& bytes) { bytes = whole; });
        return text;
    };
    EXPECT_EQ(said([](std::string& bytes) { bytes.resize(20); }),
              name("find/2") + " is damaged: it is truncated" + again);
    EXPECT_EQ(said([](std::string& bytes) { bytes.pop_back(); }),
              name("find/2") + " is damaged: it is " + std::to_string(whole.size() - 1) +
                  " bytes long and should be of another length" + again);
    EXPECT_EQ(said([](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; }),
              name("find/2") + " is damaged: its bytes have changed since it was written" + again);
    EXPECT_EQ(said([](std::string& bytes) { bytes[0] = 'x'; }),
              name("find/2") + " is not the file that 'find' of tile 2 writes" + again);
    EXPECT_EQ(said([&](std::string& bytes) { bytes = bytes_of("find/1"); }),
              name("find/2") + " is not the file that 'find' of tile 2 writes" + again);
    EXPECT_EQ(said([](std::string& bytes) { bytes[8] = '9'; }),
              name("find/2") + " was written by another version of dem2buildings" + again);
    EXPECT_EQ(refusal([&] { steps(some_plan + 1).join(); }),
              name("find/0") + " belongs to another plan; delete it and run 'find' of tile 0 again.");
    // None of them counts as done.
    change("find/2", [](std::string& bytes) { bytes.pop_back(); });
    const int reads = dem_.reads;
    steps().find(2);
    EXPECT_GT(dem_.reads, reads);
    steps().join();
}

TEST_F(TilesOfATown, RefuseDrawnContoursThatAreDamaged) {
    Result result;
    steps().run({2}, result);
    change("draw/2", [](std::string& bytes) { bytes.back() ^= 1; });
    Result again;
    EXPECT_EQ(refusal([&] { steps().merge(again); }),
              name("draw/2") +
                  " is damaged: its bytes have changed since it was written; delete it and run 'draw' of "
                  "tile 2 again.");
    EXPECT_FALSE(again.sink.finished);
}

TEST(TilesRefuse, WhatTheyCannotDoExactly) {
    const auto said = [](const std::function<void(Options&)>& ask) {
        Options options;
        ask(options);
        return refusal([&] { require_tileable(options); });
    };
    EXPECT_EQ(said([](Options&) {}), "(nothing)");
    EXPECT_EQ(said([](Options& o) { o.preset = Preset::thesis; }),
              "-preset thesis does not work in tiles, because a contour may fill the whole raster; run "
              "dem2buildings -preset thesis.");
    EXPECT_EQ(said([](Options& o) { o.outline.simplify = 1; }),
              "-simplify does not work in tiles: simplified borders may be shared by all tiles; leave it "
              "out, or run dem2buildings.");
    const std::string flow = "changes of outlines depend on others that may be far away";
    const std::vector<std::tuple<std::string, std::string, std::function<void(Options&)>>> refused{
        {"-flow_ready", flow, [](Options& o) { o.outline.flow_ready = 1; }},
        {"-min_gap", flow, [](Options& o) { o.outline.min_gap = 1; }},
        {"-min_wall", flow, [](Options& o) { o.outline.min_wall = 1; }},
        {"-preview", "a picture needs the whole area", [](Options& o) { o.write.preview = "a.png"; }},
        {"-surface", "a surface needs the whole area", [](Options& o) { o.write.surfaces = {"a.obj"}; }},
        {"-page", "a page needs the whole area", [](Options& o) { o.write.page = "a.html"; }},
        {"-write_rejected", "only a run without tiles keeps dropped contours",
         [](Options& o) { o.write.rejected = true; }}};
    for (const auto& [option, why, ask] : refused)
        EXPECT_EQ(said(ask),
                  option + " does not work in tiles: " + why + "; leave it out, or run dem2buildings.");
}

}  // namespace
}  // namespace d2b::tiles
