#include <array>
#include <string>

#include "attributes/attribute_table.hpp"

namespace d2b {
namespace {

using Unit = AttributeUnit;

constexpr std::array problem_table{
    Attribute<ProblemRecord>{"id", "Number", FieldType::integer, Unit::none, "number in this layer, from 1",
                             [](const ProblemRecord& r) -> FieldValue { return r.id; }},
    Attribute<ProblemRecord>{"kind", "Kind", FieldType::text, Unit::none,
                             "surface_corner_cut, surface_notch_filled: corners that touched, and how far "
                             "they are apart now, in m; "
                             "surface_lost: a building that is not in the surface, and its area in m2; "
                             "flow_wall, flow_gap, flow_neck: a "
                             "wall, a gap or a narrow part of a building that is shorter or narrower than "
                             "-flow_ready, in m; flow_angle: a "
                             "corner that is too sharp, in degrees; flow_touch: corners that touched, and "
                             "how far they are apart now, in m; "
                             "flow_crossing: outlines that cross; flow_step: roofs beside each other that "
                             "differ by less than -min_wall, "
                             "in m",
                             [](const ProblemRecord& r) -> FieldValue { return std::string(r.kind); }},
    Attribute<ProblemRecord>{"building", "Building", FieldType::integer, Unit::none,
                             "id of the building; of the lowest, where there are several",
                             [](const ProblemRecord& r) { return id_or_null(r.building); }},
    Attribute<ProblemRecord>{"other", "Other building", FieldType::integer, Unit::none, "id of the next one",
                             [](const ProblemRecord& r) { return id_or_null(r.other); }},
    Attribute<ProblemRecord>{"before", "Size before", FieldType::real, Unit::none,
                             "what was measured, in the unit of its kind",
                             [](const ProblemRecord& r) -> FieldValue { return r.before; }},
    Attribute<ProblemRecord>{"after", "Size after", FieldType::real, Unit::none,
                             "the same in what is written",
                             [](const ProblemRecord& r) -> FieldValue { return r.after; }},
    Attribute<ProblemRecord>{
        "state", "State", FieldType::text, Unit::none, "changed or left",
        [](const ProblemRecord& r) -> FieldValue { return std::string(r.changed ? "changed" : "left"); }},
};

}  // namespace

std::span<const Attribute<ProblemRecord>> problem_attributes() {
    return problem_table;
}

}  // namespace d2b
