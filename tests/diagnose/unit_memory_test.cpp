#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

TEST(UnitMemory, IsToldWhereItIsMoreThanUsual) {
    EXPECT_EQ(unit_memory_notice({48 << 20, 300, 60}), "");
    // 20 bytes a point.
    EXPECT_EQ(
        unit_memory_notice({53'687'091, 300, 60}),
        "ground and buildings are looked for in up to 54 million points at a time, as parts of the raster "
        "are seen with 300 m around them (five times -max_building_width 60), which takes some 1 GiB of "
        "memory");
    EXPECT_EQ(unit_memory_notice({1 << 30, 7.5, {}}),
              "ground and buildings are looked for in up to 1074 million points at a time, as parts of the "
              "raster are seen with 7.5 m around them, which takes some 20 GiB of memory");
}

TEST(UnitMemory, IsRefusedWhereItIsTooMuch) {
    EXPECT_EQ(unit_memory_refusal({1 << 30, 3000, 600}), "");
    EXPECT_EQ(
        unit_memory_refusal({2'000'000'000, 25000, 5000}),
        "Ground and buildings would be looked for in 2000 million points at a time, as parts of the raster "
        "are seen with 25000 m around them (five times -max_building_width 5000), which takes some 37 GiB "
        "of memory; more than 1074 million points are not held, so give a smaller -max_building_width.");
    EXPECT_EQ(
        unit_memory_refusal({2'000'000'000, 300, {}}),
        "Ground and buildings would be looked for in 2000 million points at a time, as parts of the raster "
        "are seen with 300 m around them, which takes some 37 GiB of memory; more than 1074 million points "
        "are not held, so make the cells larger with gdalwarp -tr.");
}

}  // namespace
}  // namespace d2b
