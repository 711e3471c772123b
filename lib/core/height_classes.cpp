#include "core/height_classes.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"

namespace d2b {
namespace {

// From light to dark, which also works in print and for colour-blind readers. Storeys first, then the classes
// of planners: low, middle, high, tower.
constexpr std::array<HeightClass, 9> fixed_classes{{{0, {255, 255, 204}},
                                                    {3, {255, 237, 160}},
                                                    {6, {254, 217, 118}},
                                                    {10, {254, 178, 76}},
                                                    {15, {253, 141, 60}},
                                                    {20, {252, 78, 42}},
                                                    {30, {227, 26, 28}},
                                                    {50, {189, 0, 38}},
                                                    {100, {128, 0, 38}}}};

}  // namespace

std::span<const HeightClass> height_classes() {
    return fixed_classes;
}

std::size_t height_class_of(double height_m) {
    std::size_t found = 0;
    while (found + 1 < fixed_classes.size() && height_m >= fixed_classes[found + 1].from)
        ++found;
    return found;
}

double overlay_opacity(double certainty, double certain) {
    constexpr UncertaintyOverlay veil;
    const double share = std::clamp((certainty - veil.low) / (certain - veil.low), 0.0, 1.0);
    return (veil.most + (veil.least - veil.most) * share) / 255;
}

std::string class_label(std::span<const HeightClass> classes, std::size_t index) {
    if (index == 0)
        return "below " + number_text(classes[1].from) + " m";
    if (index + 1 == classes.size())
        return number_text(classes[index].from) + " m and more";
    return number_text(classes[index].from) + " to " + number_text(classes[index + 1].from) + " m";
}

std::string class_label(std::size_t index) {
    return class_label(fixed_classes, index);
}

std::vector<HeightClass> quantile_classes(std::vector<double> heights_m) {
    constexpr std::size_t count = 5;
    constexpr std::size_t colours = 2;  // every other fixed class
    if (heights_m.size() < 2 * count)
        return {};
    std::ranges::sort(heights_m);
    std::vector<HeightClass> found{{0, fixed_classes[0].colour}};
    for (std::size_t i = 1; i < count; ++i) {
        const double bound = std::round(heights_m[heights_m.size() * i / count] * 10) / 10;
        if (bound > found.back().from && bound > heights_m.front())
            found.push_back({bound, fixed_classes[i * colours].colour});
    }
    return found.size() > 1 ? found : std::vector<HeightClass>{};
}

}  // namespace d2b
