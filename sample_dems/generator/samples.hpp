#pragma once

#include <string>

#include "render.hpp"
#include "town_plan.hpp"
#include "write_raster.hpp"

namespace d2b::sample {

/// A sample DEM: its scene and how it is sampled.
struct Sample {
    std::string name;  ///< of the file without extension, and of the layer of its truth
    RasterSpec raster;
    Scene scene;
};

/// The drawn grid with a round, an H-shaped and an L-shaped building.
[[nodiscard]] Sample drawn_grid();
/// An H-shaped hotel with a tower and bushes at its walls, in feet.
[[nodiscard]] Sample hotel();
/// A turned block with a courtyard on a slope.
[[nodiscard]] Sample courtyard();
/// A few houses in longitude and latitude.
[[nodiscard]] Sample degrees();
/// A building beside a lake and one at the raster's edge; without the lake.
[[nodiscard]] Sample lakeside();
/// Whether a point lies on the lake of lakeside().
[[nodiscard]] bool on_lake(const Position& p);
/// Whether a cell of lakeside() is NaN.
[[nodiscard]] bool is_hole(std::int32_t row, std::int32_t col);
/// The elevation in feet of point (row, col) of the 11 x 7 points of the worked example.
[[nodiscard]] float example_elevation(std::int32_t row, std::int32_t col);
/// The plan of town().
[[nodiscard]] TownPlan town_plan();
/// Its seed, noise and bare ground: a scene to which nothing was added yet.
[[nodiscard]] Scene town_ground();
/// A square kilometre of a town.
[[nodiscard]] Sample town();

/// Writes all samples and their truth into a folder that exists. @throws OutputError
void make_samples(const std::string& folder);

}  // namespace d2b::sample
