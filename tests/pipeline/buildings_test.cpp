#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "pipeline/made_town.hpp"

namespace d2b::test {
namespace {

TEST(Buildings, AreFoundAndTreesAreNot) {
    TownRun town;
    town.run();
    ASSERT_TRUE(town.sink.finished);
    EXPECT_EQ(town.count(), 3U);
    for (const Box& box : {MadeTown::flat, MadeTown::gabled, MadeTown::podium}) {
        const std::size_t i = town.at(box, buildings, 0.97);
        EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), box.area(), 0.03 * box.area());
        EXPECT_GE(town.sink.number(buildings, i, "confidence"), 0.5);
        EXPECT_EQ(town.sink.number(buildings, i, "nodata"), 0);
        // A cell may be missing in a corner; walls are straight all the same.
        EXPECT_LE(town.sink.features[buildings][i].parts[0].exterior.size(), 8U);
        EXPECT_LE(town.sink.number(buildings, i, "moved_m"), 1.5);
    }
    EXPECT_EQ(town.report.buildings, 3);
    EXPECT_TRUE(town.report.warnings.empty());
}

TEST(Buildings, StandOnTheGroundAndHaveTheirHeights) {
    TownRun town;
    town.run();
    const auto check = [&](const Box& box, double height, double median, double tolerance) {
        const std::size_t i = town.at(box);
        // A tenth of the way from the low corner of the slope to the high one.
        const double low = MadeTown::ground(box.row, box.col);
        const double ground = town.sink.number(buildings, i, "ground");
        EXPECT_GT(ground, low - 0.2);
        EXPECT_LT(ground, MadeTown::middle(box));
        EXPECT_NEAR(town.sink.number(buildings, i, "roof"), MadeTown::middle(box) + height, 0.1);
        EXPECT_NEAR(town.sink.number(buildings, i, "height"), MadeTown::middle(box) + height - ground, 0.1);
        EXPECT_NEAR(town.sink.number(buildings, i, "p50"), MadeTown::middle(box) + median - ground,
                    tolerance);
    };
    check(MadeTown::flat, MadeTown::flat_height, MadeTown::flat_height, 0.1);
    check(MadeTown::gabled, MadeTown::ridge - 1 / 3.0, (MadeTown::ridge + MadeTown::eaves) / 2,
          0.5);  // between two rows of cells
    check(MadeTown::podium, MadeTown::tower_height, MadeTown::podium_height, 0.1);
}

TEST(Buildings, HaveTheVolumeOfWhatStandsThere) {
    TownRun town;
    town.run();
    const std::size_t i = town.at(MadeTown::podium);
    const double above = MadeTown::middle(MadeTown::podium) - town.sink.number(buildings, i, "ground");
    const double volume = MadeTown::podium.area() * (MadeTown::podium_height + above) +
                          MadeTown::tower.area() * (MadeTown::tower_height - MadeTown::podium_height);
    EXPECT_NEAR(town.sink.number(buildings, i, "volume_m3"), volume, 0.03 * volume);
}

/// Mean and sample deviation of a podium's points with a tower on it, without noise.
struct PodiumMoments {
    double share = MadeTown::tower.area() / MadeTown::podium.area();
    double step = MadeTown::tower_height - MadeTown::podium_height;
    double base = MadeTown::middle(MadeTown::podium) + MadeTown::podium_height;
    double mean = base + share * step;
    double deviation = step * std::sqrt(share * (1 - share));
};

TEST(Buildings, TiersAreSlicesOfTheirOwnElevations) {
    TownRun town;
    town.options.levels.source = LevelSource::building;
    town.options.levels.detail = 0;
    town.run();
    const PodiumMoments m;
    std::vector<double> expected;
    for (int i = 1; i <= 4; ++i)
        if (const double t = m.mean - m.deviation + 2 * m.deviation * i / 5; t > m.base)
            expected.push_back(t);
    const auto id = town.sink.whole(buildings, town.at(MadeTown::podium), "id");
    std::vector<std::size_t> tiers;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        if (town.sink.whole(contours, i, "bldg_id") == id && town.sink.whole(contours, i, "level") > 1)
            tiers.push_back(i);
    ASSERT_EQ(tiers.size(), expected.size());
    for (std::size_t i = 0; i < tiers.size(); ++i) {
        EXPECT_NEAR(town.sink.number(contours, tiers[i], "threshold"), expected[i], 0.3);
        EXPECT_GE(overlap(town.sink.features[contours][tiers[i]], MadeTown::tower, town.dem.info().transform),
                  0.97);
        const std::size_t below = i == 0 ? town.at(MadeTown::podium, contours) : tiers[i - 1];
        EXPECT_EQ(town.sink.whole(contours, tiers[i], "parent_id"), town.sink.whole(contours, below, "id"));
        EXPECT_LE(town.sink.number(contours, tiers[i], "area_m2"),
                  town.sink.number(contours, below, "area_m2"));
    }
    EXPECT_NEAR(town.sink.number(contours, tiers.back(), "top"),
                MadeTown::middle(MadeTown::podium) + MadeTown::tower_height, 0.1);
}

