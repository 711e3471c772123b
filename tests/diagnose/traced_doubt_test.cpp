#include "diagnose/traced_doubt.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(TracedDoubt, FromFivePerCentOn) {
    RunReport report;
    EXPECT_EQ(traced_doubt(report, 0.5), "") << "nothing was written";
    report.outlines_m = 1000;
    report.kept_traced_m = 50;
    EXPECT_EQ(traced_doubt(report, 0.5), "");
    report.kept_traced_m = 60;
    EXPECT_EQ(traced_doubt(report, 0.5),
              "6 % of the length of the buildings' outlines stays as the cells make them, where anything "
              "else would have "
              "left the trace or met a neighbour; -write_rejected shows which, and a larger "
              "-regularize_tolerance may straighten more");
    report.kept_traced_m = 970;
    EXPECT_EQ(traced_doubt(report, 2.5),
              "97 % of the length of the buildings' outlines stays as the cells make them, since walls "
              "cannot be told in "
              "cells of 2.5 m; use a finer raster, or a larger -regularize_tolerance");
}

}  // namespace
}  // namespace d2b
