#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

TEST(ScaleDoubt, CellsWiderThanThreeMetres) {
    EXPECT_EQ(coarse_cells_warning(0.5), "");
    EXPECT_EQ(coarse_cells_warning(3), "");
    EXPECT_EQ(coarse_cells_warning(30.94),
              "the cells are 30.9 m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m "
              "may do");
}

TEST(ScaleDoubt, ToleranceOfMoreThanAHundredCells) {
    EXPECT_EQ(tolerance_warning(0, 0.5), "");
    EXPECT_EQ(tolerance_warning(50, 0.5), "");
    EXPECT_EQ(tolerance_warning(60, 0.5),
              "-simplify 60 is 120 cells wide, which leaves little of a building; it is in units of the "
              "input's CRS");
}

}  // namespace
}  // namespace d2b