TEST(Buildings, ContoursHaveNoRoot) {
    TownRun town;
    town.run();
    std::size_t footprints = 0;
    for (std::size_t i = 0; i < town.count(contours); ++i) {
        const auto level = town.sink.whole(contours, i, "level");
        EXPECT_GE(level, 1);
        if (level != 1)
            continue;
        ++footprints;
        EXPECT_EQ(town.sink.value(contours, i, "parent_id"), FieldValue{});
        const auto building = static_cast<std::size_t>(town.sink.whole(contours, i, "bldg_id")) - 1;
        EXPECT_EQ(town.sink.value(contours, i, "threshold"), town.sink.value(buildings, building, "ground"));
        EXPECT_EQ(town.sink.value(contours, i, "base"), town.sink.value(buildings, building, "ground"));
    }
    EXPECT_EQ(footprints, 3U);
    const auto& levels = town.report.levels;
    EXPECT_EQ(levels[0].contours, 0);
    EXPECT_TRUE(std::isnan(levels[1].threshold));  // each building has its own
    EXPECT_EQ(levels[1].contours, 3);
}

TEST(Buildings, FlatRoofsHaveNoTiers) {
    TownRun town;
    town.run();
    const std::size_t i = town.at(MadeTown::flat);
    EXPECT_EQ(town.sink.whole(buildings, i, "n_parts"), 1);
    EXPECT_EQ(town.sink.whole(buildings, i, "has_parts"), 0);
    EXPECT_LT(town.report.stack_rmse_m, 1.5);
    EXPECT_GT(town.report.stack_rmse_m, 0);
}

/// Whether the middle of a cell lies in a feature, or on the left of its borders.
bool holds(const Feature& feature, const Position& middle) {
    bool inside = false;
    const auto pass = [&](const WorldRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Position& a = ring[i];
            const Position& b = ring[(i + 1) % ring.size()];
            if ((a.y > middle.y) != (b.y > middle.y) &&
                middle.x < a.x + (b.x - a.x) * (middle.y - a.y) / (b.y - a.y))
                inside = !inside;
        }
    };
    for (const WorldPolygon& part : feature.parts) {
        pass(part.exterior);
        std::ranges::for_each(part.interiors, pass);
    }
    return inside;
}

/// The stack against the town, cell by cell, from the written features alone.
double rmse_as_written(const TownRun& town, const std::vector<double>& z) {
    double squares = 0;
    double cells = 0;
    for (int row = 0; row < MadeTown::rows; ++row)
        for (int col = 0; col < MadeTown::cols; ++col) {
            const AffineTransform& t = town.dem.info().transform;
            const Position middle{t[0] + (col + 0.5) * t[1], t[3] + (row + 0.5) * t[5]};
            const auto in = [&](const Feature& feature) { return holds(feature, middle); };
            double tier = std::numeric_limits<double>::quiet_NaN();
            if (std::ranges::any_of(town.sink.features[buildings], in))
                for (std::size_t i = 0; i < town.count(contours); ++i)  // from low to high
                    if (town.sink.value(contours, i, "tier_z") != FieldValue{} &&
                        in(town.sink.features[contours][i]))
                        tier = town.sink.number(contours, i, "tier_z");
            if (std::isnan(tier))
                continue;
            squares += std::pow(tier - z[MadeTown::index(row, col)], 2);
            ++cells;
        }
    return std::sqrt(squares / cells);
}

