#include <algorithm>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "cli/read_obj.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

/// 12 x 12 cells of a metre; two blocks of 4 x 4 of them, 20 m high, touch in a corner, which is at
/// (391006, 5819994).
RasterSpec touching_blocks() {
    RasterSpec spec = town_raster(std::vector<double>(144, 0));
    spec.rows = spec.cols = 12;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t col = 0; col < 4; ++col) {
            spec.values[(2 + row) * 12 + 2 + col] = 20;
            spec.values[(6 + row) * 12 + 6 + col] = 20;
        }
    return spec;
}

/// Twelve blocks of 4 x 4 cells, 20 m high, stand where nothing else is known, below each other, and one
/// beside them on ground.
RasterSpec blocks_without_ground() {
    constexpr std::size_t rows = 74;
    constexpr std::size_t cols = 16;
    RasterSpec spec = town_raster(std::vector<double>(rows * cols, -9999));
    spec.rows = rows;
    spec.cols = cols;
    spec.nodata = -9999;
    const auto put = [&](std::size_t top, std::size_t left, std::size_t height, std::size_t width, double z) {
        for (std::size_t row = top; row < top + height; ++row)
            for (std::size_t col = left; col < left + width; ++col)
                spec.values[row * cols + col] = z;
    };
    // Not level, because one value along the border is undeclared NoData.
    for (std::size_t row = 0; row < rows; ++row)
        put(row, 8, 1, 8, row % 2 == 0 ? -0.5 : -0.25);
    put(2, 10, 4, 4, 20);
    for (std::size_t i = 0; i < 12; ++i)
        put(2 + 6 * i, 2, 4, 4, 20);
    return spec;
}

const Arguments thesis{"-preset", "thesis", "-trace", "cells",    "-fl",   "0",          "10",
                       "-nf",     "0",      "-q",     "-surface", "s.obj", "-overwrite", "-write_problems"};

Arguments thesis_with(const Arguments& more) {
    Arguments all = thesis;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

TEST_F(OptionEffect, write_problems) {
    write(path("touch.tif"), touching_blocks());
    const std::string report = run_well(thesis_with({"-json", "--", "touch.tif", "out.gpkg"}));
    EXPECT_EQ(nlohmann::json::parse(report)["dropped"]["surface_corner_cut"], 1);
    EXPECT_EQ(layer_names(path("out.gpkg")), (std::vector<std::string>{"buildings", "contours", "problems"}));
    const Layer problems = layer("out.gpkg", "problems");
    EXPECT_EQ(problems.type, wkbPoint);
    ASSERT_EQ(problems.records.size(), 1U);
    const Record& problem = problems.records.front();
    EXPECT_EQ(problem.wkt(), "POINT (391006 5819994)");
    EXPECT_EQ(problem.number("id"), 1);
    EXPECT_EQ(problem.text("kind"), "surface_corner_cut");
    EXPECT_EQ(problem.number("building"), 1);
    EXPECT_EQ(problem.number("other"), 2);
    EXPECT_EQ(problem.number("before"), 0);
    // A centimetre is 10.24 steps of 1/1024 m, so 11 of them along the diagonal, where most room is.
    EXPECT_NEAR(problem.number("after"), 11 * std::sqrt(2) / 1024, 1e-9);
    EXPECT_EQ(problem.text("state"), "changed");
    run_well(thesis_with({"-nln", "roofs", "--", "touch.tif", "out.gpkg"}));
    EXPECT_EQ(layer("out.gpkg", "roofs_problems").records.size(), 1U);
}

/// What no surface can be made of is named, up to ten of it, counted, and has its place; the rest is made.
TEST_F(OptionEffect, write_problems__ofBuildingsThatAreLost) {
    write(path("bare.tif"), blocks_without_ground());
    Arguments arguments = thesis_with({"-surface_of", "buildings", "-json", "--", "bare.tif", "out.gpkg"});
    const ToolResult result = run(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["dropped"]["surface_lost"], 12) << result.out;
    expect_has(result.err,
               " is not in the surface: it has no height above its ground, or no closed surface was found "
               "for it.\n");
    expect_has(result.err, "Warning: 2 more buildings are not in the surface.\n");
    EXPECT_EQ(read_obj(path("s.obj")).objects().size(), 1U);
    const Layer lost = layer("out.gpkg", "problems");
    ASSERT_EQ(lost.records.size(), 12U);
    for (const Record& problem : lost.records) {
        EXPECT_EQ(problem.text("kind"), "surface_lost");
        EXPECT_EQ(problem.text("state"), "left");
        EXPECT_NEAR(problem.number("before"), 16, 0.01);
        EXPECT_LE(OGR_G_GetX(problem.geometry(), 0), 391006);
    }
}

TEST_F(OptionEffect, write_problems__whereAFormatHoldsOneLayer) {
    write(path("touch.tif"), touching_blocks());
    Arguments arguments = thesis_with({"-layers", "buildings", "--", "touch.tif", "out.geojson"});
    std::erase(arguments, "-q");
    run_warned(arguments, {"Warning: -write_problems: the format holds one layer, which has no room for 1 "
                           "problem; write a GeoPackage."});
    EXPECT_EQ(layer("out.geojson", "out").records.size(), 2U);
}

TEST_F(OptionEffect, write_problems__addsToTheLayer) {
    write(path("touch.tif"), touching_blocks());
    Arguments arguments = thesis_with({"--", "touch.tif", "out.gpkg"});
    run_well(arguments);
    std::ranges::replace(arguments, std::string("-overwrite"), std::string("-append"));
    arguments.insert(arguments.begin(), {"-surface_origin", "391000", "5820000", "0"});
    std::filesystem::remove(path("s.obj"));
    std::filesystem::remove(path("s.mtl"));
    run_well(arguments);
    const Layer problems = layer("out.gpkg", "problems");
    ASSERT_EQ(problems.records.size(), 2U);
    EXPECT_GT(problems.records[1].number("id"), problems.records[0].number("id"));
}

}  // namespace d2b::test
