#include <algorithm>
#include <array>
#include <cmath>

#include "cli/option_effect.hpp"
#include "cli/read_obj.hpp"
#include "cli/town_files.hpp"
#include "core/text.hpp"

namespace d2b::test {
namespace {

/// A round house with a radius of 15 m on level ground, cells of 0.5 m.
RasterSpec round_house() {
    RasterSpec spec;
    spec.cols = spec.rows = 120;
    spec.type = GDT_Float32;
    spec.transform = std::array<double, 6>{391000, 0.5, 0, 5820000, 0, -0.5};
    spec.crs = "EPSG:25833";
    for (int r = 0; r < 120; ++r)
        for (int c = 0; c < 120; ++c)
            spec.values.push_back(std::hypot(r - 59.5, c - 59.5) < 30 ? 12 : 0);
    return spec;
}

/// A house of 30 by 20 m on level ground, cells of 0.5 m.
RasterSpec square_house() {
    RasterSpec spec = round_house();
    for (int r = 0; r < 120; ++r)
        for (int c = 0; c < 120; ++c)
            spec.values[static_cast<std::size_t>(120 * r + c)] =
                r >= 40 && r < 80 && c >= 30 && c < 90 ? 12 : 0;
    return spec;
}

}  // namespace

TEST_F(OptionEffect, regularize) {
    preset_ = "buildings";
    const auto found = [&](Arguments arguments) {
        std::filesystem::remove(path("out.gpkg"));
        arguments.insert(arguments.end(), {"-q", "--", sample("courtyard_utm.tif"), "out.gpkg"});
        run_well(arguments);
        EXPECT_EQ(buildings().records.size(), 1U);
        EXPECT_TRUE(buildings().records[0].valid());
        return buildings();
    };
    const Layer traced = found({"-regularize", "off"});
    EXPECT_EQ(traced.records[0].text("status"), "traced");
    EXPECT_GT(traced.records[0].vertices(), 150);  // the steps of a turned house
    EXPECT_EQ(traced.records[0].number("moved_m"), 0);
    EXPECT_EQ(traced.metadata.at("D2B_REGULARIZE"), "off");
    const Layer standard = found({});
    for (const char* walls : {"auto", "right", "free"}) {
        const Layer straight = found({"-regularize", walls});
        EXPECT_EQ(straight.records[0].text("status"), "regularized") << walls;
        EXPECT_LT(straight.records[0].vertices(), 30) << walls;
        EXPECT_GT(straight.records[0].number("moved_m"), 0);
        EXPECT_LE(straight.records[0].number("moved_m"), 2.5 + 0.25 + 1e-6);
        EXPECT_NEAR(straight.records[0].area(), traced.records[0].area(), 0.02 * traced.records[0].area());
        EXPECT_NEAR(straight.records[0].number("area_chg"),
                    straight.records[0].area() / traced.records[0].area() - 1, 1e-6);
        EXPECT_EQ(straight.metadata.at("D2B_REGULARIZE"), walls);
        if (std::string(walls) == "auto") {
            EXPECT_EQ(straight.records[0].wkt(), standard.records[0].wkt());
        }
    }
}

TEST_F(OptionEffect, regularize__worksOnContoursOfThePresetThesis) {
    const Arguments rest{"-q",      "-trace", "cells", "-fl", "520", "--", sample("courtyard_utm.tif"),
                         "out.gpkg"};
    Arguments arguments{"-preset", "thesis", "-regularize", "right"};
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    run_well(arguments);
    EXPECT_EQ(buildings().records[0].text("status"), "regularized");
    EXPECT_LT(buildings().records[0].vertices(), 30);
}

TEST_F(OptionEffect, regularize_tolerance) {
    preset_ = "buildings";
    const auto within = [&](double cells) {
        return Arguments{"-q",
                         "-overwrite",
                         "-regularize_tolerance",
                         number_text(cells),
                         "--",
                         sample("courtyard_utm.tif"),
                         "out.gpkg"};
    };
    for (const double cells : {0.8, 1.0, 3.0}) {
        run_well(within(cells));
        // Half a cell more, because corners of the trace lie farther from a wall than the middles of its
        // steps.
        const double farthest = (cells + std::min(0.5, cells / 2)) * 0.5;
        EXPECT_LE(buildings().records[0].number("moved_m"), farthest + 1e-6) << cells;
    }
    run_warned(within(0.01), {"keeps the staircase of the cells"});  // no straight wall is that near to steps
    EXPECT_GT(buildings().records[0].vertices(), 100);
}

TEST_F(OptionEffect, wall_inset) {
    preset_ = "buildings";
    write(path("round.tif"), round_house());
    write(path("square.tif"), square_house());
    const auto found = [&](const char* file, const char* cells) {
        run_well({"-q", "-overwrite", "-wall_inset", cells, "--", file, "out.gpkg"});
        EXPECT_EQ(buildings().records.size(), 1U);
        return buildings();
    };
    // A quarter of a metre on each side; detection has rounded the corners a little.
    const double area = found("square.tif", "0").records.at(0).area();
    EXPECT_NEAR(area, 30 * 20, 4);
    const Layer inset = found("square.tif", "0.5");
    EXPECT_NEAR(area - inset.records.at(0).area(), 30 * 20 - 29.5 * 19.5, 0.75);
    EXPECT_GE(inset.records[0].number("moved_m"), 0.25);
    EXPECT_EQ(inset.records[0].text("status"), "regularized");
    const double radius = std::sqrt(found("round.tif", "0").records.at(0).area() / M_PI);
    EXPECT_NEAR(std::sqrt(found("round.tif", "0.5").records.at(0).area() / M_PI), radius - 0.25, 0.01);
}

TEST_F(OptionEffect, arcs) {
    preset_ = "buildings";
    write(path("round.tif"), round_house());
    const auto found = [&](Arguments arguments) {
        std::filesystem::remove(path("out.gpkg"));
        arguments.insert(arguments.end(), {"-q", "--", "round.tif", "out.gpkg"});
        run_well(arguments);
        return buildings();
    };
    const Layer pieces = found({});
    ASSERT_EQ(pieces.records.size(), 1U);
    EXPECT_EQ(OGR_GT_IsNonLinear(pieces.type), 0);
    EXPECT_GT(pieces.records[0].vertices(), 16);
    const Layer curved = found({"-arcs"});
    ASSERT_EQ(curved.records.size(), 1U);
    EXPECT_NE(OGR_GT_IsNonLinear(curved.type), 0);
    EXPECT_NE(curved.records[0].wkt().find("CIRCULARSTRING"), std::string::npos);
    EXPECT_NEAR(curved.records[0].area(), M_PI * 15 * 15, 0.02 * M_PI * 15 * 15);
    EXPECT_NEAR(pieces.records[0].area(), M_PI * 15 * 15, 0.02 * M_PI * 15 * 15);
}

namespace {

/// Not level, because one value along the border with a step to all else is undeclared NoData.
std::vector<double> uneven_ground(std::size_t rows, std::size_t cols) {
    std::vector<double> values(rows * cols, 100);
    for (std::size_t i = 0; i < values.size(); i += 2)
        values[i] = 100.01;
    return values;
}

/// 340 x 180 cells of half a metre; two houses of 60 x 70 m, 10 m high, half a metre apart; the second one
/// has a step of half a metre in its southern wall.
RasterSpec two_houses() {
    constexpr std::size_t rows = 180;
    constexpr std::size_t cols = 340;
    RasterSpec spec = town_raster(uneven_ground(rows, cols));
    spec.rows = rows;
    spec.cols = cols;
    spec.transform = std::array<double, 6>{391000, 0.5, 0, 5820000, 0, -0.5};
    const auto put = [&](std::size_t row, std::size_t col, std::size_t height, std::size_t width) {
        for (std::size_t r = row; r < row + height; ++r)
            for (std::size_t c = col; c < col + width; ++c)
                spec.values[r * cols + c] = 110;
    };
    put(30, 20, 120, 140);
    put(30, 161, 120, 140);
    put(150, 200, 1, 40);
    return spec;
}

/// Between corners: where a wall goes straight on it does not end.
double shortest_wall(const Layer& layer) {
    double shortest = 1000;
    for (const Record& record : layer.records) {
        OGRGeometryH ring = OGR_G_GetGeometryRef(OGR_G_GetGeometryRef(record.geometry(), 0), 0);
        const int count = OGR_G_GetPointCount(ring) - 1;
        const auto side = [&](int i) {
            const int from = (i + count) % count;
            return std::array{OGR_G_GetX(ring, from + 1) - OGR_G_GetX(ring, from),
                              OGR_G_GetY(ring, from + 1) - OGR_G_GetY(ring, from)};
        };
        const auto turns = [&](int i) {
            const auto [x1, y1] = side(i - 1);
            const auto [x2, y2] = side(i);
            return std::abs(std::atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)) > 0.01;
        };
        for (int i = 0; i < count; ++i)
            if (turns(i) && turns(i + 1))
                shortest = std::min(shortest, std::hypot(side(i)[0], side(i)[1]));
    }
    return shortest;
}

double gap(const Layer& layer) {
    return OGR_G_Distance(layer.records.at(0).geometry(), layer.records.at(1).geometry());
}

}  // namespace