TEST(Buildings, TheStackIsMeasuredAsItIsWritten) {
    const std::vector<double> z = MadeTown::surface();
    TownRun town(z);
    town.run();
    EXPECT_NEAR(town.report.stack_rmse_m, rmse_as_written(town, z), 1e-6);
    for (const auto& change :
         std::vector<std::function<void(Options&)>>{[](Options& o) { o.outline.walls = Walls::off; },
                                                    [](Options& o) {
                                                        o.outline.walls = Walls::off;
                                                        o.outline.simplify = 2;
                                                    },
                                                    [](Options& o) { o.outline.disjoint = true; }}) {
        TownRun other(z);
        change(other.options);
        other.run();
        EXPECT_NEAR(other.report.stack_rmse_m, rmse_as_written(other, z), 1e-6);
    }
    TownRun alone(z);
    alone.options.write.layers = Layers::contours;
    alone.options.run.threads = 3;
    alone.run();
    EXPECT_NEAR(alone.report.stack_rmse_m, town.report.stack_rmse_m, 0.1 * town.report.stack_rmse_m);
}

TEST(Buildings, GlobalLevelsAreOneSetForAll) {
    TownRun town;
    town.options.levels.source = LevelSource::global;
    town.options.levels.lod = 1;  // the mean of all elevations
    town.run();
    const double mean = town.report.mean;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        if (town.sink.whole(contours, i, "level") > 1) {
            EXPECT_EQ(town.sink.number(contours, i, "threshold"), mean);
        }
    TownRun fixed;
    fixed.options.levels.fixed = {115.5};
    fixed.run();
    ASSERT_EQ(fixed.count(contours), 4U);  // three footprints and the tower
    EXPECT_EQ(fixed.sink.number(contours, 3, "threshold"), 115.5);
    EXPECT_GE(overlap(fixed.sink.features[contours][3], MadeTown::tower, fixed.dem.info().transform), 0.97);
}

TEST(Buildings, DisjointBandsAddUpToTheFootprints) {
    TownRun town;
    town.options.outline.disjoint = true;
    town.run();
    TownRun stacked;
    stacked.run();
    double bands = 0;
    double whole = 0;
    for (std::size_t i = 0; i < town.count(contours); ++i)
        bands += town.sink.number(contours, i, "area_m2");
    for (std::size_t i = 0; i < stacked.count(contours); ++i)
        if (stacked.sink.whole(contours, i, "level") == 1)
            whole += stacked.sink.number(contours, i, "area_m2");
    EXPECT_NEAR(bands, whole, 1e-6 * whole);
    EXPECT_EQ(town.report.counted(Reason::polygon_repaired), 0);
}

TEST(Buildings, SayNothingOfOptionsWithoutEffect) {
    TownRun town;
    town.options.levels.fixed = {4};
    town.options.ground.mode = GroundMode::none;
    town.run();
    const auto& metadata = town.sink.provenance.metadata;
    EXPECT_EQ(metadata.at("D2B_OPTIONS"), "-ground none -fl 4");
    for (const char* name : {"D2B_LOD", "D2B_LEVELS", "D2B_MAX_BUILDING_WIDTH_M", "D2B_MASK"})
        EXPECT_FALSE(metadata.contains(name)) << name;
}

TEST(BuildingGrids, DegreesWithCellsThatAreNotSquare) {
    TownRun town;
    // A degree of longitude at 60 degrees north is half of one of latitude, so cells are 1.1 m by 0.9 m.
    town.dem.edit().transform = {20, 2e-5, 0, 60, 0, -8e-6};
    town.dem.edit().crs_wkt = Crs("EPSG:4326").wkt();
    town.run();
    EXPECT_EQ(town.count(), 3U);
    const double degree = std::numbers::pi / 180;
    const double latitude = (60 - 70 * 8e-6) * degree;
    const double w = 1 - 0.00669437999014 * std::pow(std::sin(latitude), 2);
    const double meridian = 6378137 * (1 - 0.00669437999014) / std::pow(w, 1.5);
    const double parallel = 6378137 / std::sqrt(w) * std::cos(latitude);
    const double cell = 2e-5 * degree * parallel * 8e-6 * degree * meridian;
    for (const Box& box : {MadeTown::flat, MadeTown::gabled, MadeTown::podium}) {
        const std::size_t i = town.at(box, buildings, 0.95);
        EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), box.area() * cell, 0.04 * box.area() * cell);
    }
    EXPECT_EQ(town.report.units.areas, "geodesic");
}

