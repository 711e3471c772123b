#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "options/run_plan.hpp"
#include "pipeline/block_town.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/made_town.hpp"

namespace d2b::test {
namespace {

struct Scenery {
    MemorySource dem;
    DemSource* terrain = nullptr;
    DemSource* mask = nullptr;
    DemSource* ndvi = nullptr;
};

struct Found {
    pipeline::FoundBuildings buildings;
    std::vector<Label> labels;
    MemoryRaster ground;
    MemoryRaster height;
    MemoryRaster canopy;
    Context context;
};

void find(Scenery& scenery, const Options& options, const detect::UnitSize& size, int threads, Found& found) {
    const RunPlan plan = make_run_plan(options, Layers::both);
    MemorySink features;
    found.context.threads = std::make_unique<Executor>(threads);
    ElevationReader reader(scenery.dem, found.context);
    const Window window = scenery.dem.info().window;
    const Sources sources{scenery.dem, scenery.terrain, scenery.mask, scenery.ndvi};
    const Sinks sinks{features, &found.ground, &found.height, &found.canopy};
    found.buildings =
        pipeline::find_buildings({plan, sources, sinks, reader, {window, {1, 1}, 1}, found.context}, size);
    found.labels = found.buildings.band({window.row, window.rows, window.cols}).labels;
}

void expect_same_rasters(const Found& a, const Found& b) {
    const auto expect_same = [](const MemoryRaster& one, const MemoryRaster& other) {
        EXPECT_EQ(one.cells, other.cells);
        ASSERT_EQ(one.values.size(), other.values.size());
        for (std::size_t i = 0; i < one.values.size(); ++i)
            ASSERT_TRUE(one.values[i] == other.values[i] ||
                        (std::isnan(one.values[i]) && std::isnan(other.values[i])))
                << i;
    };
    expect_same(a.ground, b.ground);
    expect_same(a.height, b.height);
    expect_same(a.canopy, b.canopy);
}

/// Labels of the same cells, by those of the other; each has one of the other.
std::map<Label, Label> same_cells(const Found& a, const Found& b) {
    std::map<Label, Label> other;
    std::set<Label> used;
    for (std::size_t i = 0; i < a.labels.size(); ++i) {
        const auto [entry, is_new] = other.emplace(a.labels[i], b.labels[i]);
        if (is_new) {
            EXPECT_TRUE(used.insert(b.labels[i]).second) << "label " << b.labels[i] << " is two";
        }
        if (entry->second != b.labels[i]) {
            ADD_FAILURE() << "cell " << i;
            return {};
        }
    }
    EXPECT_EQ(other[0], 0U);
    return other;
}

/// Towns side by side and one below the other: 980 x 340 cells.
MemorySource many_towns() {
    constexpr int down = 7;
    constexpr int across = 2;
    const std::vector<double> town = MadeTown::surface();
    std::vector<double> z;
    for (int r = 0; r < down * MadeTown::rows; ++r)
        for (int c = 0; c < across * MadeTown::cols; ++c)  // the ground goes on rising
            z.push_back(town[MadeTown::index(r % MadeTown::rows, c % MadeTown::cols)] +
                        1.4 * (r / MadeTown::rows) + 5.1 * (c / MadeTown::cols));
    return {down * MadeTown::rows, across * MadeTown::cols, z};
}

struct UnitCase {
    std::int32_t side;  ///< of a unit, at most
    bool keep_doubtful;
};

class FoundInUnits : public testing::TestWithParam<UnitCase> {};

TEST_P(FoundInUnits, IsWhatIsFoundInTheWhole) {
    Scenery scenery{many_towns()};
    Options options;
    options.ground.max_building_width = 40;  // units see 200 cells around
    options.write.doubtful = GetParam().keep_doubtful;
    Found whole;
    find(scenery, options, {}, 2, whole);
    Found units;
    find(scenery, options, {0, GetParam().side}, 2, units);
    ASSERT_EQ(whole.buildings.buildings, 3 * 14);
    EXPECT_EQ(units.buildings.buildings, whole.buildings.buildings);
    ASSERT_EQ(units.buildings.count(), whole.buildings.count());
    for (const Reason reason : {Reason::building_doubtful, Reason::building_small, Reason::building_low})
        EXPECT_EQ(units.context.report.counted(reason), whole.context.report.counted(reason));
    EXPECT_EQ(units.buildings.scene.fit.cells(), whole.buildings.scene.fit.cells());
    EXPECT_EQ(units.buildings.scene.fit.bare_share(), whole.buildings.scene.fit.bare_share());
    EXPECT_EQ(units.buildings.scene.slope.cells, whole.buildings.scene.slope.cells);
    EXPECT_EQ(units.buildings.scene.slope.steep_cells, whole.buildings.scene.slope.steep_cells);
    for (const auto& [label, same] : same_cells(whole, units)) {
        const features::Footprint& a = whole.buildings.footprints[label];
        const features::Footprint& b = units.buildings.footprints[same];
        EXPECT_EQ(a.confidence, b.confidence);
        EXPECT_EQ(a.doubt, b.doubt);
        if (label != 0) {
            EXPECT_EQ(a.ground, b.ground);
        }
    }
    expect_same_rasters(whole, units);
}

/// Each town has one building with two parts, whichever units see them.
TEST_P(FoundInUnits, PartsBelongTogetherAsInTheWhole) {
    Scenery scenery{many_towns()};
    Options options;
    options.ground.max_building_width = 40;
    options.detect.split_height = 3;
    options.write.doubtful = GetParam().keep_doubtful;
    Found whole;
    find(scenery, options, {}, 2, whole);
    Found units;
    find(scenery, options, {0, GetParam().side}, 2, units);
    ASSERT_EQ(whole.buildings.buildings, 4 * 14);
    std::map<std::int64_t, std::int64_t> wholes;
    int parts = 0;
    for (const auto& [label, same] : same_cells(whole, units)) {
        const std::int64_t a = whole.buildings.footprints[label].whole;
        const std::int64_t b = units.buildings.footprints[same].whole;
        EXPECT_EQ(wholes.emplace(a, b).first->second, b) << label;
        parts += a != label ? 1 : 0;
    }
    EXPECT_EQ(parts, 14);
    EXPECT_EQ(wholes.size(), whole.buildings.footprints.size() - 14);
}

// Units of 64 cells cut every building somewhere.
INSTANTIATE_TEST_SUITE_P(, FoundInUnits,
                         testing::Values(UnitCase{64, false}, UnitCase{64, true}, UnitCase{150, true},
                                         UnitCase{300, false}));

Options options_for_blocks() {
    Options options;
    options.ground.max_building_width = 30;  // units see 150 cells around
    return options;
}

/// The one label of a box's cells but for its border.
Label label_of(const Found& found, const BlockTown& town, const Box& box) {
    std::set<Label> labels;
    for (int r = box.row + 1; r < box.row + box.rows - 1; ++r)
        for (int c = box.col + 1; c < box.col + box.cols - 1; ++c)
            labels.insert(found.labels[town.index(r, c)]);
    EXPECT_EQ(labels.size(), 1U) << "at row " << box.row << ", column " << box.col;
    return *labels.begin();
}

TEST(UnitSeams, CutNothing) {
    // Units of 100 x 100 cells.
    const Box over_two{30, 90, 14, 22};
    const Box over_three{88, 184, 24, 14};
    const Box its_wing{102, 196, 10, 22};  // the upper right unit has none of it
    const Box over_four{190, 290, 22, 22};
    const Box long_one{250, 40, 14, 420};  // longer than three units
    const Box court_left{284, 184, 34, 10};
    const Box court_right{284, 208, 34, 10};
    const Box court_top{284, 194, 10, 14};  // the corner of four units lies in the courtyard
    const Box court_bottom{308, 194, 10, 14};
    const Box west{20, 280, 16, 20};  // a party wall on the seam
    const Box east{20, 300, 16, 20};
    const Box north{184, 40, 16, 18};
    const Box south{200, 40, 16, 18};
    BlockTown town(400, 500);
    for (const Box& box : {over_two, over_three, its_wing, over_four, long_one, court_left, court_right,
                           court_top, court_bottom, west, north})
        town.build(box, 7);
    for (const Box& box : {east, south})
        town.build(box, 13);
    Scenery scenery{town.source()};
    Options options = options_for_blocks();
    options.detect.split_height = 3;
    Found units;
    find(scenery, options, {0, 100}, 2, units);
    const auto label = [&](const Box& box) { return label_of(units, town, box); };
    EXPECT_EQ(label(its_wing), label(over_three));
    for (const Box& side : {court_right, court_top, court_bottom})
        EXPECT_EQ(label(side), label(court_left));
    std::set<Label> labels;
    for (const Box& box : {over_two, over_three, over_four, long_one, court_left, west, east, north, south})
        labels.insert(label(box));
    EXPECT_EQ(labels.size(), 9U);
    EXPECT_EQ(labels.count(0), 0U);
    EXPECT_EQ(units.buildings.count(), 9U);
    EXPECT_EQ(units.labels[town.index(300, 200)], 0U);  // in the courtyard
    Found whole;
    find(scenery, options, {}, 2, whole);
    same_cells(whole, units);
    expect_same_rasters(whole, units);
}

class RandomTowns : public testing::TestWithParam<unsigned> {};

TEST_P(RandomTowns, AreTheSameInUnitsOfAnySize) {
    const BlockTown town = BlockTown::random(GetParam());
    Scenery scenery{town.source()};
    Options options = options_for_blocks();
    options.detect.split_height = GetParam() % 2 == 0 ? 3 : 0;
    Found whole;
    find(scenery, options, {}, 2, whole);
    EXPECT_GT(whole.buildings.buildings, 15U);
    for (const std::int32_t side : {64, 97, 300}) {
        SCOPED_TRACE(side);
        Found units;
        find(scenery, options, {0, side}, 2, units);
        EXPECT_EQ(units.buildings.buildings, whole.buildings.buildings);
        same_cells(whole, units);
        expect_same_rasters(whole, units);
    }
}

TEST_P(RandomTowns, AreTheSameOnAnyNumberOfThreads) {
    Scenery scenery{BlockTown::random(GetParam()).source()};
    Options options = options_for_blocks();
    options.write.doubtful = true;
    Found one;
    find(scenery, options, {0, 120}, 1, one);
    for (const int threads : {2, 5}) {
        Found more;
        find(scenery, options, {0, 120}, threads, more);
        EXPECT_EQ(more.labels, one.labels);
        EXPECT_EQ(more.buildings.buildings, one.buildings.buildings);
        ASSERT_EQ(more.buildings.count(), one.buildings.count());
        for (std::size_t i = 1; i < one.buildings.footprints.size(); ++i) {
            EXPECT_EQ(more.buildings.footprints[i].confidence, one.buildings.footprints[i].confidence);
            EXPECT_EQ(more.buildings.ground[i], one.buildings.ground[i]);
        }
        EXPECT_EQ(more.context.report.dropped, one.context.report.dropped);
        expect_same_rasters(more, one);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTowns, testing::Range(0U, 4U));

TEST(UnitsOfAWindow, ReadWhatLiesBesideTheDem) {
    const BlockTown town = BlockTown::random(77);
    Scenery scenery{town.source()};
    MemorySource terrain = town.on_grid([&](int r, int c) { return town.ground(r, c); });
    MemorySource mask = town.on_grid([](int r, int c) { return r < 250 || c > 180 ? 1.0 : 0.0; });
    MemorySource ndvi = town.on_grid([](int r, int c) { return (r + c) % 90 < 45 ? 0.5 : -0.2; });
    scenery.terrain = &terrain;
    scenery.mask = &mask;
    scenery.ndvi = &ndvi;
    for (MemorySource* source : {&scenery.dem, &terrain, &mask, &ndvi})
        source->edit().window = {17, 23, town.rows - 40, town.cols - 30};
    Options options = options_for_blocks();
    options.ground.mode = GroundMode::given;
    options.ground.terrain = "terrain";
    options.detect.mask = "mask";
    options.detect.ndvi = "ndvi";
    Found whole;
    find(scenery, options, {}, 2, whole);
    EXPECT_GT(whole.buildings.buildings, 5U);
    Found units;
    find(scenery, options, {0, 110}, 2, units);
    same_cells(whole, units);
    expect_same_rasters(whole, units);
    EXPECT_TRUE(units.buildings.scene.sides.terrain && units.buildings.scene.sides.mask &&
                units.buildings.scene.sides.ndvi);
}

TEST(UnitsOfAWindow, OfOneColumnAndOfNothing) {
    Options options = options_for_blocks();
    Scenery column{MemorySource(700, 1, std::vector<double>(700, 5))};
    Found found;
    find(column, options, {0, 64}, 2, found);
    EXPECT_EQ(found.buildings.count(), 0U);
    EXPECT_EQ(found.ground.values, std::vector<float>(700, 5));
    Scenery nothing{MemorySource(90, 200, std::vector<double>(18000, std::nan("")))};
    Found none;
    find(nothing, options, {0, 64}, 2, none);
    EXPECT_EQ(none.buildings.count(), 0U);
    EXPECT_EQ(none.ground.cells, 18000);
}

/// A square of cells of half a metre, none of which can be read.
class VastSource final : public DemSource {
  public:
    explicit VastSource(std::int32_t side) {
        info_.name = "vast";
        info_.rows = info_.cols = side;
        info_.window = {0, 0, side, side};
        info_.transform = {0, 0.5, 0, 0, 0, -0.5};
    }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(const Window& /*part*/, std::span<double> /*elevations*/) override {
        throw InputError("nothing to read");
    }

  private:
    DemInfo info_;
};

/// Warnings of a run on it, and its last message.
std::vector<std::string> told(std::int32_t side, const Options& options) {
    VastSource dem(side);
    MemorySink features;
    std::vector<std::string> texts;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) { texts.push_back(text); };
    try {
        run(options, {dem}, {features}, callbacks);
    } catch (const Error& error) {
        texts.emplace_back(error.what());
    }
    return texts;
}

TEST(UnitsOfAWindow, SayHowMuchMemoryTheyNeed) {
    using Told = std::vector<std::string>;
    Options options;
    options.ground.max_building_width = 50;  // 6,000 own cells a side, and 500 around: 49 million
    EXPECT_EQ(told(24000, options), Told{"nothing to read"});
    options.ground.max_building_width = 60;
    EXPECT_EQ(told(24000, options),
              (Told{"Ground and buildings are searched in up to 52 million points at a time, because each "
                    "part of the raster has a margin of 300 m (five times -max_building_width "
                    "60), which takes some 1 GiB of memory.",
                    "nothing to read"}));
    options.preset = Preset::thesis;
    options.ground = {};
    EXPECT_EQ(told(24000, options), Told{"nothing to read"});
}

TEST(UnitsOfAWindow, AreRefusedWhereTheyAreTooLarge) {
    Options options;
    options.ground.max_building_width = 2000;  // 6,000 own cells a side, and 20,000 around
    EXPECT_EQ(told(60000, options),
              std::vector<std::string>{
                  "Ground and buildings would be searched in 2116 million points at a time, because each "
                  "part of the raster has a margin of 10000 m (five times -max_building_width "
                  "2000), which takes some 39 GiB of memory; more than 1074 million points exceed the limit, "
                  "so give a smaller -max_building_width."});
    options.ground.max_building_width = 1000;
    EXPECT_EQ(told(60000, options).size(), 2U);
}

}  // namespace
}  // namespace d2b::test
