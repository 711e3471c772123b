#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "building.hpp"
#include "ground.hpp"

namespace d2b::sample {

/// A crown as a laser sees it from above: ragged, with gaps. A function of position and the tree's seed.
struct Tree {
    Position trunk;
    double ground = 0;  ///< elevation in metres
    double height = 8;
    double radius = 3;
    bool conifer = false;
    std::uint64_t seed = 0;

    [[nodiscard]] std::optional<double> elevation_at(const Position& p) const;
    /// Height at which a crown returns a pulse: somewhere below its hull, mostly near it. Empty if the pulse
    /// finds a gap.
    /// @param draw a number of the pulse's own
    [[nodiscard]] std::optional<double> first_return(const Position& p, std::uint64_t draw) const;
};

/// Cars, hedges, walls and bridges: a box whose top runs from one elevation to another along the frame's x
/// axis.
struct Block {
    Frame frame;
    Rect rect;
    double elevation_start = 0;
    double elevation_end = 0;

    [[nodiscard]] std::optional<double> elevation_at(const Position& p) const;
};

/// A plot of land with a house of a terrace.
struct Parcel {
    std::string name;
    WorldPolygon polygon;  ///< scene coordinates; neighbours share their corners
};

/// All things that stand in some area. Parts of a scene can be made and rendered alone: the elevation of a
/// cell depends on the things that cover it, not on the order or the number of others.
struct Scene {
    std::uint64_t seed = 0;
    Ground ground;
    double noise = 0;  ///< standard deviation of the elevations in metres
    std::vector<Building> buildings;
    std::vector<Tree> trees;
    std::vector<Block> blocks;
    std::vector<Parcel> parcels;

    /// Puts a building on the ground.
    Building& add(const Draft& draft, const Frame& frame);
    /// Plants a tree unless its trunk would stand in one of the buildings from `first_building` on.
    void plant(Tree tree, std::size_t first_building);
    /// A box on the ground that follows its slope.
    void add_block(const Frame& frame, const Rect& rect, double height);
    /// Numbers the buildings from 1 in their present order.
    void number_buildings();
};

}  // namespace d2b::sample
