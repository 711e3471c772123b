#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace d2b {

/// Colour classes of heights for maps and pictures: each extends from `from` m to the next class, the last
/// one is unbounded. Fixed, so that maps of two cities or of two runs are comparable.
struct HeightClass {
    double from;
    std::array<unsigned char, 3> colour;
};
[[nodiscard]] std::span<const HeightClass> height_classes();
/// Returns the class of a height; heights below 0 belong to the first one.
[[nodiscard]] std::size_t height_class_of(double height_m);
/// White overlay that makes uncertain features paler: its opacity from 0 to 255.
struct UncertaintyOverlay {
    double low = 0.5;  ///< certainty at and below which the opacity is highest
    double most = 170;
    double least = 70;  ///< opacity just below certain
};
/// Returns the opacity from 0 to 1. @param certainty below `certain`, both from 0 to 1
[[nodiscard]] double overlay_opacity(double certainty, double certain);

/// Returns "below 3 m", "3 to 6 m" or "100 m and more".
[[nodiscard]] std::string class_label(std::size_t index);
/// Returns the same for other classes.
[[nodiscard]] std::string class_label(std::span<const HeightClass> classes, std::size_t index);

/// Returns five classes that hold about the same number of heights each, for data that lie in few of the
/// fixed classes. Bounds are rounded to tenths; fewer classes if bounds coincide, none for fewer than ten
/// heights.
[[nodiscard]] std::vector<HeightClass> quantile_classes(std::vector<double> heights_m);

}  // namespace d2b
