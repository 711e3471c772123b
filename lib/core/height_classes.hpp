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
/// "below 3 m", "3 to 6 m", "100 m and more"
[[nodiscard]] std::string class_label(std::size_t index);

}  // namespace d2b
