#include "pipeline/pipeline.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "geometry/geos.hpp"
#include "pipeline/elevation_reader.hpp"
#include "support/memory_io.hpp"
#include "support/random_grid.hpp"

namespace d2b {
namespace {

using test::MemorySink;
using test::MemorySource;

constexpr std::size_t buildings = 0;
constexpr std::size_t contours = 1;

/// 10 x 12 cells: a block of 4 x 6 cells of 20 on ground of 5.
MemorySource block() {
    std::vector<double> z(120, 5);
    for (int row = 3; row < 7; ++row)
        for (int col = 2; col < 8; ++col)
            z[static_cast<std::size_t>(row * 12 + col)] = 20;
    return {10, 12, z};
}

Options cells(std::vector<double> thresholds) {
    Options options;
    options.trace.mode = TraceMode::cells;
    options.levels.fixed = std::move(thresholds);
    options.filter.noise_factor = 0;
    return options;
}

struct Result {
    MemorySink sink;
    Context context;
};

void run_on(MemorySource& source, const Options& options, Result& result) {
    run(options, source, result.sink, result.context);
}

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
    EXPECT_EQ(result.context.report.vertices, 8);
    EXPECT_EQ(result.context.report.levels.size(), 2U);
    EXPECT_EQ(result.context.report.levels[1].points, 24);
    EXPECT_TRUE(result.context.report.warnings.empty());
}

TEST(Pipeline, GeodesicAreasOnAProjectedGrid) {
    // On the central meridian of UTM lengths are 0.9996 of the true ones.
    MemorySource source = block();
    source.edit().transform = {500000, 1, 0, 5000000, 0, -1};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Result result;
    run_on(source, cells({10}), result);
    EXPECT_NEAR(result.sink.number(buildings, 0, "area_m2"), 24 / (0.9996 * 0.9996), 24e-7);
    EXPECT_NEAR(result.sink.number(buildings, 0, "perim_m"), 20 / 0.9996, 20e-7);
    EXPECT_EQ(result.context.report.units.areas, "geodesic");
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
    EXPECT_DOUBLE_EQ(result.sink.number(buildings, 0, "height"), 15 * 0.3048);
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

double area_of(const std::vector<WorldPolygon>& parts) {
    Geodesy planar{Crs()};
    double area = 0;
    for (const WorldPolygon& part : parts)
        area += planar.polygon(part).area_m2;
    return area;
}

TEST(Pipeline, DisjointBandsAddUpToTheWhole) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const test::RandomGridCase c = test::random_grid(2 * seed, 20, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        Options options = cells(c.thresholds);
        options.outline.disjoint = true;
        options.outline.simplify = seed % 3 == 0 ? 1.0 : 0.0;
        Result stacked;
        Result disjoint;
        run_on(source, options, disjoint);
        options.outline.disjoint = false;
        run_on(source, options, stacked);
        double roots = 0;
        for (std::size_t i = 0; i < stacked.sink.features[contours].size(); ++i)
            if (std::get<std::int64_t>(stacked.sink.value(contours, i, "level")) == 0)
                roots += area_of(stacked.sink.features[contours][i].parts);
        double bands = 0;
        for (const Feature& feature : disjoint.sink.features[contours])
            bands += area_of(feature.parts);
        EXPECT_NEAR(bands, roots, 1e-9) << seed;
        EXPECT_EQ(disjoint.context.report.counted(Reason::polygon_repaired), 0);
    }
}

TEST(Pipeline, ReprojectedOutlinesStayNested) {
    Geos geos;
    std::size_t checked_pairs = 0;
    for (unsigned seed = 10; seed < 30; ++seed) {
        const test::RandomGridCase c = test::random_grid(2 * seed, 24, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        source.edit().transform = {600000, 10, 0, 5800000, 0, -10};
        source.edit().crs_wkt = Crs("EPSG:25832").wkt();
        Options options = cells(c.thresholds);
        options.outline.target_crs = "EPSG:3857";
        Result result;
        run_on(source, options, result);
        const auto& features = result.sink.features[contours];
        // A cell is 10 m x 10 m, at 52 N about 264 m2 of EPSG:3857.
        for (std::size_t i = 0; i < features.size(); ++i) {
            const FieldValue parent = result.sink.value(contours, i, "parent_id");
            if (!std::holds_alternative<std::int64_t>(parent))
                continue;
            const auto& outer = features[static_cast<std::size_t>(std::get<std::int64_t>(parent) - 1)];
            EXPECT_LT(geos.area_outside(features[i].parts[0], outer.parts[0]), 264e-6);
            ++checked_pairs;
        }
        EXPECT_EQ(result.context.report.output_crs, "WGS 84 / Pseudo-Mercator");
        EXPECT_EQ(result.context.report.crs, "ETRS89 / UTM zone 32N");
    }
    EXPECT_GT(checked_pairs, 200U);
}

/// Straight lines bend when they are reprojected: long ones by more than a cell.
TEST(Pipeline, LongOutlinesStayNestedWhenTheyAreReprojected) {
    constexpr int cols = 20000;
    constexpr int rows = 40;
    std::vector<double> z(static_cast<std::size_t>(rows) * cols, 0.0);
    for (int row = 1; row < rows - 1; ++row)
        for (int col = 1; col < cols - 1; ++col)
            z[static_cast<std::size_t>(row) * cols + static_cast<std::size_t>(col)] =
                row > 1 && row < rows - 2 && col % 1000 > 10 ? 20 : 10;
    MemorySource source(rows, cols, z);
    source.edit().transform = {600000, 1, 0, 5800000, 0, -1};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Options options = cells({5, 15});
    options.outline.target_crs = "EPSG:3857";
    Result result;
    run_on(source, options, result);
    const auto& features = result.sink.features[contours];
    ASSERT_EQ(features.size(), 22U);
    Geos geos;
    for (std::size_t i = 1; i < features.size(); ++i) {
        const auto parent = std::get<std::int64_t>(result.sink.value(contours, i, "parent_id")) - 1;
        EXPECT_LT(
            geos.area_outside(features[i].parts[0], features[static_cast<std::size_t>(parent)].parts[0]),
            2.6e-6);
    }
    options.outline.disjoint = true;
    Result disjoint;
    run_on(source, options, disjoint);
    EXPECT_EQ(disjoint.context.report.counted(Reason::polygon_repaired), 0);
}

TEST(Pipeline, DisjointContoursReferToWhatIsWritten) {
    MemorySource source = block();  // level 1 and 2 cover the same cells: level 1 has no band of its own
    Options options = cells({10, 15});
    options.outline.disjoint = true;
    Result result;
    run_on(source, options, result);
    ASSERT_EQ(result.sink.features[contours].size(), 2U);
    EXPECT_EQ(result.sink.value(contours, 1, "level"), FieldValue{std::int64_t{2}});
    EXPECT_EQ(result.sink.value(contours, 1, "id"), FieldValue{std::int64_t{3}});
    EXPECT_EQ(result.sink.value(contours, 1, "parent_id"), FieldValue{std::int64_t{1}});
    EXPECT_EQ(result.context.report.contours, 2);
    EXPECT_EQ(result.context.report.buildings, 1);
}

TEST(Pipeline, CountsWhatIsWritten) {
    MemorySource source = block();
    Options options = cells({10});
    options.write.layers = Layers::buildings;
    Result result;
    run_on(source, options, result);
    EXPECT_EQ(result.context.report.contours, 0);
    EXPECT_EQ(result.context.report.buildings, 1);
    EXPECT_EQ(result.context.report.vertices, 4);
}

TEST(Pipeline, ALargeToleranceIsWarnedOf) {
    MemorySource source = block();
    source.edit().transform = {13, 1e-5, 0, 52, 0, -1e-5};
    source.edit().crs_wkt = Crs("EPSG:4326").wkt();
    Options options = cells({10});
    options.outline.simplify = 1;
    Result result;
    run_on(source, options, result);
    ASSERT_EQ(result.context.report.warnings.size(), 1U);
    EXPECT_EQ(
        result.context.report.warnings[0],
        "-simplify 1 is 100000 cells wide, which leaves little of a building; it is in units of the input's "
        "CRS.");
}

TEST(Pipeline, ReadsAgainAfterAFailure) {
    MemorySource source = block();
    Context context;
    ElevationReader reader(source, context);
    EXPECT_THROW(reader.for_each([](const ElevationBand&) { throw Cancelled(); }), Cancelled);
    std::int32_t rows = 0;
    for (int pass = 0; pass < 2; ++pass)
        reader.for_each([&](const ElevationBand& band) { rows += band.shape.rows; });
    EXPECT_EQ(rows, 2 * 10);
    EXPECT_EQ(source.reads, 2);
}

TEST(Pipeline, BandsReachTheLastRowOfTheLargestRaster) {
    class TallSource : public DemSource {
      public:
        TallSource() {
            info_.rows = 2147483647;
            info_.cols = 1;
            info_.window = {2147483500, 0, 147, 1};
        }
        [[nodiscard]] const DemInfo& info() const override { return info_; }
        void read(std::int32_t first, std::int32_t rows, std::span<double>) override {
            read_to = first + rows;
        }
        std::int32_t read_to = 0;

      private:
        DemInfo info_;
    };
    TallSource source;
    Context context;
    ElevationReader(source, context).for_each([](const ElevationBand&) {});
    EXPECT_EQ(source.read_to, 2147483647);
}

TEST(Pipeline, ReprojectingNeedsACrs) {
    MemorySource source = block();
    Options options = cells({10});
    options.outline.target_crs = "EPSG:3857";
    Result result;
    try {
        run_on(source, options, result);
        FAIL();
    } catch (const OptionError& error) {
        EXPECT_STREQ(error.what(),
                     "-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.");
    }
}

TEST(Pipeline, CoarseCellsAreWarnedOf) {
    MemorySource source = block();
    source.edit().transform = {600000, 5, 0, 5800000, 0, -5};
    source.edit().crs_wkt = Crs("EPSG:25832").wkt();
    Result result;
    run_on(source, cells({10}), result);
    ASSERT_EQ(result.context.report.warnings.size(), 1U);
    EXPECT_EQ(result.context.report.warnings[0],
              "The cells are 5.0 m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m "
              "may do.");
}

std::string only_warning(MemorySource& source, const Options& options) {
    Result result;
    run_on(source, options, result);
    EXPECT_TRUE(result.sink.finished);
    EXPECT_EQ(result.sink.features[buildings].size(), 0U);
    EXPECT_EQ(result.context.report.warnings.size(), 1U);
    return result.context.report.warnings.empty() ? "" : result.context.report.warnings[0];
}

TEST(Pipeline, NothingToFindIsAWarning) {
    MemorySource nothing(2, 2, std::vector<double>(4, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(only_warning(nothing, {}), "'memory' has no valid point; the layers are empty.");
    MemorySource flat(3, 3, std::vector<double>(9, 7.0));
    EXPECT_EQ(only_warning(flat, {}),
              "All valid points of 'memory' have the same elevation; no building was found.");
    MemorySource low = block();
    EXPECT_EQ(only_warning(low, cells({100})),
              "No threshold lies between the lowest and the highest elevation; no building was found.");
    MemorySource line(1, 5, {0, 9, 9, 9, 0});
    EXPECT_EQ(only_warning(line, {}),
              "No building was found; a smaller -nf or -min_area, or more levels, may show some.");
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
    EXPECT_EQ(result.context.report.levels.size(), 891U);
    EXPECT_EQ(result.context.report.levels[890].points, 10);  // 890 to 899
}

TEST(Pipeline, CancellingLeavesNothing) {
    MemorySource source = block();
    MemorySink sink;
    Context context;
    context.on_progress = [](double share) { return share < 0.5; };
    EXPECT_THROW(run(cells({10}), source, sink, context), Cancelled);
    EXPECT_FALSE(sink.finished);
}

TEST(Pipeline, ReadsOnceWhatFitsInMemory) {
    MemorySource source = block();
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
