#include <algorithm>
#include <array>
#include <cmath>

#include "cli/option_effect.hpp"
#include "cli/read_obj.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

/// 340 x 180 cells of half a metre; two houses of 60 x 60 m, 10 m high, a metre apart; the second one has a
/// step of half a metre in its southern wall.
RasterSpec two_houses() {
    constexpr std::size_t rows = 180;
    constexpr std::size_t cols = 340;
    RasterSpec spec = town_raster(std::vector<double>(rows * cols, 100));
    spec.rows = rows;
    spec.cols = cols;
    spec.transform = std::array<double, 6>{391000, 0.5, 0, 5820000, 0, -0.5};
    const auto put = [&](std::size_t row, std::size_t col, std::size_t height, std::size_t width) {
        for (std::size_t r = row; r < row + height; ++r)
            for (std::size_t c = col; c < col + width; ++c)
                spec.values[r * cols + c] = 110;
    };
    put(30, 40, 120, 120);
    put(30, 162, 120, 120);
    put(150, 162, 1, 60);
    return spec;
}

/// Between corners: where a wall goes straight on it does not end.
double shortest_wall(const Layer& layer) {
    double shortest = 1000;
    for (const Record& record : layer.records) {
        OGRGeometryH ring = OGR_G_GetGeometryRef(OGR_G_GetGeometryRef(record.geometry(), 0), 0);
        const int count = OGR_G_GetPointCount(ring) - 1;
        const auto side = [&](int i) {
            const int from = (i + count) % count;
            return std::array{OGR_G_GetX(ring, from + 1) - OGR_G_GetX(ring, from),
                              OGR_G_GetY(ring, from + 1) - OGR_G_GetY(ring, from)};
        };
        const auto turns = [&](int i) {
            const auto [x1, y1] = side(i - 1);
            const auto [x2, y2] = side(i);
            return std::abs(std::atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)) > 0.01;
        };
        for (int i = 0; i < count; ++i)
            if (turns(i) && turns(i + 1))
                shortest = std::min(shortest, std::hypot(side(i)[0], side(i)[1]));
    }
    return shortest;
}

double gap(const Layer& layer) {
    return OGR_G_Distance(layer.records.at(0).geometry(), layer.records.at(1).geometry());
}

}  // namespace

TEST_F(OptionEffect, flow_ready) {
    write(path("houses.tif"), two_houses());
    const auto houses = [&](const Arguments& more) {
        Arguments all{"-preset", "buildings", "-q", "-overwrite", "-regularize", "off", "-write_problems"};
        all.insert(all.end(), more.begin(), more.end());
        all.insert(all.end(), {"--", "houses.tif", "out.gpkg"});
        run_well(all);
        EXPECT_EQ(buildings().records.size(), 2U);
        return buildings();
    };
    const Layer as_found = houses({"-surface", "s.obj"});
    EXPECT_EQ(gap(as_found), 1);
    EXPECT_EQ(shortest_wall(as_found), 0.5);
    const Layer ready = houses({"-flow_ready", "1.5"});
    EXPECT_EQ(gap(ready), 0);
    EXPECT_GE(shortest_wall(ready), 1.5);
    const Layer problems = layer("out.gpkg", "problems");
    ASSERT_GE(problems.records.size(), 2U);
    for (const Record& problem : problems.records) {
        EXPECT_EQ(problem.text("state"), "changed");
        EXPECT_LE(problem.number("before"), 1.5);
    }
}

TEST_F(OptionEffect, min_gap) {
    write(path("houses.tif"), two_houses());
    run_well({"-preset", "buildings", "-q", "-overwrite", "-min_gap", "1.5", "--", "houses.tif", "out.gpkg"});
    EXPECT_EQ(gap(buildings()), 0);
    run_well({"-preset", "buildings", "-q", "-overwrite", "-min_gap", "0.5", "--", "houses.tif", "out.gpkg"});
    EXPECT_NEAR(gap(buildings()), 1, 0.1);
}

TEST_F(OptionEffect, min_wall) {
    write(path("houses.tif"), two_houses());
    run_well({"-preset", "buildings", "-q", "-overwrite", "-regularize", "off", "-min_wall", "0.6", "--",
              "houses.tif", "out.gpkg"});
    EXPECT_GT(gap(buildings()), 0);
    EXPECT_GE(shortest_wall(buildings()), 0.6);
}

}  // namespace d2b::test
