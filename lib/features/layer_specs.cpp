#include "features/layer_specs.hpp"

#include <utility>

#include "attributes/attribute_table.hpp"
#include "core/utf8_text.hpp"

namespace d2b {

LayerSpecs layer_specs(const RunPlan& plan, const std::string& source, const std::string& vertical_unit,
                       const FeatureSink& sink) {
    const Options& options = plan.asked;
    const WriteOptions& write = options.write;
    const bool with_arcs = options.outline.arcs;
    LayerSpecs specs;
    const auto add = [&](LayerRole role, const char* title, const std::string& description,
                         std::vector<FieldSpec> fields, bool arcs) {
        specs.layers.push_back({sink.layer_name(role, plan.layers), title, description + utf8_text(source),
                                std::move(fields), write.with_z, arcs});
        return specs.layers.size() - 1;
    };
    const auto building_fields =
        field_specs(building_attributes(options.detect.is_split_by()), vertical_unit, write.fields);
    if (plan.layers != Layers::contours)
        specs.places.buildings = add(LayerRole::buildings, "Buildings", "One polygon per building, from ",
                                     building_fields, with_arcs);
    if (plan.layers != Layers::buildings)
        specs.places.contours =
            add(LayerRole::contours, "Contours",
                options.outline.disjoint ? "Bands between thresholds that do not overlap, from "
                                         : "Stacked contours, low to high, from ",
                field_specs(contour_attributes(), vertical_unit), with_arcs);
    if (write.doubtful)
        specs.places.doubtful = add(LayerRole::doubtful, "Doubtful buildings",
                                    "Objects that may be buildings, with the reason for the doubt, from ",
                                    building_fields, with_arcs);
    if (write.rejected)
        specs.places.rejected =
            add(LayerRole::rejected, "Rejected",
                "Contours and holes that were dropped, filled or kept as traced, with the reason, from ",
                field_specs(rejected_attributes(), vertical_unit), false);
    if (write.problems && sink.takes_points()) {
        specs.places.problems =
            add(LayerRole::problems, "Problems",
                "Places at which outlines stood in the way of a surface, and what became of them, from ",
                field_specs(problem_attributes(), vertical_unit), false);
        specs.layers.back().points = true;
        specs.layers.back().with_z = false;
    }
    return specs;
}

}  // namespace d2b
