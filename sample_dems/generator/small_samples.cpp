#include <cmath>
#include <cstdlib>

#include "draft.hpp"
#include "samples.hpp"

namespace d2b::sample {

namespace {

Frame at(double x, double y) {
    return {{x, y}, {}};
}

/// Square cells, north up, from the upper left corner in the CRS.
Grid square_grid(std::int32_t cols, std::int32_t rows, double cell, double left, double top) {
    return {cols, rows, cell, cell, {left, cell, 0, top, 0, -cell}};
}

}  // namespace

float example_elevation(std::int32_t row, std::int32_t col) {
    if (row < 1 || row > 5 || col < 1 || col > 9)
        return 0;
    return row >= 2 && row <= 4 && col >= 3 && col <= 7 ? 50 : 40;
}

Sample drawn_grid() {
    Sample sample{"thesis_50x36", {square_grid(50, 36, 1, 424500, 4513536), {}, "EPSG:26912", {}, false}, {}};
    Scene& scene = sample.scene;
    scene.add(round_house("round", {12, 23}, 7, {Roof::flat, 12, 0}, 0), {});
    scene.add(h_house("H-shaped", {0, 0, 17, 20}, 5, {Roof::flat, 18, 0}), at(28, 13));
    scene.add(l_house("L-shaped", {0, 0, 18, 10}, 4, {Roof::flat, 8, 0}), at(5, 3));
    scene.number_buildings();
    return sample;
}

Sample courtyard() {
    Sample sample{
        "courtyard_utm", {square_grid(160, 140, 0.5, 689400, 5334770), {}, "EPSG:25832", {}, false}, {}};
    Scene& scene = sample.scene;
    scene.seed = 4;
    scene.noise = 0.02;
    scene.ground.base = 510;
    scene.ground.slope_x = 0.064;  // with 0.048 to the north: 8 % along (4, 3)
    scene.ground.slope_y = 0.048;
    const Frame frame{{40, 35}, {0.8910065241883679, 0.45399049973954675}};  // 27 degrees
    scene.add(court_house("courtyard block", {-21, -16, 21, 16}, 10, {Roof::gabled, 12, 0.8}), frame);
    scene.number_buildings();
    return sample;
}

Sample degrees() {
    // At 52 degrees north on WGS 84 one degree is 68678 m to the east and 111267 m to the north.
    const Grid grid{90, 80, 1.5e-5 * 68678, 1e-5 * 111267, {13.4, 1.5e-5, 0, 52.0008, 0, -1e-5}};
    Sample sample{"degrees", {grid, {}, "EPSG:4326", {}, false}, {}};
    Scene& scene = sample.scene;
    scene.seed = 6;
    scene.noise = 0.03;
    scene.ground = {6, 34, 0.01, -0.005, 1, {}, {}};
    scene.add(box_house("house", {0, 0, 14, 10}, {Roof::gabled, 6, 0.8}), at(12, 14));
    scene.add(l_house("L-shaped", {0, 0, 30, 24}, 10, {Roof::hipped, 9, 0.7}),
              {{50, 12}, Direction::from_half_tangent(0.15)});
    scene.add(box_house("slab", {0, 0, 44, 12}, {Roof::flat, 20, 0}),
              {{16, 56}, Direction::from_half_tangent(-0.1)});
    scene.add(round_house("silo", {78, 70}, 5, {Roof::cone, 15, 0}, 3), {});
    scene.plant({{36, 30}, 0, 11, 4, false, 0}, 0);
    scene.plant({{40, 40}, 0, 9, 3, true, 0}, 0);
    scene.number_buildings();
    return sample;
}

bool on_lake(const Position& p) {
    // An ellipse, cut off by a quay along x = 72.
    const double u = (p.x - 88) / 30;
    const double v = (p.y - 48) / 34;
    return p.x > 72 && u * u + v * v < 1;
}

bool is_hole(std::int32_t row, std::int32_t col) {
    // A gap between flight lines, and single cells.
    return (col == 30 && row >= 80 && row < 90) || (row % 23 == 7 && col % 29 == 11);
}

Sample lakeside() {
    Sample sample{"nodata", {square_grid(120, 100, 1, 391000, 5820100), {}, "EPSG:25833", -9999, false}, {}};
    Scene& scene = sample.scene;
    scene.seed = 7;
    scene.noise = 0.03;
    scene.ground = {7, 30, -0.02, 0, 1, {}, {}};
    scene.add(box_house("at the quay", {0, 0, 16, 30}, {Roof::flat, 11, 0}), at(56, 34));
    scene.add(box_house("at the edge", {0, 0, 18, 12}, {Roof::gabled, 7, 0.75}), at(0, 60));
    scene.add(u_house("U-shaped", {0, 0, 30, 22}, 8, {Roof::hipped, 8, 0.7}), at(12, 20));
    scene.number_buildings();
    return sample;
}

}  // namespace d2b::sample
