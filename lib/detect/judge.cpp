#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "detect/evidence.hpp"

namespace d2b {
namespace {

// Buildings of the cities in docs/accuracy.md have walls on a quarter of their border and more, mostly on all
// of it; a slope that was taken for one has none. Where walls are smeared over so many cells that nothing
// bends, they are steeper than the roof all the same, and a slope falls at its border as it does within.
constexpr double fewest_walls = 0.1;
constexpr double steeper = 1.2;

bool has_walls(const Evidence& evidence) {
    return evidence.walled >= fewest_walls || evidence.fall > steeper * evidence.tilt;
}

}  // namespace

DetectedObject judge(const Evidence& evidence) {
    if (!has_walls(evidence))
        return {0, Doubt::no_step, 0};
    // Each term is 0 for an object that may as well be a tree.
    std::array<double, 5> terms{4.3 * (evidence.smooth - 0.4), -4.0 * evidence.green,
                                1.3 * std::log(std::max(evidence.step_m, 0.1) / 2.2),
                                -0.4 * std::log(evidence.tilt / 0.4),
                                1.0 * std::log(std::max(evidence.segment, 1.0) / 48.0)};
    constexpr std::array<Doubt, 5> doubts{Doubt::rough, Doubt::green, Doubt::no_step, Doubt::steep,
                                          Doubt::pieces};
    double sum = 0;
    for (const double term : terms)
        sum += term;
    // Without an NDVI, and where nothing is green, nothing green speaks against it.
    if (evidence.green == 0)
        terms[1] = std::numeric_limits<double>::infinity();
    const auto worst = std::min_element(terms.begin(), terms.end()) - terms.begin();
    return {1 / (1 + std::exp(-sum)), doubts[static_cast<std::size_t>(worst)], 0};
}

std::string_view doubt_name(Doubt doubt) {
    switch (doubt) {
        case Doubt::rough:
            return "rough surface";
        case Doubt::no_step:
            return "no step at its border";
        case Doubt::steep:
            return "steep";
        case Doubt::pieces:
            return "small pieces";
        case Doubt::green:
            return "green";
    }
    return "";
}

}  // namespace d2b
