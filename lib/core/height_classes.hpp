#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace d2b {

/// Heights of one colour in the legends of maps and pictures: from `from` m to the next class's, the last
/// without end. Fixed, so that maps of two cities, or of two runs, can be laid side by side.
struct HeightClass {
    double from;
    std::array<unsigned char, 3> colour;
};
[[nodiscard]] std::span<const HeightClass> height_classes();
/// The class of a height; the first one also for heights below 0.
[[nodiscard]] std::size_t height_class_of(double height_m);
/// What is not certain is paler: how opaque the white is that lies over its colour, from 0 to 255.
struct Veil {
    double low = 0.5;  ///< certainty from which on down there is most
    double most = 170;
    double least = 70;  ///< where it is nearly certain
};
/// Of 1. @param certainty below `certain`, both from 0 to 1
[[nodiscard]] double opacity_of_veil(double certainty, double certain);

/// "below 3 m", "3 to 6 m", "100 m and more"
[[nodiscard]] std::string class_label(std::size_t index);

}  // namespace d2b
