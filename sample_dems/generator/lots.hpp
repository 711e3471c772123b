#pragma once

#include <vector>

#include "site.hpp"

namespace d2b::sample {

/// A site of a scene around a place, turned by less than a right angle.
[[nodiscard]] Site site_around(Scene& scene, Random& random, const Position& centre, const Direction& x_axis,
                               double width, double depth);

/// Lots on both sides of a street along the middle of a site. All lie with their first corner at the street.
/// @param narrowest,widest metres along the street
[[nodiscard]] std::vector<Site> lots_along(const Site& site, double narrowest, double widest);

/// Houses of one height that share walls, side by side on parcels from the street at the site's lower side to
/// its upper side. A raster cannot show the walls between them.
void build_parcelled_row(const Site& site);

}  // namespace d2b::sample
