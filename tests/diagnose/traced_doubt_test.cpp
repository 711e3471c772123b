#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

const std::string fine_cells =
    ", since straight walls would have left the trace or met a neighbour; -write_rejected shows these "
    "outlines, and a larger -regularize_tolerance may "
    "straighten more";

TEST(TracedDoubt, FromFivePerCentOfTheBuildingsOn) {
    EXPECT_EQ(traced_warning({}, {}, 0.5), "") << "nothing was written";
    EXPECT_EQ(traced_warning({950, 0, 50}, {}, 0.5), "");
    EXPECT_EQ(traced_warning({900, 40, 60}, {}, 0.5),
              "6 % of the length of the buildings' outlines keeps the staircase of the cells" + fine_cells);
    EXPECT_EQ(traced_warning({30, 0, 970}, {30, 0, 970}, 2.5),
              "97 % of the length of the buildings' outlines keeps the staircase of the cells, since walls "
              "cannot be seen in cells of 2.5 m; use a finer raster, or a larger -regularize_tolerance");
}

TEST(TracedDoubt, FromNinetyPerCentOfTheContoursOnWhereTheyAreAlone) {
    EXPECT_EQ(traced_warning({950, 0, 50}, {0, 0, 1000}, 0.5), "");
    EXPECT_EQ(traced_warning({}, {60, 40, 900}, 0.5), "");
    EXPECT_EQ(traced_warning({}, {60, 30, 910}, 0.5),
              "91 % of the length of the contours' outlines keeps the staircase of the cells" + fine_cells);
}

}  // namespace
}  // namespace d2b
