#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

TEST(SamplingDoubt, IsNoneOfADenseScan) {
    EXPECT_EQ(sparse_points_warning({}, 0.5), "");
    EXPECT_EQ(blur_warning({}, 0.5), "") << "nothing is known";
    const SamplingReport good{0.08, 2.5, 2.5, {}};
    EXPECT_EQ(sparse_points_warning(good, 1), "");
    EXPECT_EQ(blur_warning(good, 1), "");
}

TEST(SamplingDoubt, IsOfThinPoints) {
    EXPECT_EQ(
        sparse_points_warning({0.197, 1.62, 0.8, {}}, 2.5),
        "points are thin: about 1.6 fell into a cell of 2.5 m, and none into 20 % of the cells, so roofs "
        "look "
        "rough, small houses may be missed, and crowns taken for houses; use a denser scan, or look through "
        "what was left out with -write_doubtful");
}

TEST(SamplingDoubt, IsOfSmearedWalls) {
    EXPECT_EQ(
        blur_warning({0, {}, 4.42, {}}, 2),
        "walls are smeared: they fall over 4.4 cells (8.8 m), as in surfaces from satellites or of finer "
        "cells than their data, so gaps and courtyards narrower than that are closed, and corners and small "
        "houses lost; use a surface whose walls fall within two cells");
}

TEST(SamplingDoubt, IsOfRoundedElevations) {
    const auto doubt = [](double step, double metres) {
        SamplingReport report;
        report.value_step = step;
        return rounding_warning(report, metres);
    };
    EXPECT_EQ(rounding_warning({}, 1), "");
    EXPECT_EQ(doubt(0.01, 1), "");
    EXPECT_EQ(doubt(0.25, 1), "");
    EXPECT_EQ(doubt(1, 0.3048), "") << "a foot";
    EXPECT_NE(doubt(2, 0.3048), "");
    EXPECT_NE(doubt(50, 0.01), "");
    EXPECT_EQ(
        doubt(0.5, 1),
        "elevations are rounded to steps of 0.5 m, so a roof may be as rough as a crown, and low buildings, "
        "small parts and heights are uncertain by as much; use elevations that are rounded to centimetres, "
        "or not at all");
}

}  // namespace
}  // namespace d2b
