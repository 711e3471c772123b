#include <algorithm>
#include <limits>
#include <vector>

#include "view/field.hpp"
#include "view/map_picture.hpp"
#include "view/page.hpp"
#include "view/pixels.hpp"

namespace d2b::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Pixels painted(const MapArea& ground, PixelSize size, const std::vector<float>& z) {
    Relief relief(MapFrame(ground, size));
    // In two pieces, as bands come.
    const std::int32_t first = ground.dem.rows / 3;
    const auto cells = static_cast<std::size_t>(first * ground.dem.cols);
    relief.write({0, 0, first, ground.dem.cols}, std::span(z).first(cells));
    relief.write({first, 0, ground.dem.rows - first, ground.dem.cols}, std::span(z).subspan(cells));
    return {size, [&](cairo_t* pen) { paint(relief, pen); }};
}

/// 20 x 20 cells, level but for a slope to the south in the last rows; two cells are no elevations.
std::vector<float> slope() {
    std::vector<float> z(400, 5);
    z[0] = z[1] = nan;
    for (std::size_t i = 300; i < 400; ++i)
        z[i] = 5 - static_cast<float>(i / 20 - 14);
    return z;
}

TEST(Relief, LevelGroundIsGreyAndSlopesAreShaded) {
    const Pixels map = painted(field(20, 20, {}, {0, 1, 0, 20, 0, -1}), {200, 200}, slope());
    EXPECT_EQ(map.at(75, 75), level_ground);
    EXPECT_EQ(map.at(75, 3), level_ground);
    EXPECT_EQ(map.at(8, 3), paper);  // no elevation, nor does it shade what is beside it
    EXPECT_EQ(map.at(35, 5), level_ground);
    EXPECT_LT(map.at(75, 175)[0], level_ground[0] - 20);  // away from the light
    EXPECT_EQ(map.at(199, 199), map.at(0, 199));          // to the edge
}

TEST(Relief, IsLitFromTheUpperLeftWhicheverWayRowsAndColumnsRun) {
    const std::vector<float> z = slope();
    const Pixels expected = painted(field(20, 20, {}, {0, 1, 0, 20, 0, -1}), {200, 200}, z);
    const auto expect_same = [&](const std::vector<float>& other, const AffineTransform& transform) {
        const Pixels map = painted(field(20, 20, {}, transform), {200, 200}, other);
        for (int y = 0; y < 200; y += 3)
            for (int x = 0; x < 200; x += 3)
                expect_near(map.at(x, y), expected.at(x, y), 1);
    };
    std::vector<float> mirrored = z;
    for (auto row = mirrored.begin(); row != mirrored.end(); row += 20)
        std::reverse(row, row + 20);
    expect_same(mirrored, {20, -1, 0, 20, 0, -1});
    expect_same({mirrored.rbegin(), mirrored.rend()}, {0, 1, 0, 0, 0, 1});  // rows from below
    expect_same({z.rbegin(), z.rend()}, {20, -1, 0, 0, 0, 1});
}

TEST(Relief, WhatIsSmallerThanAPixelIsAveraged) {
    // Roofs and gaps by turns, four cells a pixel: none of them is seen, and all of it is level.
    std::vector<float> z(400 * 400);
    for (std::size_t i = 0; i < z.size(); ++i)
        z[i] = (i % 400 + i / 400) % 2 == 0 ? 10.0F : 0.0F;
    z[0] = nan;  // three of its neighbours are known
    const Pixels map = painted(field(400, 400, {}, {0, 1, 0, 400, 0, -1}), {100, 100}, z);
    EXPECT_EQ(map.at(50, 50), level_ground);
    EXPECT_NE(map.at(0, 0), paper);
}

}  // namespace
}  // namespace d2b::test
