#include <algorithm>
#include <cmath>
#include <filesystem>

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
    run_well(thesis_with({"--", "touch.tif", "out.gpkg"}));
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
    // Two steps along the diagonal, where most room is.
    EXPECT_NEAR(problem.number("after"), 2 * std::sqrt(2) / 1024, 1e-9);
    EXPECT_EQ(problem.text("state"), "changed");
    run_well(thesis_with({"-nln", "roofs", "--", "touch.tif", "out.gpkg"}));
    EXPECT_EQ(layer("out.gpkg", "roofs_problems").records.size(), 1U);
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
    run_well(arguments);
    const Layer problems = layer("out.gpkg", "problems");
    ASSERT_EQ(problems.records.size(), 2U);
    EXPECT_GT(problems.records[1].number("id"), problems.records[0].number("id"));
}

}  // namespace d2b::test
