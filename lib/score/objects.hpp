#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/overlay.hpp"

namespace d2b {

/// The connected pieces of a dissolved area; those that only touch in points are separate.
struct ScoredObjects {
    Polygons pieces;
    std::vector<double> areas;   ///< one a piece, in square units of the coordinates
    std::vector<double> shared;  ///< what the other side covers of each
};

/// A found and a reference object that share an area.
struct ObjectPair {
    std::size_t found = 0;      ///< index of the piece
    std::size_t reference = 0;  ///< index of the piece
    double iou = 0;             ///< area of the intersection / area of the union
};

/// Two sides of a comparison, and what they share.
struct Comparison {
    ScoredObjects found;
    ScoredObjects reference;
    double found_area = 0;
    double reference_area = 0;
    double shared_area = 0;
    std::vector<ObjectPair> pairs;
};

/// @param found dissolved @param reference dissolved
[[nodiscard]] Comparison compare(Polygons found, Polygons reference, Overlay& overlay);

/// Whether an area or a share is as large as it has to be. What follows the cells of one raster is often so
/// exactly, and must not depend on how coordinates were rounded.
[[nodiscard]] bool reaches(double value, double least);

/// How many objects are at least so large, and of how many of these the other side covers at least half.
struct ObjectCount {
    std::size_t large = 0;
    std::size_t covered = 0;
};
[[nodiscard]] ObjectCount count_objects(const ScoredObjects& objects, double min_area);

}  // namespace d2b
