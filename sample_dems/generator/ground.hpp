#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plane.hpp"

namespace d2b::sample {

/// Smooth noise in [0, 1]: random values at the points of a square lattice, joined with two continuous
/// derivatives.
/// @param wavelength the lattice's spacing in metres
[[nodiscard]] double value_noise(std::uint64_t seed, double wavelength, const Position& p);

/// A level place for a large building, with banks around it.
struct Terrace {
    Frame frame;
    Rect rect;
    double elevation = 0;
    double bank = 6;  ///< metres from the rectangle to where the ground is as it was
};

/// A ditch along a line.
struct Creek {
    std::vector<Position> line;
    double depth = 4;
    double half_width = 14;
};

/// The bare earth, as a function of position and a seed. Elevations in metres.
struct Ground {
    std::uint64_t seed = 0;
    double base = 0;
    double slope_x = 0;  ///< rise per metre to the east
    double slope_y = 0;  ///< rise per metre to the north
    double relief = 0;   ///< about the height of the hills
    std::vector<Terrace> terraces;
    std::vector<Creek> creeks;  ///< with a negative depth a dike
    double furrow = 0;          ///< depth of furrows in metres; every second field of 180 x 240 m has them

    [[nodiscard]] double at(const Position& p) const;
    /// Levels a place at the elevation that its centre has now.
    void level(const Frame& frame, const Rect& rect);
};

}  // namespace d2b::sample
