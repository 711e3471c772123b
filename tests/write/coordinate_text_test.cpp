#include <gtest/gtest.h>

#include "core/number_from_chars.hpp"
#include "write/surface/obj_stl_sink.hpp"

namespace d2b {
namespace {

/// With a point, whatever the locale says.
float first_number(const std::string& text) {
    float number = 0;
    number_from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Neighbouring steps stay apart in single precision, as far out as the lattice allows.
TEST(LocalCoordinateFormatter, tellsStepsApart) {
    for (const double cell : {0.1, 0.25, 0.5, 1.0, 2.5, 30.0}) {
        SurfaceFrame frame;
        frame.scale = {cell / 1024, cell / 1024, 0.001};
        frame.translate = {0.3, 0.7, 0};
        const LocalCoordinateFormatter text(frame);
        for (const std::int64_t x : {std::int64_t{0}, std::int64_t{12345}, std::int64_t{8191} * 1024})
            for (std::int64_t step = 0; step < 64; ++step) {
                const float here = first_number(text({x + step, 0, 0}));
                const float next = first_number(text({x + step + 1, 0, 0}));
                EXPECT_LT(here, next) << cell << " " << x;
            }
    }
}

TEST(LocalCoordinateFormatter, hasNoMoreDigitsThanItNeeds) {
    SurfaceFrame frame;
    frame.scale = {1 / 1024.0, 1 / 1024.0, 0.001};
    const LocalCoordinateFormatter text(frame);
    EXPECT_EQ(text({0, 0, 0}), "0 0 0");
    EXPECT_EQ(text({-1024, 512, -1500}), "-1 0.5 -1.5");
    EXPECT_EQ(text({1, -1, 1}), "0.0009765625 -0.0009765625 0.001");
    frame.horizontal_metres = 0.3048;
    frame.origin = {100, 0, -2};
    EXPECT_EQ(origin_text(frame), "100 0 -2");
    EXPECT_EQ(LocalCoordinateFormatter(frame)({1024 * 1000, 0, 0}), "204.8 0 2");
}

/// Three corners in a line are in a line as they are written: the text has all decimals, wherever the raster
/// lies.
TEST(LocalCoordinateFormatter, roundsNothing) {
    SurfaceFrame frame;
    frame.scale = {0.4 / 1024, 0.4 / 1024, 0.001};
    frame.translate = {391000.1, 5820000.3, 0};
    frame.origin = {391000, 5820000, 0};
    const LocalCoordinateFormatter text(frame);
    EXPECT_EQ(text({0, 0, 0}), "0.1 0.3 0");
    EXPECT_EQ(text({1, 3, 0}), "0.100390625 0.301171875 0");
    EXPECT_EQ(text({7'000'001, 21'000'003, 0}), "2734.475390625 8203.426171875 0");
}

/// Feet have more than any reader tells apart.
TEST(LocalCoordinateFormatter, roundsFeet) {
    SurfaceFrame frame;
    frame.scale = {1 / 1024.0, 1 / 1024.0, 0.001};
    frame.horizontal_metres = 1200.0 / 3937;
    EXPECT_EQ(LocalCoordinateFormatter(frame)({1, 2, 0}), "0.0003 0.0006 0");
}

}  // namespace
}  // namespace d2b