TEST_F(OptionEffect, flow_ready) {
    write(path("houses.tif"), two_houses());
    const auto houses = [&](const Arguments& more) {
        Arguments all{"-preset", "buildings", "-q", "-overwrite", "-regularize", "off", "-write_problems"};
        all.insert(all.end(), more.begin(), more.end());
        all.insert(all.end(), {"--", "houses.tif", "out.gpkg"});
        run_well(all);
        EXPECT_EQ(buildings().records.size(), 2U);
        return buildings();
    };
    const Layer as_found = houses({"-surface", "s.obj"});
    EXPECT_EQ(gap(as_found), 0.5);
    EXPECT_EQ(shortest_wall(as_found), 0.5);
    const Layer ready = houses({"-flow_ready", "1.5"});
    EXPECT_EQ(gap(ready), 0);
    EXPECT_GE(shortest_wall(ready), 1.5);
    const Layer problems = layer("out.gpkg", "problems");
    ASSERT_GE(problems.records.size(), 2U);
    for (const Record& problem : problems.records) {
        EXPECT_EQ(problem.text("state"), "changed");
        EXPECT_LE(problem.number("before"), 1.5);
    }
}

/// Outlines of the thesis as well; buildings beside cells without an elevation do not move across these.
TEST_F(OptionEffect, flow_ready__inThesisMode) {
    RasterSpec spec = two_houses();
    const auto cell = [&](std::size_t row, std::size_t col) -> double& {
        return spec.values[row * static_cast<std::size_t>(spec.cols) + col];
    };
    // A third house, beside two columns of nothing, with a step of half a metre there.
    for (std::size_t row = 10; row < 20; ++row)
        for (std::size_t col = 220; col < 240; ++col)
            cell(row, col) = row == 10 && col < 230 ? 100 : 110;
    for (std::size_t row = 5; row < 11; ++row)
        for (std::size_t col = 229; col < 231; ++col)
            cell(row, col) = -9999;
    spec.nodata = -9999;
    write(path("houses.tif"), spec);
    const Arguments asked{"-preset", "thesis", "-trace", "cells",           "-q", "-overwrite", "-lod",
                          "1",       "-nf",    "0",      "-write_problems", "--", "houses.tif", "out.gpkg"};
    Arguments without = asked;
    without.insert(without.begin(), {"-surface", "s.obj"});
    run_well(without);
    ASSERT_EQ(buildings().records.size(), 3U);
    EXPECT_EQ(shortest_wall(buildings()), 0.5);
    Arguments with = asked;
    with.insert(with.begin(), {"-flow_ready", "1.5", "-surface", "s.obj"});
    ASSERT_EQ(run(with).status, 0);
    const Layer ready = buildings();
    ASSERT_EQ(ready.records.size(), 3U);
    // The remaining problems lie at the third house.
    std::size_t left = 0;
    for (const Record& problem : layer("out.gpkg", "problems").records)
        if (problem.text("state") == "left") {
            ++left;
            EXPECT_NEAR(OGR_G_GetY(problem.geometry(), 0), 5820000 - 7.5, 4);
        }
    EXPECT_GT(left, 0U);
    const Layer all = contours();
    const auto terrain =
        std::ranges::find_if(all.records, [](const Record& record) { return record.number("level") == 0; });
    ASSERT_NE(terrain, all.records.end());
    for (const Record& house : ready.records)
        EXPECT_TRUE(OGR_G_Contains(terrain->geometry(), house.geometry()));
}

