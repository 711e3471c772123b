#pragma once

#include "site.hpp"

namespace d2b::sample {

/// A house of 60 to 150 m2 somewhere on a lot, perhaps with a garage; the first corner of the lot is at its
/// street.
void build_home(const Site& lot);
/// A shed of 6 to 20 m2 in a back corner.
void build_shed(const Site& lot);

/// Bushes side by side, as high as a hedge, from one place of a site to another.
void plant_hedge(const Site& site, const Position& from, const Position& to, double height);
/// Hedges around a lot, open to the street; none on some sides.
void plant_hedges(const Site& lot);
/// A tree close to a wall of each of the buildings from `first` on, by chance: its crown leans on the roof.
void plant_at_walls(const Site& site, std::size_t first, double probability);
/// A tree every `spacing` metres or so where no building stands: its crown may lean on one.
void plant_wood(const Site& site, double spacing, double low, double high, double conifers);
/// Fruit trees in rows.
void plant_orchard(const Site& site, const Rect& rect, std::size_t first);

}  // namespace d2b::sample
