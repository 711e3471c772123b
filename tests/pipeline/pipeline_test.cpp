#include <cmath>
#include <pthread.h>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "options/option_table.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

using test::block;
using test::buildings;
using test::cells;
using test::contours;
using test::MemorySink;
using test::MemorySource;
using test::Result;
using test::run_on;

TEST(Pipeline, ABlockInPlainUnits) {
    MemorySource source = block();
    Result result;
    run_on(source, cells({10}), result);
    EXPECT_TRUE(result.sink.finished);
    ASSERT_EQ(result.sink.features[buildings].size(), 1U);
    ASSERT_EQ(result.sink.features[contours].size(), 2U);
    EXPECT_EQ(result.sink.layers[buildings].name, "buildings");
    EXPECT_EQ(result.sink.layers[contours].name, "contours");
    EXPECT_EQ(result.sink.number(buildings, 0, "area_m2"), 24);
    EXPECT_EQ(result.sink.number(buildings, 0, "perim_m"), 20);
    EXPECT_EQ(result.sink.number(buildings, 0, "height"), 15);
    EXPECT_EQ(result.sink.number(contours, 0, "area_m2"), 120);
    EXPECT_EQ(result.sink.features[buildings][0].parts[0].exterior,
              (WorldRing{{2, -3}, {2, -7}, {8, -7}, {8, -3}}));
    EXPECT_EQ(result.report.vertices, 8);
    EXPECT_EQ(result.report.levels.size(), 2U);
    EXPECT_EQ(result.report.levels[1].points, 24);
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST(Pipeline, GeodesicAreasOnAProjectedGrid) {
    // On the central meridian of UTM lengths are 0.9996 of the true ones.
    MemorySource source = block();
    source.edit().transform = {500000, 1, 0, 5000000, 0, -1};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Result result;
    run_on(source, cells({10}), result);
    EXPECT_NEAR(result.sink.number(buildings, 0, "area_m2"), 24 / (0.9996 * 0.9996), 0.005);  // in hundredths
    EXPECT_NEAR(result.sink.number(buildings, 0, "perim_m"), 20 / 0.9996, 0.005);
    EXPECT_EQ(result.report.units.areas, "geodesic");
}

TEST(Pipeline, MinAreaIsInSquareMetresOnAGridOfFeet) {
    // 24 cells of 10 ft: 24 * 9.290304 m2 = 222.967 m2, a little more on the ellipsoid.
    const auto count = [](double min_area) {
        MemorySource source = block();
        source.edit().transform = {13000000, 10, 0, 280000, 0, -10};
        source.edit().crs_wkt = Crs("EPSG:2253").wkt();
        Options options = cells({10});
        options.filter.min_area_m2 = min_area;
        Result result;
        run_on(source, options, result);
        return result.sink.features[buildings].size();
    };
    EXPECT_EQ(count(222.5), 1U);
    EXPECT_EQ(count(223.5), 0U);
}

TEST(Pipeline, HeightsAreMetresElevationsStay) {
    MemorySource source = block();
    source.edit().band_unit = "ft";
    Result result;
    run_on(source, cells({10}), result);
    EXPECT_EQ(result.sink.number(buildings, 0, "roof"), 20);
    EXPECT_EQ(result.sink.number(buildings, 0, "ground"), 5);
    EXPECT_NEAR(result.sink.number(buildings, 0, "height"), 15 * 0.3048, 0.005);
    EXPECT_EQ(result.sink.number(contours, 1, "threshold"), 10);
    EXPECT_EQ(result.sink.layers[contours].fields[4].unit, "foot");
}

TEST(Pipeline, ZIsTheThreshold) {
    MemorySource source = block();
    Options options = cells({10});
    options.write.with_z = true;
    Result result;
    run_on(source, options, result);
    EXPECT_TRUE(result.sink.layers[contours].with_z);
    EXPECT_EQ(result.sink.features[contours][0].z, 5);
    EXPECT_EQ(result.sink.features[contours][1].z, 10);
    EXPECT_EQ(result.sink.features[buildings][0].z, 10);
}

TEST(Pipeline, OneLayerAlone) {
    MemorySource source = block();
    Options options = cells({10});
    options.write.layers = Layers::contours;
    Result result;
    run_on(source, options, result);
    ASSERT_EQ(result.sink.layers.size(), 1U);
    EXPECT_EQ(result.sink.layers[0].name, "contours");
    EXPECT_EQ(result.sink.features[0].size(), 2U);
}

TEST(Pipeline, CountsWhatIsWritten) {
    MemorySource source = block();
    Options options = cells({10});
    options.write.layers = Layers::buildings;
    Result result;
    run_on(source, options, result);
    EXPECT_EQ(result.report.contours, 0);
    EXPECT_EQ(result.report.buildings, 1);
    EXPECT_EQ(result.report.vertices, 4);
}

TEST(Pipeline, ManyLevelsNeedSixteenBits) {
    std::vector<double> z(900, 0.0);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = static_cast<double>(i);
    MemorySource source(30, 30, z);
    std::vector<double> thresholds;
    for (int t = 0; t < 890; ++t)
        thresholds.push_back(t + 0.5);
    Result result;
    run_on(source, cells(thresholds), result);
    EXPECT_EQ(result.report.levels.size(), 891U);
    EXPECT_EQ(result.report.levels[890].points, 10);  // 890 to 899
}

TEST(Pipeline, CancellingLeavesNothing) {
    MemorySource source = block();
    MemorySink sink;
    Callbacks callbacks;
    callbacks.on_progress = [](double share) { return share < 0.5; };
    EXPECT_THROW(run(cells({10}), {source}, {sink}, callbacks), Cancelled);
    EXPECT_FALSE(sink.finished);
}

/// As long as it lives, no thread can be started: there is no room for its stack.
class NoRoomForThreads {
  public:
    NoRoomForThreads() {
        pthread_attr_init(&attributes_);
        pthread_getattr_default_np(&attributes_);
        pthread_attr_getstacksize(&attributes_, &before_);
        set(std::size_t{1} << 46);
    }
    NoRoomForThreads(const NoRoomForThreads&) = delete;
    NoRoomForThreads& operator=(const NoRoomForThreads&) = delete;
    ~NoRoomForThreads() {
        set(before_);
        pthread_attr_destroy(&attributes_);
    }

  private:
    void set(std::size_t bytes) {
        pthread_attr_setstacksize(&attributes_, bytes);
        pthread_setattr_default_np(&attributes_);
    }
    pthread_attr_t attributes_{};
    std::size_t before_ = 0;
};

TEST(Pipeline, ThreadsThatCannotBeStartedAreDoneWithout) {
    const NoRoomForThreads no_room;
    MemorySource source = block();
    Options options = cells({10});
    options.run.threads = 16;
    Result result;
    run_on(source, options, result);
    EXPECT_EQ(result.sink.features[buildings].size(), 1U);
    EXPECT_EQ(result.report.threads, 1);
    EXPECT_EQ(result.report.warnings,
              std::vector<std::string>{"Only 1 of 16 threads are running, because the system allows no more; "
                                       "the result is the same, but takes longer."});
}

TEST(Pipeline, AReportTellsOfItsOwnRun) {
    for (const Preset preset : every_preset) {
        Options options;
        options.preset = preset;
        options.levels.interval = 0.1;
        options.filter.noise_factor = 1000;
        MemorySource source = block();
        std::vector<std::string> heard;
        Callbacks callbacks;
        callbacks.on_warning = [&](const std::string& text) { heard.push_back(text); };
        const auto run_again = [&] {
            MemorySink sink;
            heard.clear();
            return run(options, {source}, {sink}, callbacks);
        };
        const RunReport first = run_again();
        ASSERT_FALSE(first.warnings.empty());
        EXPECT_EQ(heard, first.warnings);
        const RunReport second = run_again();
        EXPECT_EQ(heard, second.warnings);
        EXPECT_EQ(second.warnings, first.warnings);
        EXPECT_EQ(second.dropped, first.dropped);
        EXPECT_EQ(second.contours, first.contours);
        EXPECT_EQ(second.buildings, first.buildings);
        EXPECT_EQ(second.vertices, first.vertices);
        EXPECT_EQ(second.valid_points, first.valid_points);
        EXPECT_EQ(second.levels.size(), first.levels.size());
    }
}

TEST(Pipeline, ReadsOnceWhatFitsInMemory) {
    // One value along the border might be undeclared NoData, which is looked for in a reading of its own.
    std::vector<double> z(120);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = 5 + 0.01 * static_cast<double>(i);
    MemorySource source{10, 12, z};
    Result result;
    run_on(source, cells({10}), result);
    EXPECT_EQ(source.reads, 1);
}

TEST(Pipeline, SaysWhereItComesFrom) {
    MemorySource source = block();
    Result result;
    run_on(source, cells({10, 15.25}), result);
    EXPECT_EQ(result.sink.provenance.metadata.at("D2B_THRESHOLDS"), "10 15.25");
    EXPECT_EQ(result.sink.provenance.metadata.at("D2B_SOURCE"), "memory");
    EXPECT_EQ(result.sink.provenance.crs_wkt, "");
}

}  // namespace
}  // namespace d2b
