#include "features/run_setup.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/version.hpp"
#include "features/attribute_table.hpp"
#include "options/option_checks.hpp"
#include "options/option_table.hpp"
#include "options/provenance_text.hpp"

namespace d2b::features {

namespace {

/// Returns the fields of given footprints. One that the footprints have already, whatever its case, gets a
/// prefix.
std::vector<FieldSpec> given_fields(const Options& options, const std::string& vertical_unit,
                                    const OriginalLayer* original) {
    std::vector<FieldSpec> fields =
        field_specs(given_attributes(options), vertical_unit, options.write.fields);
    std::set<std::string> taken;
    if (original != nullptr)
        for (const std::string& name : original->field_names())
            taken.insert(to_lower(name));
    for (FieldSpec& field : fields)
        while (taken.contains(to_lower(field.name)))
            field.name = "d2b_" + field.name;
    return fields;
}

std::string thresholds_of(const RunReport& report) {
    std::string text;
    for (const LevelReport& level : report.levels)
        if (level.level > 0 && std::isfinite(level.threshold))
            text += (text.empty() ? "" : " ") + number_text(level.threshold);
    return text;
}

/// Returns the decided values of the options that shape the result, by the names in their rows.
std::map<std::string, std::string> decisions(const RunPlan& plan) {
    const Request resolved{plan.resolved(), {}};
    std::map<std::string, std::string> items;
    for (const OptionRow& row : option_table())
        if (!row.item.empty() && has_effect(row, resolved))
            items.emplace("D2B_" + row.item, row.show(resolved));
    return items;
}

}  // namespace

LayerSpecs layer_specs(const RunPlan& plan, const std::string& source, const std::string& vertical_unit,
                       const FeatureSink& sink, const std::shared_ptr<const OriginalLayer>& original) {
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
    const auto building_fields = field_specs(building_attributes(options), vertical_unit, write.fields);
    std::optional<std::size_t>& own_buildings = specs.indices.buildings;
    if (write.has_footprints()) {
        specs.indices.given = add(LayerRole::buildings, "Buildings", "Given footprints with heights, from ",
                                  given_fields(options, vertical_unit, original.get()), false);
        specs.layers.back().original = original;
        specs.layers.back().with_z = false;
    } else if (plan.layers != Layers::contours) {
        own_buildings = add(LayerRole::buildings, "Buildings", "One polygon per building, from ",
                            building_fields, with_arcs);
    }
    if (plan.layers != Layers::buildings)
        (write.has_footprints() ? specs.indices.given_contours : specs.indices.contours) =
            add(LayerRole::contours, "Contours",
                options.outline.disjoint ? "Bands between thresholds that do not overlap, from "
                                         : "Stacked contours, low to high, from ",
                field_specs(contour_attributes(), vertical_unit), with_arcs && !write.has_footprints());
    if (write.has_footprints() && sink.takes_points())  // that is, several layers
        own_buildings = add(LayerRole::missing, "Missing", "Buildings without a given footprint, from ",
                            building_fields, with_arcs);
    if (write.roofs) {
        (write.has_footprints() ? specs.indices.given_roofs : specs.indices.roofs) =
            add(LayerRole::roofs, "Roofs", "One polygon per face of a roof, from ",
                field_specs(roof_face_attributes(), vertical_unit), false);
        specs.layers.back().with_z = true;
    }
    if (write.doubtful)
        specs.indices.doubtful = add(LayerRole::doubtful, "Doubtful buildings",
                                     "Objects that may be buildings, with the reason for the doubt, from ",
                                     building_fields, with_arcs);
    if (write.rejected)
        specs.indices.rejected =
            add(LayerRole::rejected, "Rejected",
                "Contours and holes that were dropped, filled or kept as traced, with the reason, from ",
                field_specs(rejected_attributes(), vertical_unit), false);
    if (write.problems && sink.takes_points()) {
        specs.indices.problems =
            add(LayerRole::problems, "Problems",
                "Places where outlines were unfit for a surface, and whether they were changed, from ",
                field_specs(problem_attributes(), vertical_unit), false);
        specs.layers.back().points = true;
        specs.layers.back().with_z = false;
    }
    return specs;
}

Provenance make_provenance(const RunSetup& setup, const RunReport& report) {
    const RunPlan& plan = setup.plan;
    Provenance provenance;
    provenance.crs_wkt = setup.written().wkt();
    // A layer must not mix vertical units, or stacked with disjoint contours, because its fields would lose
    // their meaning.
    provenance.binding = {"D2B_VERTICAL_UNIT", "D2B_CONTOURS"};
    provenance.metadata = {
        {"D2B_VERSION", std::string(version)},
        {"D2B_SOURCE", source_text(setup.dem.name, plan.asked.read)},
        {"D2B_OPTIONS", reproducing_arguments(plan.asked)},
        {"D2B_CONTOURS", plan.asked.outline.disjoint ? "disjoint" : "stacked"},
        {"D2B_THRESHOLDS", thresholds_of(report)},
        {"D2B_MINIMUM", number_text(report.minimum)},
        {"D2B_MAXIMUM", number_text(report.maximum)},
        {"D2B_VERTICAL_UNIT", report.units.vertical},
        {"D2B_VERTICAL_UNIT_FROM", report.units.vertical_source},
        {"D2B_HORIZONTAL_UNIT", report.units.horizontal},
        {"D2B_HORIZONTAL_UNIT_FROM", report.units.horizontal_source},
        {"D2B_AREAS", report.units.areas},
    };
    provenance.metadata.merge(decisions(plan));
    std::erase_if(provenance.metadata, [](const auto& item) { return item.second.empty(); });
    for (auto& [name, value] : provenance.metadata)
        value = utf8_text(value);
    return provenance;
}

}  // namespace d2b::features
