#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "geometry/geos.hpp"
#include "pipeline/pipeline_case.hpp"
#include "support/random_grid.hpp"

namespace d2b {
namespace {

using test::area_of;
using test::block;
using test::cells;
using test::contours;
using test::MemorySource;
using test::place_in_utm;
using test::Result;
using test::run_on;

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
        EXPECT_EQ(disjoint.report.counted(Reason::polygon_repaired), 0);
    }
}

TEST(Pipeline, ReprojectedOutlinesStayNested) {
    Geos geos;
    std::size_t checked_pairs = 0;
    for (unsigned seed = 10; seed < 30; ++seed) {
        const test::RandomGridCase c = test::random_grid(2 * seed, 24, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        place_in_utm(source, 10);
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
        EXPECT_EQ(result.report.output_crs, "WGS 84 / Pseudo-Mercator");
        EXPECT_EQ(result.report.crs, "ETRS89 / UTM zone 32N");
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
    EXPECT_EQ(disjoint.report.counted(Reason::polygon_repaired), 0);
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
    EXPECT_EQ(result.report.contours, 2);
    EXPECT_EQ(result.report.buildings, 1);
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

}  // namespace
}  // namespace d2b
