#pragma once

#include <cstddef>
#include <span>

#include "draft.hpp"
#include "random.hpp"
#include "scene.hpp"

namespace d2b::sample {

/// Metres from the edge of a site to the fronts of houses with gardens.
inline constexpr double pavement = 4;

/// A rectangle of land between streets that is to be built over; its frame has the lower left corner as
/// origin.
struct Site {
    Scene& scene;
    Random& random;
    Frame frame;
    double width = 0;
    double depth = 0;

    [[nodiscard]] Rect rect() const { return {0, 0, width, depth}; }
    [[nodiscard]] Site part(const Rect& rect) const {
        return {scene, random, frame.moved({rect.x0, rect.y0}), rect.width(), rect.depth()};
    }
    /// Places drafts that touch, in this site's frame.
    void build(std::span<Draft> drafts) const;
    /// A plot of land that belongs to a house, in this site's frame.
    void add_plot(const WorldPolygon& local) const;
    /// @param height of the tree in metres; the crown follows
    void plant(const Position& local, double height, bool conifer, std::size_t first_building) const;
    /// Trees and bushes at random places of a garden.
    void plant_garden(const Rect& garden, int count, std::size_t first_building) const;
};

/// Builders of sites, by kind of quarter.
void build_perimeter(const Site& site);  ///< closed blocks around courtyards
void build_rows(const Site& site);       ///< terraces of houses that share walls
void build_villas(const Site& site);     ///< single houses in gardens
void build_slabs(const Site& site);      ///< large flat-roofed buildings on lawns
void build_works(const Site& site);      ///< halls and silos
void build_park(const Site& site);       ///< a wood or meadows with trees
void build_church(const Site& site);     ///< a church on a square

/// Parked cars and trees along the lower and the left side of a site.
void furnish_street(const Site& site);

}  // namespace d2b::sample
