#include <array>
#include <string>

#include "attributes/attribute_table.hpp"

namespace d2b {
namespace {

using Unit = AttributeUnit;

constexpr std::array rejected_table{
    Attribute<RejectedRecord>{"id", "Number", FieldType::integer, Unit::none, "number in this layer, from 1",
                              [](const RejectedRecord& r) -> FieldValue { return r.id; }},
    Attribute<RejectedRecord>{
        "reason", "Reason", FieldType::text, Unit::none,
        "contour_short, contour_small, contour_on_dropped, building_not_tall: dropped; hole_short, "
        "hole_small: filled; "
        "outline_kept_traced, polygon_repaired, polygon_lost: written in another form, or not at all",
        [](const RejectedRecord& r) -> FieldValue { return std::string(r.reason); }},
    Attribute<RejectedRecord>{"building", "Building", FieldType::integer, Unit::none,
                              "id of the building that has this traced outline",
                              [](const RejectedRecord& r) { return id_or_null(r.building); }},
    Attribute<RejectedRecord>{"contour", "Contour", FieldType::integer, Unit::none,
                              "id of the contour that has this traced outline",
                              [](const RejectedRecord& r) { return id_or_null(r.contour); }},
    Attribute<RejectedRecord>{"level", "Level", FieldType::integer, Unit::none,
                              "level of the contour, or of the one that has the hole",
                              [](const RejectedRecord& r) -> FieldValue { return std::int64_t{r.level}; }},
    Attribute<RejectedRecord>{"area_m2", "Area", FieldType::real, Unit::square_metre,
                              "area less holes, on the ellipsoid where the CRS has one",
                              [](const RejectedRecord& r) -> FieldValue { return r.area_m2; }},
    Attribute<RejectedRecord>{"perim_m", "Perimeter", FieldType::real, Unit::metre,
                              "length of all rings, on the ellipsoid where the CRS has one",
                              [](const RejectedRecord& r) -> FieldValue { return r.perimeter_m; }},
};

}  // namespace

std::span<const Attribute<RejectedRecord>> rejected_attributes() {
    return rejected_table;
}

}  // namespace d2b
