#include "compare/change_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "core/text.hpp"

namespace d2b::compare {

std::vector<FieldSpec> change_fields() {
    return {
        {"id", "Number", FieldType::integer, "", "number in this layer, from 1"},
        {"change", "Change", FieldType::text, "",
         "new, gone, raised or lowered (rise by more than 2 m), grown or shrunk (area by more than 10 % and "
         "20 m2), same"},
        {"old_id", "Old building", FieldType::integer, "",
         "id of the building in the old survey, of several that of the largest; NULL if it has "
         "none"},
        {"new_id", "New building", FieldType::integer, "",
         "id of the building in the new survey, of several that of the largest; NULL if it has "
         "none"},
        {"n_old", "Old buildings", FieldType::integer, "", "buildings of the old survey that it consists of"},
        {"n_new", "New buildings", FieldType::integer, "", "buildings of the new survey that it consists of"},
        {"p90_old", "Old height (m)", FieldType::real, "m",
         "height above ground that 90 % of the points do not exceed, in the old survey"},
        {"p90_new", "New height (m)", FieldType::real, "m",
         "height above ground that 90 % of the points do not exceed, in the new survey"},
        {"rise", "Rise (m)", FieldType::real, "m",
         "change of the height: the median of the changes of p50, p70 and p90, because crowns over a roof "
         "change "
         "p90 alone"},
        {"area_old", "Old area (m2)", FieldType::real, "m2",
         "area in the old survey, of all its parts, where both surveys have data"},
        {"area_new", "New area (m2)", FieldType::real, "m2",
         "area in the new survey, of all its parts, where both surveys have data"},
        {"confidence", "Confidence", FieldType::real, "",
         "lowest certainty that its parts in both surveys are buildings, 0 to 1"},
    };
}

namespace {

FieldValue measured(double value) {
    return std::isnan(value) ? FieldValue{} : FieldValue{round_to_hundredths(value)};
}

FieldValue certainty(double value) {
    return std::isnan(value) ? FieldValue{} : FieldValue{floor_to_hundredths(value)};
}

FieldValue count(std::span<const std::size_t> indices) {
    return static_cast<std::int64_t>(indices.size());
}

FieldValue largest_id(const SurveyedPlace& place, std::span<const std::size_t> indices) {
    if (indices.empty())
        return {};
    const auto largest =
        std::ranges::max_element(indices, {}, [&](std::size_t i) { return place.buildings[i].area_m2; });
    return place.buildings[*largest].id;
}

std::vector<WorldPolygon> outline_of(const SurveyedPlace& place, std::span<const std::size_t> indices) {
    std::vector<WorldPolygon> outline;
    for (const std::size_t i : indices)
        std::ranges::copy(place.buildings[i].written, std::back_inserter(outline));
    return outline;
}

}  // namespace

LayerSpec change_layer(const std::string& name, const std::string& old_dataset,
                       const std::string& new_dataset) {
    LayerSpec spec{name, "Changes",
                   "Changes of buildings from " + utf8_text(old_dataset) + " to " + utf8_text(new_dataset),
                   change_fields()};
    spec.style = change_style();
    return spec;
}

LayerStyle change_style() {
    LayerStyle style;
    style.title = "Change";
    style.classified = "change";
    // Colours of pairs that colour-blind readers tell apart; that of the buildings that stay is the palest.
    constexpr std::array<const char*, change_names.size()> colours{
        "0,114,178,255",  "213,94,0,255",   "0,158,115,255",  "204,121,167,255",
        "86,180,233,255", "240,228,66,255", "225,225,225,255"};
    for (std::size_t i = 0; i < colours.size(); ++i)
        style.classes.push_back({std::string(change_names[i]), colours[i]});
    return style;
}

std::vector<FieldValue> change_values(const ChangedBuilding& building, std::int64_t id,
                                      const SurveyedPlace& old_place, const SurveyedPlace& new_place) {
    return {id,
            std::string(change_names[static_cast<std::size_t>(building.change)]),
            largest_id(old_place, building.old_indices),
            largest_id(new_place, building.new_indices),
            count(building.old_indices),
            count(building.new_indices),
            measured(building.p90_old_m),
            measured(building.p90_new_m),
            measured(building.rise_m),
            measured(building.area_old_m2),
            measured(building.area_new_m2),
            certainty(building.confidence)};
}

void write_changes(const SurveyChanges& changes, const SurveyedPlace& old_place,
                   const SurveyedPlace& new_place, FeatureSink& sink) {
    std::int64_t id = sink.first_id();
    for (const ChangedBuilding& building : changes.buildings) {
        Feature feature;
        feature.values = change_values(building, id++, old_place, new_place);
        feature.parts = building.new_indices.empty() ? outline_of(old_place, building.old_indices)
                                                     : outline_of(new_place, building.new_indices);
        sink.add(0, feature);
    }
}

}  // namespace d2b::compare
