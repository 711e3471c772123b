#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "detect/object_features.hpp"

namespace d2b::detect {
namespace {

// Buildings of the cities in docs/accuracy.md have walls on at least a quarter of their border, mostly on all
// of it; slopes mistaken for buildings have none. Walls blurred over so many cells that nothing bends are
// still steeper than the roof, whereas a slope falls at its border as it does within.
constexpr double fewest_walls = 0.1;
constexpr double steeper = 1.2;

// The crest of a bank bends like a wall, but soil does not lie steeper than about 40 degrees. Coarse cells
// have no steeper walls either if these are low, but fall by the whole of their height from cell to cell.
// Only large objects are banks, because the blurred walls of small houses are no steeper.
constexpr double steepest_bank = 0.8;
constexpr double mostly_walls = 0.5;
constexpr double least_wall_m = 2;

// Larger objects are more likely to be buildings up to this size; woods are larger than houses.
constexpr double house_m2 = 300;

// Small houses are compact, but large buildings may have wings and yards, so compactness counts less from the
// first size on, and nothing from the second on.
constexpr double compact_m2 = 150;
constexpr double winged_m2 = 300;

// Fitted by tests/accuracy/run.py --learn, see docs/accuracy.md.
constexpr double sparse_constant = -0.89;

/// Log compactness relative to the value that is equally common among trees; 0 if uninformative. Objects more
/// compact than a rectangle are round, which is no evidence for a building.
double log_compactness_of(const ObjectFeatures& features) {
    constexpr double rectangle = 3 / std::numbers::pi;
    constexpr double most_ragged = -0.4;
    const double small = std::clamp((winged_m2 - features.area_m2) / (winged_m2 - compact_m2), 0.0, 1.0);
    const double compactness = std::min(features.compactness, rectangle);
    return small * std::max(std::log(compactness / neutral_compactness), most_ragged);
}

bool has_walls(const ObjectFeatures& features) {
    const bool is_bank = features.area_m2 >= house_m2 && features.fall < steepest_bank &&
                         (features.walled < mostly_walls || features.wall_m < least_wall_m);
    return !is_bank && (features.walled >= fewest_walls || features.fall > steeper * features.tilt);
}

/// Weight of a term, and the feature value at which the term is 0.
struct Weight {
    double of = 0;
    double zero_at = 0;

    [[nodiscard]] double term(double value) const { return of * (value - zero_at); }
};

/// Term of the logistic model: a feature value, and its weights for usual data and for sparse points.
struct Term {
    double value;
    CounterEvidence doubt;
    Weight usual;
    Weight sparse;

    [[nodiscard]] double term(double sparseness) const {
        return (1 - sparseness) * usual.term(value) + sparseness * sparse.term(value);
    }
    [[nodiscard]] bool is_inactive(double sparseness) const {
        return (usual.of == 0 || sparseness == 1) && (sparse.of == 0 || sparseness == 0);
    }
};

constexpr std::size_t terms_of_a_sum = 11;
// Indices into the terms.
constexpr std::size_t greenness = 1;
constexpr std::size_t segment_size = 4;
constexpr std::size_t squareness = 8;
constexpr std::size_t form = 10;

/// Each term is 0 for an object that is equally likely to be a tree.
std::array<Term, terms_of_a_sum> terms_of(const ObjectFeatures& features) {
    return {{
        {features.smooth, CounterEvidence::rough, {4.3, 0.4}, {}},
        {features.green, CounterEvidence::green, {-4, 0}, {-4, 0}},
        {std::log(std::max(features.step_m, 0.1)), CounterEvidence::no_step, {1.3, std::log(2.2)}, {}},
        {std::log(features.tilt), CounterEvidence::steep, {-0.4, std::log(0.4)}, {}},
        {std::log(std::max(features.segment, 1.0)),
         CounterEvidence::pieces,
         {1, std::log(48.0)},
         {1.04, 2.61}},
        {features.walled, CounterEvidence::no_step, {}, {10.16, 0.99}},
        {std::log(features.beside_m + 0.5), CounterEvidence::no_step, {}, {-0.5, 1.34}},
        {std::log(std::min(features.area_m2, house_m2)), CounterEvidence::pieces, {}, {1.68, 5.01}},
        {features.right_angles, CounterEvidence::no_right_angles, {2.5, neutral_right_angles}, {3.47, 0.33}},
        {features.low_slope_ratio, CounterEvidence::rough, {}, {8.5, 0.59}},
        {log_compactness_of(features), CounterEvidence::ragged, {}, {3, 0}},
    }};
}

}  // namespace

DetectedObject classify(const ObjectFeatures& features, double filled) {
    if (!has_walls(features))
        return {0, CounterEvidence::no_step, 0};
    const double sparse = sparseness(filled);
    const std::array<Term, terms_of_a_sum> model_terms = terms_of(features);
    std::array<double, terms_of_a_sum> terms{};
    std::ranges::transform(model_terms, terms.begin(),
                           [&](const Term& model_term) { return model_term.term(sparse); });
    double sum = sparse * sparse_constant;
    for (const double term : terms)
        sum += term;
    // Ignores terms that took no part: those without weight, vegetation without (green) NDVI, and the
    // compactness of large objects.
    for (std::size_t i = 0; i < model_terms.size(); ++i)
        if (model_terms[i].is_inactive(sparse) || (i == greenness && features.green == 0) ||
            (i == form && model_terms[i].value == 0))
            terms[i] = std::numeric_limits<double>::infinity();
    const auto worst = std::min_element(terms.begin(), terms.end()) - terms.begin();
    return {1 / (1 + std::exp(-sum)), model_terms[static_cast<std::size_t>(worst)].doubt, 0};
}

double roof_score(const ObjectFeatures& part) {
    constexpr double of_segment_size = 0.25;
    const std::array<Term, terms_of_a_sum> model_terms = terms_of(part);
    double sum = 0;
    for (std::size_t i = 0; i < model_terms.size(); ++i)
        if (i != greenness && i != squareness)
            sum +=
                (i == segment_size ? of_segment_size : 1) * model_terms[i].usual.term(model_terms[i].value);
    return sum;
}

std::string_view counter_evidence_name(CounterEvidence doubt) {
    switch (doubt) {
        case CounterEvidence::rough:
            return "rough surface";
        case CounterEvidence::no_step:
            return "no step at its border";
        case CounterEvidence::steep:
            return "steep";
        case CounterEvidence::pieces:
            return "small pieces";
        case CounterEvidence::green:
            return "green";
        case CounterEvidence::no_right_angles:
            return "no right angles";
        case CounterEvidence::ragged:
            return "ragged form";
        case CounterEvidence::bridge:
            return "bridge";
        case CounterEvidence::ground:
            return "taken for ground";
    }
    return "";
}

}  // namespace d2b::detect
