#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/record_builder.hpp"

namespace d2b::features {

/// Returns another program's name for a field of the buildings layer, or our own name if it has none.
[[nodiscard]] std::string_view field_name(FieldNames names, std::string_view own);

/// Confidence from which no counter-evidence is reported.
inline constexpr double sure_confidence = 0.9;

enum class AttributeUnit { none, vertical, metre, square_metre, cubic_metre };

/// Attribute of a record: the only place that defines its name, type, unit, description and value.
template <typename Record>
struct Attribute {
    std::string_view name;  ///< at most 10 ASCII characters
    std::string_view alias;
    FieldType type;
    AttributeUnit unit;
    std::string_view description;
    FieldValue (*value)(const Record&);
};

/// Attributes of buildings. Those of roofs exist only with -roofs, and the parcel only if parcels divide
/// buildings.
[[nodiscard]] std::span<const Attribute<BuildingRecord>> building_attributes(bool with_roof,
                                                                             bool with_parcel);
[[nodiscard]] inline std::span<const Attribute<BuildingRecord>> building_attributes(const Options& options) {
    // With given footprints, only these have roofs.
    return building_attributes(options.write.roofs && !options.write.has_footprints(),
                               options.detect.is_split_by());
}
/// Attributes of given footprints: those of buildings that do not concern the search and the outline, and
/// those of the fit.
[[nodiscard]] std::span<const Attribute<BuildingRecord>> given_attributes(bool with_roof);
[[nodiscard]] inline std::span<const Attribute<BuildingRecord>> given_attributes(const Options& options) {
    return given_attributes(options.write.roofs);
}
/// Returns the values of a given footprint. Without valid elevations only its id, area, perimeter and status
/// are known.
[[nodiscard]] std::vector<FieldValue> given_values(const Options& options, const BuildingRecord& record);
[[nodiscard]] std::span<const Attribute<RoofFaceRecord>> roof_face_attributes();
[[nodiscard]] std::span<const Attribute<ContourRecord>> contour_attributes();
[[nodiscard]] std::span<const Attribute<RejectedRecord>> rejected_attributes();
[[nodiscard]] std::span<const Attribute<ProblemRecord>> problem_attributes();

/// Describes the attributes as fields of a layer. @param vertical_unit name of the DEM's vertical unit
template <typename Record>
[[nodiscard]] std::vector<FieldSpec> field_specs(std::span<const Attribute<Record>> attributes,
                                                 const std::string& vertical_unit,
                                                 FieldNames names = FieldNames::own);
template <typename Record>
[[nodiscard]] std::vector<FieldValue> field_values(std::span<const Attribute<Record>> attributes,
                                                   const Record& record) {
    std::vector<FieldValue> values;
    values.reserve(attributes.size());
    for (const Attribute<Record>& attribute : attributes)
        values.push_back(attribute.value(record));
    return values;
}

/// Describes fields with their types, units and meanings as a Markdown table.
[[nodiscard]] std::string schema_table(std::span<const FieldSpec> fields);
/// Describes the layers as such tables, which docs/reference/output.md contains.
[[nodiscard]] std::string schema_markdown();

}  // namespace d2b::features
