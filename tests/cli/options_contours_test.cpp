#include <cmath>
#include <set>

#include "cli/option_effect.hpp"

namespace d2b::test {
namespace {

std::vector<double> thresholds_of(const Layer& contours) {
    std::set<double> thresholds;
    for (const Record& record : contours.records)
        if (record.number("level") > 0)
            thresholds.insert(record.number("threshold"));
    return {thresholds.begin(), thresholds.end()};
}

/// Mean and sample standard deviation of the 600 points of blocks().
struct Moments {
    double mean = (60 * 10 + 20 * 20 + 12 * 6 + 4 * 8) / 600.0;
    double deviation = std::sqrt((60 * 100 + 20 * 400 + 12 * 36 + 4 * 64 - 600 * mean * mean) / 599);
};

}  // namespace

TEST_F(OptionEffect, lod) {
    const Moments m;
    for (const int lod : {1, 2, 9}) {
        trace({"-lod", std::to_string(lod), "-overwrite", "-nf", "0"});
        std::vector<double> expected;
        for (int i = 1; i <= lod; ++i)
            if (const double t = m.mean - m.deviation + 2 * m.deviation * i / (lod + 1); t > 0)
                expected.push_back(t);
        const std::vector<double> found = thresholds_of(contours());
        ASSERT_EQ(found.size(), expected.size()) << lod;
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_NEAR(found[i], expected[i], 1e-12) << lod;
    }
}

TEST_F(OptionEffect, fl) {
    trace({"-fl", "7"});
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{7}));
    EXPECT_EQ(buildings().records.size(), 1U);               // that of 6 m is below it
    trace({"-overwrite", "-fl", "15", "5.5", "-nf", "10"});  // as many as there are
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{5.5, 15}));
    trace({"-overwrite", "-fl", "5", "-nf", "10", "-fl", "15", "12"});  // and again
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{5, 12, 15}));
    run_well({"-q", "-fl", "5", "15", "blocks.tif", "out.gpkg", "-overwrite"});  // file names are no levels
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{5, 15}));
    trace({"-overwrite", "-fl", "-3", "5"});  // a negative number is a value; nothing lies below it
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{5}));
}

TEST_F(OptionEffect, i) {
    trace({"-i", "4.5"});
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{4.5, 9, 13.5, 18}));
}

TEST_F(OptionEffect, off) {
    trace({"-i", "8", "-off", "-3"});
    EXPECT_EQ(thresholds_of(contours()), (std::vector<double>{5, 13}));
}

TEST_F(OptionEffect, trace) {
    trace({"-trace", "points"});
    EXPECT_EQ(buildings().where("id", 1).area(), 9 * 7);
    EXPECT_EQ(contours().where("level", 2).area(), 4 * 3);
    EXPECT_EQ(contours().where("level", 0).area(), 29 * 19);
    trace({"-trace", "cells", "-overwrite"});
    EXPECT_EQ(buildings().where("id", 1).area(), 10 * 8);
    EXPECT_EQ(contours().where("level", 2).area(), 5 * 4);
    EXPECT_EQ(contours().where("level", 0).area(), 30 * 20);
    const OGREnvelope box = buildings().where("id", 1).box();
    EXPECT_EQ(box.MinX, 391003);
    EXPECT_EQ(box.MaxY, 5819997);
}

TEST_F(OptionEffect, nf) {
    const auto found = [&](const char* noise_factor) {
        trace({"-nf", noise_factor, "-overwrite"});
        return std::vector<std::size_t>{buildings().records.size(), contours().records.size()};
    };
    using Counts = std::vector<std::size_t>;
    EXPECT_EQ(found("0"), (Counts{3, 5}));
    EXPECT_EQ(found("4"), (Counts{3, 5}));
    EXPECT_EQ(found("5"), (Counts{2, 4}));
    EXPECT_EQ(found("10"), (Counts{2, 4}));
    EXPECT_EQ(found("11"), (Counts{1, 3}));
    EXPECT_EQ(found("15"), (Counts{1, 2}));
    run_warned({"-q", "-nf", "33", "-fl", "5", "--", "blocks.tif", "none.gpkg"}, {"No building was found"});
    EXPECT_EQ(layer("none.gpkg", "contours").records.size(), 1U);
}

TEST_F(OptionEffect, min_area) {
    trace({"-nf", "0", "-min_area", "0.5"});
    EXPECT_EQ(buildings().records.size(), 3U);
    trace({"-nf", "0", "-min_area", "7", "-overwrite"});
    EXPECT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(contours().count(2), 1);
    trace({"-nf", "0", "-min_area", "13", "-overwrite"});
    EXPECT_EQ(contours().count(2), 0);
}

TEST_F(OptionEffect, simplify) {
    // The edges of a turned house are stairs of cells.
    const Arguments rest{"-trace", "cells", "-fl", "520", sample("courtyard_utm.tif")};
    Arguments exact{"-q", "exact.gpkg"};
    Arguments simple{"-q", "-simplify", "0.6", "simple.gpkg"};
    exact.insert(exact.begin(), rest.begin(), rest.end());
    simple.insert(simple.begin(), rest.begin(), rest.end());
    run_well(exact);
    run_well(simple);
    const Layer stairs = layer("exact.gpkg", "buildings");
    const Layer straight = layer("simple.gpkg", "buildings");
    ASSERT_EQ(stairs.records.size(), 1U);
    ASSERT_EQ(straight.records.size(), 1U);
    EXPECT_EQ(stairs.records[0].text("status"), "traced");
    EXPECT_EQ(straight.records[0].text("status"), "simplified");
    EXPECT_GT(stairs.records[0].vertices(), 150);
    EXPECT_LT(straight.records[0].vertices(), 40);
    EXPECT_TRUE(straight.records[0].valid());
    EXPECT_NEAR(straight.records[0].area(), stairs.records[0].area(), 0.02 * stairs.records[0].area());
}

TEST_F(OptionEffect, disjoint) {
    trace({});
    EXPECT_EQ(contours().where("level", 0).area(), 29 * 19);
    trace({"-disjoint", "-overwrite"});
    const Layer bands = contours();
    EXPECT_EQ(bands.where("level", 0).area(), 29 * 19 - 63 - 6);
    EXPECT_EQ(bands.where("id", 2).area(), 63 - 12);
    EXPECT_EQ(bands.where("level", 2).area(), 12);
    EXPECT_EQ(buildings().where("id", 1).area(), 63);  // footprints stay whole
    EXPECT_NEAR(bands.where("id", 2).number("area_m2"), 51, 0.06);
}

}  // namespace d2b::test
