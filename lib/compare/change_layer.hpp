#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/find_changes.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::compare {

/// Fields of a change.
[[nodiscard]] std::vector<FieldSpec> change_fields();
/// Values of the fields. @param id of the change
[[nodiscard]] std::vector<FieldValue> change_values(const ChangedBuilding& building, std::int64_t id,
                                                    const SurveyedPlace& old_place,
                                                    const SurveyedPlace& new_place);
/// Colours of the changes.
[[nodiscard]] LayerStyle change_style();

/// Layer of changes. @param name of the layer
[[nodiscard]] LayerSpec change_layer(const std::string& name, const std::string& old_dataset,
                                     const std::string& new_dataset);

/// Adds all changes to a sink after begin(). Geometries are those of the new survey, and of the old one for
/// buildings that are gone.
void write_changes(const SurveyChanges& changes, const SurveyedPlace& old_place,
                   const SurveyedPlace& new_place, FeatureSink& sink);

}  // namespace d2b::compare
