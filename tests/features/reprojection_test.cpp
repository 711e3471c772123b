#include "features/reprojection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "pipeline/pipeline_case.hpp"
#include "support/random_grid.hpp"

namespace d2b::features {
namespace {

using test::block;
using test::cells;
using test::contours;
using test::MemorySource;
using test::place_in_utm;
using test::Result;
using test::run_on;

WorldRing box_ring(double x, double y, double size) {
    return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

RingProjection fate_of(WorldRing ring, const char* from, const char* to, double longest) {
    return RingTransform(Crs(from), Crs(to), ring, longest).apply(ring);
}

TEST(RingTransform, knowsWhatIsTorn) {
    // Across 180 degrees, and as far away on either side.
    EXPECT_EQ(fate_of(box_ring(179.9999, -17, 2e-4), "EPSG:4326", "EPSG:3857", 1), RingProjection::split);
    EXPECT_EQ(fate_of(box_ring(179.9995, -17, 2e-4), "EPSG:4326", "EPSG:3857", 1), RingProjection::whole);
    EXPECT_EQ(fate_of(box_ring(819780, 8140198, 20), "EPSG:32760", "EPSG:4326", 64), RingProjection::split);
    EXPECT_EQ(fate_of(box_ring(819740, 8140198, 20), "EPSG:32760", "EPSG:4326", 64), RingProjection::whole);
    EXPECT_EQ(fate_of(box_ring(179.9999, -17, 2e-4), "EPSG:4326", "EPSG:32660", 1), RingProjection::whole);
    // Over a pole, and beside it.
    EXPECT_EQ(fate_of(box_ring(-10, -10, 20), "EPSG:3413", "EPSG:4326", 64), RingProjection::split);
    EXPECT_EQ(fate_of(box_ring(-10, -10, 20), "EPSG:3413", "EPSG:3857", 64), RingProjection::split);
    EXPECT_EQ(fate_of(box_ring(2, -40, 20), "EPSG:3413", "EPSG:4326", 64), RingProjection::whole);
    // A ring without an image.
    EXPECT_EQ(fate_of(box_ring(10, 80, 20), "EPSG:4326", "EPSG:25832", 64), RingProjection::no_image);
}

/// Follows a straight edge beside a pole, because it is a curve in longitude and latitude.
TEST(RingTransform, followsEdgesThatBend) {
    WorldRing ring = box_ring(1, -8, 16);  // its left side passes the pole at a distance of 1 m
    RingTransform transform(Crs("EPSG:3413"), Crs("EPSG:4326"), ring, 64);
    ASSERT_EQ(transform.apply(ring), RingProjection::whole);
    EXPECT_GT(ring.size(), 8U);
    const auto nearest = std::ranges::max_element(ring, {}, &Position::y);
    EXPECT_NEAR((90 - nearest->y) * 111694 * 0.97, 1, 0.05);  // the map is to a scale of 0.97 there
}

TEST(RingTransform, cutsSharedEdgesAlike) {
    // Two triangles with an edge that passes the pole at a distance of 1 m, once this way and once the other.
    const auto edge_of = [](WorldRing ring) {
        RingTransform transform(Crs("EPSG:3413"), Crs("EPSG:4326"), ring, 3);
        WorldRing ends{ring[0], ring[1]};
        EXPECT_TRUE(transform.apply_to_positions(ends));
        EXPECT_EQ(transform.apply(ring), RingProjection::whole);
        return WorldRing(ring.begin(), std::ranges::find(ring, ends[1]) + 1);
    };
    const WorldRing there = edge_of({{1, -8}, {1, 8}, {20, 0}});
    WorldRing back = edge_of({{1, 8}, {1, -8}, {20, 3}});
    std::ranges::reverse(back);
    EXPECT_GT(there.size(), 7U);
    EXPECT_EQ(there, back);
}

/// Cells that are a million times as long as wide: no edge gets more pieces than it passes cells.
TEST(RingTransform, cutsNoMoreThanIsAskedFor) {
    WorldRing ring = box_ring(500000, 5700000, 1000);
    RingTransform transform(Crs("EPSG:25832"), Crs("EPSG:4326"), ring, 1e-9);
    EXPECT_EQ(transform.apply(ring), RingProjection::whole);
    EXPECT_LE(ring.size(), std::size_t{4} << 20);
}

void expect_torn(const AffineTransform& transform, const std::string& crs, const std::string& target) {
    SCOPED_TRACE(crs + " to " + target);
    MemorySource source = block();
    source.edit().transform = transform;
    source.edit().crs_wkt = Crs(crs).wkt();
    Options options = cells({10});
    options.outline.target_crs = target;
    Result result;
    try {
        run_on(source, options, result);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(),
                  "'memory' cannot be converted to '" + Crs(target).name() +
                      "', which splits the area or distorts it too much (for example across 180 degrees, "
                      "over a pole or far from the area of use); choose another -t_srs, such as the UTM zone "
                      "of the area, or use a part of the raster (-srcwin, -projwin or -te).");
    }
    EXPECT_EQ(source.reads, 0);  // before the work
    EXPECT_TRUE(result.sink.layers.empty());
}

TEST(TargetFrame, whatIsTornIsRefusedBeforeTheWork) {
    expect_torn({180 - 6e-5, 1e-5, 0, -17, 0, -1e-5}, "EPSG:4326", "EPSG:3857");
    expect_torn({819783, 1, 0, 8140198, 0, -1}, "EPSG:32760", "EPSG:4326");
    expect_torn({-6, 1, 0, 5, 0, -1}, "EPSG:3413", "EPSG:4326");
    expect_torn({-6, 1, 0, 5, 0, -1}, "EPSG:3413", "EPSG:3857");
    // The south pole is where the azimuthal projection of the north ends: turned inside out.
    expect_torn({-6, 1, 0, 5, 0, -1}, "EPSG:3031", "EPSG:3571");
    expect_torn({-60000, 10000, 0, 50000, 0, -10000}, "EPSG:3031", "EPSG:3571");
    // 100 m from the pole Mercator's projection enlarges 60,000 times.
    expect_torn({100, 1, 0, 5, 0, -1}, "EPSG:3413", "EPSG:3857");
}

TEST(TargetFrame, whatIsWholeIsNot) {
    MemorySource source = block();
    for (const auto& [transform, crs, target] :
         {std::tuple{AffineTransform{180 - 6e-5, 1e-5, 0, -17, 0, -1e-5}, "EPSG:4326", "EPSG:32660"},
          {AffineTransform{100, 1, 0, 5, 0, -1}, "EPSG:3413", "EPSG:4326"},
          {AffineTransform{-180, 30, 0, 90, 0, -18}, "EPSG:4326", "EPSG:3857"},
          {AffineTransform{600000, 10, 0, 5800000, 0, -10}, "EPSG:25832", "EPSG:28992"}}) {
        source.edit().transform = transform;
        Options options = cells({10});
        options.outline.target_crs = target;
        EXPECT_NO_THROW(static_cast<void>(
            require_projectable(source.info(), make_run_plan(options, Layers::both), Crs(crs), Crs(target))))
            << crs << " to " << target;
    }
}

/// The output counts in steps of 2 m, so that outlines of cells of 1 m collapse and are repaired: their
/// remains say nothing of their areas.
TEST(Pipeline, RepairedOutlinesHaveTheAreasOfTheGround) {
    std::int64_t repaired = 0;
    for (unsigned seed = 0; seed < 6; ++seed) {
        const test::RandomGridCase c = test::random_grid(2 * seed, 24, false);
        MemorySource source(c.grid.rows, c.grid.cols, c.grid.z);
        place_in_utm(source, 1);
        Options options = cells(c.thresholds);
        const Result here(source, options);
        options.outline.target_crs = "+proj=tmerc +lat_0=0 +lon_0=9 +k=0.9996 +ellps=GRS80 +x_0=1e16";
        const Result there(source, options);
        repaired += there.report.counted(Reason::polygon_repaired);
        EXPECT_EQ(there.report.counted(Reason::outline_split), 0);
        const auto area_by_id = [](const Result& result) {
            std::map<std::int64_t, double> areas;
            for (std::size_t i = 0; i < result.sink.features[contours].size(); ++i)
                areas[result.sink.whole(contours, i, "id")] = result.sink.number(contours, i, "area_m2");
            return areas;
        };
        const std::map<std::int64_t, double> areas = area_by_id(here);
        for (const auto& [id, area] : area_by_id(there))
            EXPECT_NEAR(area, areas.at(id), 1e-6) << seed << " " << id;
    }
    EXPECT_GT(repaired, 0);
}

/// Cells of 1 km on the northern ice, the pole 3 km beyond the corner: Mercator's projection holds the most
/// of it, and tears or blows up the nearest part.
class ProjectionSplitWarnings : public ::testing::Test {
  protected:
    static constexpr int n = 200;
    ProjectionSplitWarnings() : source_(n, n, elevations()) {
        source_.edit().transform = {3000, 1000, 0, -3000, 0, -1000};
        source_.edit().crs_wkt = Crs("EPSG:3413").wkt();
    }
    /// Blocks of two cells squared, all four cells.
    static std::vector<double> elevations() {
        std::vector<double> z(std::size_t{n} * n, 0);
        for (int row = 0; row < n; ++row)
            for (int col = 0; col < n; ++col)
                if (row % 4 < 2 && col % 4 < 2)
                    z[static_cast<std::size_t>(row * n + col)] = 20;
        return z;
    }
    void run_to(const std::string& target, Result& result) {
        Options options = cells({10});
        options.outline.target_crs = target;
        run_on(source_, options, result);
    }
    MemorySource source_;
};

TEST_F(ProjectionSplitWarnings, areLeftOutAndNamed) {
    Result all;
    run_to("", all);
    Result some;
    run_to("EPSG:3857", some);
    ASSERT_EQ(all.sink.features[0].size(), 2500U);
    const std::size_t left = some.sink.features[0].size();
    EXPECT_LT(left, 2500U);
    EXPECT_GT(left, 2450U);
    EXPECT_EQ(some.report.buildings, static_cast<std::int64_t>(left));
    EXPECT_GE(some.report.counted(Reason::outline_split), static_cast<std::int64_t>(2500 - left));
    EXPECT_EQ(all.report.counted(Reason::outline_split), 0);
    ASSERT_FALSE(some.report.warnings.empty());
    const std::string& warning = some.report.warnings.back();
    EXPECT_NE(
        warning.find(" features are left out, because 'WGS 84 / Pseudo-Mercator' splits or distorts them: "),
        std::string::npos)
        << warning;
    EXPECT_NE(warning.find("building 1"), std::string::npos) << warning;
    EXPECT_TRUE(warning.ends_with("; choose a -t_srs that suits the area.")) << warning;
    // Areas and volumes are those on the ground, whatever the map makes of them.
    for (std::size_t i = 0, k = 0; i < left; ++i, ++k) {
        while (all.sink.whole(0, k, "id") != some.sink.whole(0, i, "id"))
            ++k;
        EXPECT_NEAR(all.sink.number(0, k, "area_m2"), some.sink.number(0, i, "area_m2"), 1e-2);
        EXPECT_NEAR(all.sink.number(0, k, "volume_m3"), some.sink.number(0, i, "volume_m3"), 1);
    }
}

TEST_F(ProjectionSplitWarnings, whereAllAreTheRunIsRefused) {
    std::vector<double> z(std::size_t{n} * n, 0);
    z[1] = z[n] = z[0] = z[n + 1] = 20;  // in the corner alone
    MemorySource source(n, n, z);
    source.edit() = source_.info();
    Options options = cells({10});
    options.outline.target_crs = "EPSG:3857";
    options.write.layers = Layers::buildings;
    Result result;
    EXPECT_THROW(run_on(source, options, result), InputError);
    EXPECT_FALSE(result.sink.finished);
}

}  // namespace
}  // namespace d2b::features