/// Both have types of their own for changed outlines.
TEST_F(OptionEffect, flow_ready__beside_split_height) {
    const ToolResult result = run({"-preset", "buildings", "-q", "-flow_ready", "1", "-split_height", "3",
                                   "--", sample("town.tif"), "out.gpkg"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_GT(buildings().records.size(), 300U);
}

TEST_F(OptionEffect, min_gap) {
    write(path("houses.tif"), two_houses());
    run_well({"-preset", "buildings", "-q", "-overwrite", "-min_gap", "1.5", "--", "houses.tif", "out.gpkg"});
    EXPECT_EQ(gap(buildings()), 0);
    run_well({"-preset", "buildings", "-q", "-overwrite", "-min_gap", "0.4", "--", "houses.tif", "out.gpkg"});
    EXPECT_NEAR(gap(buildings()), 0.5, 0.05);
}

TEST_F(OptionEffect, min_wall) {
    write(path("houses.tif"), two_houses());
    run_well({"-preset", "buildings", "-q", "-overwrite", "-regularize", "off", "-min_wall", "0.6", "--",
              "houses.tif", "out.gpkg"});
    EXPECT_GT(gap(buildings()), 0);
    EXPECT_GE(shortest_wall(buildings()), 0.6);
}

/// Half of each block is higher by less than the wall that is asked for. Those of 12 and 12.2 m become one of
/// 12.1 m, which moves 0.8 % of the volume; for those of 3.5 and 4.2 m it would be 9 %.
TEST_F(OptionEffect, min_wall__makesOneRoofOfTwo) {
    RasterSpec spec = town_raster(uneven_ground(80, 300));
    spec.rows = 80;
    spec.cols = 300;
    spec.transform = std::array<double, 6>{391000, 0.5, 0, 5820000, 0, -0.5};
    fill(spec, 20, 60, 20, 50, 112);
    fill(spec, 20, 60, 50, 80, 112.2);
    fill(spec, 20, 60, 120, 150, 103.5);
    fill(spec, 20, 60, 150, 180, 104.2);
    write(path("one.tif"), spec);
    fill(spec, 20, 60, 220, 250, 103.5);
    fill(spec, 20, 60, 250, 280, 104.2);
    write(path("two.tif"), spec);
    const auto run_on = [&](const std::string& dem, const std::string& warning) {
        run_warned({"-preset", "buildings", "-overwrite", "-split_height", "0.1", "-min_wall", "1",
                    "-surface", "s.obj", "-write_problems", "--", dem, "out.gpkg"},
                   {warning});
        return layer("out.gpkg", "problems");
    };
    const std::string reason =
        " lower than -min_wall and left, because one roof would move more than 1 % of the volume of a block; "
        "-write_problems shows where.";
    const Layer problems = run_on("one.tif", "Warning: 1 step between roofs is" + reason);
    ASSERT_EQ(problems.records.size(), 2U);
    const auto expect_step = [](const Record& problem, double x, double before, double after) {
        EXPECT_EQ(problem.text("kind"), "flow_step");
        EXPECT_NEAR(OGR_G_GetX(problem.geometry(), 0), x, 0.25);
        EXPECT_NEAR(problem.number("before"), before, 0.001);
        EXPECT_NEAR(problem.number("after"), after, 0.001);
        EXPECT_EQ(problem.text("state"), after == 0 ? "changed" : "left");
        EXPECT_EQ(problem.number("other"), problem.number("building") + 1);
    };
    expect_step(problems.records[0], 391025, 0.2, 0);
    expect_step(problems.records[1], 391075, 0.7, 0.7);
    const ReadObj obj = read_obj(path("s.obj"));
    for (const std::string building : {"building_1", "building_2"})
        EXPECT_NEAR(obj.heights(building)[1] - obj.heights(building)[0], 12.1, 0.02);
    EXPECT_NEAR(obj.heights("building_3")[1] - obj.heights("building_3")[0], 3.5, 0.02);
    EXPECT_NEAR(obj.heights("building_4")[1] - obj.heights("building_4")[0], 4.2, 0.02);
    // The layer keeps the heights that were found.
    EXPECT_NEAR(buildings().records[1].number("height") - buildings().records[0].number("height"), 0.2,
                0.001);
    EXPECT_EQ(run_on("two.tif", "Warning: 2 steps between roofs are" + reason).records.size(), 3U);
}

}  // namespace d2b::test
