#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dem2buildings/score.hpp"
#include "geometry/overlay.hpp"

namespace d2b::score {

/// Connected parts of a dissolved area; those that only touch in points are separate.
struct ScoredObjects {
    Polygons pieces;
    std::vector<double> areas;   ///< one per object, in square units of the coordinates
    std::vector<double> shared;  ///< area of each object covered by the other side
};

/// A found and a reference object that overlap.
struct ObjectPair {
    std::size_t found = 0;      ///< index in pieces
    std::size_t reference = 0;  ///< index in pieces
    double iou = 0;             ///< area of the intersection / area of the union
};

/// Objects of both sides and their overlaps.
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

/// Compares with a tolerance for rounding, because objects made of raster cells often meet thresholds
/// exactly.
[[nodiscard]] bool at_least(double value, double least);

/// Number of objects of at least the minimum area, and of those covered at least half by the other side.
struct ObjectCount {
    std::size_t large = 0;
    std::size_t covered = 0;
};
[[nodiscard]] ObjectCount count_objects(const ScoredObjects& objects, double min_area);

/// @return nullopt if there are no errors
[[nodiscard]] std::optional<HeightErrors> height_errors(std::span<const double> errors);

/// Height per object: area-weighted mean of the heights of the features in it.
/// @param heights one per feature @param areas one per feature, valid
/// @return one per object; nullopt unless it contains an interior point of a feature with a height
[[nodiscard]] std::vector<std::optional<double>> object_heights(
    std::span<const std::optional<double>> heights, std::span<const Polygons> areas, const Polygons& objects,
    Overlay& overlay);

}  // namespace d2b::score
