#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/find_buildings.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

constexpr std::uint8_t flag = 2;

/// Takes the cells 7 and 400 of 600 out of what is seen. @return what the reader gives afterwards
std::vector<double> after_taking_out(double step, const Window& seen, double metres) {
    std::vector<double> z;
    for (int i = 0; i < 600; ++i)
        z.push_back(100 + step * i);
    test::MemorySource source(20, 30, z);
    Context context;
    ElevationReader reader(source, context);
    (void)reader.survey({land_elevations, {1e9, 1e9}, 1, {}}, [](const ElevationBand&) {});
    {
        UnitSurface surface(reader, seen, metres, *context.threads);
        EXPECT_EQ(surface.elevations().rows, seen.rows);
        Grid<std::uint8_t> flags(seen.rows, seen.cols, 1);
        flags.values[7] |= flag;
        flags.values[400] |= flag;
        surface.mask_flagged(flags, flag, *context.threads);
        for (std::size_t i = 0; i < surface.elevations().size(); ++i)
            if (i == 7 || i == 400)
                EXPECT_TRUE(std::isnan(surface.elevations().values[i]));
            else
                EXPECT_EQ(surface.elevations().values[i], static_cast<float>(z[i] * metres)) << i;
    }
    std::vector<double> after;
    reader.for_each([&](const ElevationBand& band) {
        after.insert(after.end(), band.elevations.begin(), band.elevations.end());
    });
    EXPECT_EQ(after, z);
    return after;
}

TEST(UnitSurface, LeavesTheReadersElevationsAsTheyWere) {
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 20, 30}, 1)[7], 101.75);  // the reader's own
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 19, 30}, 1)[7], 101.75);  // a part
    EXPECT_EQ(after_taking_out(0.25, {0, 0, 20, 30}, 0.3048)[7], 101.75);
    EXPECT_EQ(after_taking_out(0.1, {0, 0, 20, 30}, 1).size(), 600U);  // doubles
}

}  // namespace
}  // namespace d2b
