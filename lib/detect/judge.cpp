#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "detect/evidence.hpp"

namespace d2b {
namespace {

// Buildings of the cities in docs/accuracy.md have walls on a quarter of their border and more, mostly on all
// of it; a slope that was taken for one has none. Where walls are smeared over so many cells that nothing
// bends, they are steeper than the roof all the same, and a slope falls at its border as it does within.
constexpr double fewest_walls = 0.1;
constexpr double steeper = 1.2;

// Of scans of a pulse a square metre and more on cells of a metre less than the first share of the cells is
// filled, of thinned ones more than the second.
constexpr double filled_by_any = 0.04;
constexpr double filled_where_thin = 0.08;

// Up to this the larger is the likelier a building; woods are larger than houses.
constexpr double house_m2 = 300;

// A small house is compact. The larger a building, the more wings and yards it may have: from the first size
// on that says less, from the second on nothing.
constexpr double compact_m2 = 150;
constexpr double winged_m2 = 300;

// Found by tests/accuracy/run.py --learn, see docs/accuracy.md.
constexpr double thin_constant = -0.89;

/// What the form of an object says, as a logarithm; 0 where it is as much a tree's. What is more compact than
/// a rectangle is round, which speaks for nothing.
double form_of(const Evidence& evidence) {
    constexpr double rectangle = 3 / std::numbers::pi;
    constexpr double most_ragged = -0.4;
    const double small = std::clamp((winged_m2 - evidence.area_m2) / (winged_m2 - compact_m2), 0.0, 1.0);
    const double compactness = std::min(evidence.compactness, rectangle);
    return small * std::max(std::log(compactness / even_compactness), most_ragged);
}

bool has_walls(const Evidence& evidence) {
    return evidence.walled >= fewest_walls || evidence.fall > steeper * evidence.tilt;
}

/// A weight, and where it says nothing.
struct Weight {
    double of = 0;
    double zero_at = 0;

    [[nodiscard]] double term(double value) const { return of * (value - zero_at); }
};

/// Something that is seen of an object, and what it weighs in usual data and where points are thin.
struct Sight {
    double value;
    Doubt doubt;
    Weight usual;
    Weight thin;

    [[nodiscard]] double term(double thinness) const {
        return (1 - thinness) * usual.term(value) + thinness * thin.term(value);
    }
    [[nodiscard]] bool says_nothing(double thinness) const {
        return (usual.of == 0 || thinness == 1) && (thin.of == 0 || thinness == 0);
    }
};

constexpr std::size_t terms_of_a_sum = 11;
// Places among them.
constexpr std::size_t greenness = 1;
constexpr std::size_t segment_size = 4;
constexpr std::size_t squareness = 8;
constexpr std::size_t form = 10;

/// Each term is 0 for an object that may as well be a tree.
std::array<Sight, terms_of_a_sum> sights_of(const Evidence& evidence) {
    return {{
        {evidence.smooth, Doubt::rough, {4.3, 0.4}, {}},
        {evidence.green, Doubt::green, {-4, 0}, {-4, 0}},
        {std::log(std::max(evidence.step_m, 0.1)), Doubt::no_step, {1.3, std::log(2.2)}, {}},
        {std::log(evidence.tilt), Doubt::steep, {-0.4, std::log(0.4)}, {}},
        {std::log(std::max(evidence.segment, 1.0)), Doubt::pieces, {1, std::log(48.0)}, {1.04, 2.61}},
        {evidence.walled, Doubt::no_step, {}, {10.16, 0.99}},
        {std::log(evidence.beside_m + 0.5), Doubt::no_step, {}, {-0.5, 1.34}},
        {std::log(std::min(evidence.area_m2, house_m2)), Doubt::pieces, {}, {1.68, 5.01}},
        {evidence.right_angles, Doubt::no_right_angles, {2.5, even_right_angles}, {3.47, 0.33}},
        {evidence.gentle, Doubt::rough, {}, {8.5, 0.59}},
        {form_of(evidence), Doubt::ragged, {}, {3, 0}},
    }};
}

}  // namespace

DetectedObject judge(const Evidence& evidence, double filled) {
    if (!has_walls(evidence))
        return {0, Doubt::no_step, 0};
    const double thinness =
        std::clamp((filled - filled_by_any) / (filled_where_thin - filled_by_any), 0.0, 1.0);
    const std::array<Sight, terms_of_a_sum> sights = sights_of(evidence);
    std::array<double, terms_of_a_sum> terms{};
    std::ranges::transform(sights, terms.begin(), [&](const Sight& sight) { return sight.term(thinness); });
    double sum = thinness * thin_constant;
    for (const double term : terms)
        sum += term;
    // What has no weight says nothing; without an NDVI, and where nothing is green, nothing green does, nor
    // does the form of what is large.
    for (std::size_t i = 0; i < sights.size(); ++i)
        if (sights[i].says_nothing(thinness) || (i == greenness && evidence.green == 0) ||
            (i == form && sights[i].value == 0))
            terms[i] = std::numeric_limits<double>::infinity();
    const auto worst = std::min_element(terms.begin(), terms.end()) - terms.begin();
    return {1 / (1 + std::exp(-sum)), sights[static_cast<std::size_t>(worst)].doubt, 0};
}

double roof_likeness(const Evidence& part) {
    constexpr double of_segment_size = 0.25;
    const std::array<Sight, terms_of_a_sum> sights = sights_of(part);
    double sum = 0;
    for (std::size_t i = 0; i < sights.size(); ++i)
        if (i != greenness && i != squareness)
            sum += (i == segment_size ? of_segment_size : 1) * sights[i].usual.term(sights[i].value);
    return sum;
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
        case Doubt::no_right_angles:
            return "no right angles";
        case Doubt::ragged:
            return "ragged form";
    }
    return "";
}

}  // namespace d2b
