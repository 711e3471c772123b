#include <cmath>

#include "cli/option_effect.hpp"
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
        EXPECT_LE(straight.records[0].number("moved_m"), 0.75 + 1e-6);
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
        EXPECT_LE(buildings().records[0].number("moved_m"), cells * 0.5 + 1e-6) << cells;
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

}  // namespace d2b::test