TEST(BuildingGrids, Feet) {
    std::vector<double> z = MadeTown::surface();
    for (double& value : z)
        value /= 0.3048;
    TownRun town(std::move(z));
    town.dem.edit().band_unit = "ft";
    town.run();
    TownRun metres;
    metres.run();
    ASSERT_EQ(town.count(), metres.count());
    for (std::size_t i = 0; i < town.count(); ++i) {
        EXPECT_NEAR(town.sink.number(buildings, i, "height"), metres.sink.number(buildings, i, "height"),
                    1e-3);
        EXPECT_NEAR(town.sink.number(buildings, i, "ground") * 0.3048,
                    metres.sink.number(buildings, i, "ground"), 1e-3);
        EXPECT_NEAR(town.sink.number(buildings, i, "volume_m3"),
                    metres.sink.number(buildings, i, "volume_m3"), 1);
    }
    EXPECT_EQ(town.count(contours), metres.count(contours));  // tiers half a metre apart, not half a foot
    EXPECT_NEAR(town.report.stack_rmse_m, metres.report.stack_rmse_m, 1e-3);
    const std::size_t lawn = MadeTown::index(60, 10);
    EXPECT_NEAR(static_cast<double>(town.ground.values[lawn]), MadeTown::ground(60, 10), 0.1);  // metres
}

TEST(BuildingGrids, RowsThatRunNorth) {
    TownRun town;
    town.dem.edit().transform = {600000, 1, 0, 5800000, 0, 1};
    town.dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    town.run();
    EXPECT_EQ(town.count(), 3U);
    town.at(MadeTown::podium, buildings, 0.95);
}

/// A window's first row and column are not the raster's: labels and rasters follow it.
TEST(BuildingGrids, AWindowOfTheRaster) {
    TownRun town;
    const Window window{60, 15, 70, 80};  // around the podium
    town.dem.edit().window = window;
    town.run();
    EXPECT_EQ(town.count(), 1U);
    EXPECT_EQ(town.height.cells, 70 * 80);
    const std::size_t i = town.at(MadeTown::podium, buildings, 0.95);
    EXPECT_EQ(town.sink.whole(buildings, i, "at_edge"), 0);
    const std::size_t tower = 90 * 95 + 45;  // the raster in memory ends with the window's last column
    EXPECT_NEAR(static_cast<double>(town.height.values[tower]), MadeTown::tower_height, 0.4);
}

TEST(BuildingGrids, TracedThroughPointsTheyLoseHalfACell) {
    TownRun town;
    town.options.trace.mode = TraceMode::points;
    town.options.outline.walls = Walls::off;
    town.run();
    const std::size_t i = town.at(MadeTown::flat, buildings, 0.7);
    const double area = (MadeTown::flat.rows - 1) * (MadeTown::flat.cols - 1);
    EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), area, 0.03 * area);
    EXPECT_EQ(town.sink.value(buildings, i, "nodata"), FieldValue{});  // points are no cells
}

/// The confidences of all candidates where nothing is refused.
std::vector<double> confidences() {
    TownRun town;
    town.options.detect.min_confidence = 0;
    town.run();
    std::vector<double> result;
    for (std::size_t i = 0; i < town.count(); ++i)
        result.push_back(std::get<BuildingRecord>(town.sink.features[buildings][i].record).confidence);
    std::sort(result.begin(), result.end());
    return result;
}

TEST(Doubtful, GoToALayerOfTheirOwn) {
    const std::vector<double> all = confidences();
    ASSERT_GE(all.size(), 3U);
    TownRun town;
    town.options.write.doubtful = true;
    town.options.detect.min_confidence = all.back();  // an object as sure as this is no doubt
    town.run();
    ASSERT_EQ(town.sink.layers.size(), 3U);
    EXPECT_EQ(town.sink.layers[doubtful].name, "doubtful");
    EXPECT_EQ(town.sink.layers[doubtful].fields.size(), town.sink.layers[buildings].fields.size());
    EXPECT_GE(town.count(), 1U);
    EXPECT_EQ(town.count() + town.count(doubtful), all.size());
    for (std::size_t i = 0; i < town.count(); ++i)
        EXPECT_EQ(town.sink.number(buildings, i, "confidence"), floor_to_hundredths(all.back()));
    for (std::size_t i = 0; i < town.count(doubtful); ++i) {
        EXPECT_LT(town.sink.number(doubtful, i, "confidence"), all.back());
        EXPECT_GT(town.sink.number(doubtful, i, "height"), 2);
        EXPECT_GE(town.sink.number(doubtful, i, "area_m2"), 25);
    }
    EXPECT_EQ(town.report.doubtful, static_cast<std::int64_t>(town.count(doubtful)));
    EXPECT_EQ(town.report.counted(Reason::building_doubtful),
              static_cast<std::int64_t>(town.count(doubtful)));
}

TEST(Doubtful, HaveNoContours) {
    TownRun town;
    town.options.write.doubtful = true;
    town.options.detect.min_confidence = confidences().back();
    town.run();
    std::set<std::int64_t> ids;
    for (std::size_t i = 0; i < town.count(); ++i)
        ids.insert(town.sink.whole(buildings, i, "id"));
    for (std::size_t i = 0; i < town.count(contours); ++i)
        EXPECT_EQ(ids.count(town.sink.whole(contours, i, "bldg_id")), 1U);
    EXPECT_EQ(town.report.contours, static_cast<std::int64_t>(town.count(contours)));
}

TEST(Doubtful, DoNotChangeWhatIsReportedOfBuildings) {
    TownRun with;
    TownRun without;
    for (TownRun* town : {&with, &without}) {
        town->options.detect.min_confidence = confidences().back();
        town->options.write.doubtful = town == &with;
        town->run();
    }
    EXPECT_GT(with.report.doubtful, 0);
    EXPECT_EQ(with.report.stack_rmse_m, without.report.stack_rmse_m);
    EXPECT_EQ(with.report.buildings, without.report.buildings);
    const auto& levels = without.report.levels;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        EXPECT_EQ(with.report.levels[i].contours, levels[i].contours);
        EXPECT_EQ(with.report.levels[i].points, levels[i].points);
    }
}

TEST(Doubtful, AreNoBuildingsInTheCanopy) {
    TownRun town;
    town.options.detect.min_confidence = 1;
    town.options.write.doubtful = true;
    town.run();
    EXPECT_EQ(town.count(), 0U);
    const std::size_t roof = MadeTown::index(26, 26);
    EXPECT_EQ(town.canopy.values[roof], town.height.values[roof]);
}

std::string only_warning(const MemorySink& sink, const RunReport& report) {
    EXPECT_TRUE(sink.finished);
    EXPECT_EQ(report.buildings, 0);
    EXPECT_EQ(report.contours, 0);
    EXPECT_EQ(report.warnings.size(), 1U);
    return report.warnings.empty() ? "" : report.warnings[0];
}

TEST(Nothing, ToFindIsAWarning) {
    const auto warning = [](std::int32_t rows, std::int32_t cols, const std::vector<double>& z) {
        MemorySource dem(rows, cols, z);
        MemorySink sink;
        MemoryRaster ground;
        const RunReport report = run({}, {dem}, {sink, &ground});
        EXPECT_TRUE(ground.finished);
        EXPECT_EQ(ground.values.size(), z.size());
        return only_warning(sink, report);
    };
    const double nan = std::nan("");
    EXPECT_EQ(warning(9, 9, std::vector<double>(81, nan)),
              "'memory' has no valid point; the layers are empty.");
    EXPECT_EQ(warning(1, 1, {nan}), "'memory' has no valid point; the layers are empty.");
    EXPECT_EQ(warning(1, 1, {7}),
              "All valid points of 'memory' have the same elevation; no building was found.");
    EXPECT_EQ(warning(30, 30, std::vector<double>(900, 7.0)),
              "All valid points of 'memory' have the same elevation; no building was found.");
    const auto covers = [](const std::string& extent) {
        return "No building was found: 'memory' covers " + extent +
               ", which is less than a building; give the right CRS with -a_srs, or a larger part of the "
               "raster.";
    };
    EXPECT_EQ(warning(1, 5, {0, 9, 9, 9, 0}), covers("5 m x 1 m"));
    EXPECT_EQ(warning(5, 1, {0, 9, nan, 9, 0}), covers("1 m x 5 m"));
    EXPECT_EQ(warning(2, 2, {0, 1, 0, 1}), covers("2 m x 2 m"));
}

}  // namespace
}  // namespace d2b::test
