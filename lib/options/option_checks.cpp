#include "options/option_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

constexpr std::string_view one_window = "give one of -srcwin, -projwin and -te";
constexpr std::string_view sweep_levels = "the levels of a sweep are those of its lod";
constexpr std::string_view own_values = "the sweep names the values itself";
constexpr std::string_view no_layers = "a sweep writes no layers and no rasters";
constexpr std::string_view round_walls = "only -regularize auto makes round walls";
constexpr std::string_view thesis_walls = "its outlines stay as traced unless -regularize auto is given";

constexpr std::string_view flow_roofs = "roofs are planes that meet, and have edges of any length";
constexpr std::string_view flow_walls = "arcs are short walls, which are merged";

constexpr std::string_view given_walls = "each footprint is a building already";
constexpr std::string_view no_outlines = "blocks are made of outlines of found buildings";
constexpr std::string_view kept_footprints = "footprints are written as they are";

constexpr OptionCondition given(std::string_view name) {
    return {name};
}
constexpr OptionCondition is(std::string_view name, std::string_view value) {
    return {name, Match::equal, value};
}
constexpr OptionCondition is_not(std::string_view name, std::string_view value) {
    return {name, Match::other, value};
}

constexpr OptionRule exclude(OptionCondition one, OptionCondition other, std::string_view advice) {
    return {RuleKind::exclude, one, other, advice};
}
constexpr OptionRule no_effect(OptionCondition one, OptionCondition other, std::string_view advice,
                               OptionCondition unless = {}) {
    return {RuleKind::no_effect, one, other, advice, unless};
}

constexpr std::array rules{
    exclude(given("fl"), given("i"), "list the levels or give an interval"),
    exclude(given("lod"), given("fl"), "the listed levels replace those of -lod"),
    exclude(given("lod"), given("i"), "the interval replaces -lod"),
    exclude(given("sweep"), given("fl"), sweep_levels),
    exclude(given("sweep"), given("i"), sweep_levels),
    exclude(given("srcwin"), given("projwin"), one_window),
    exclude(given("srcwin"), given("te"), one_window),
    exclude(given("projwin"), given("te"), one_window),
    exclude(given("snodata"), given("inodata"), "set a NoData value or ignore it"),
    exclude(given("overwrite"), given("append"), "replace the layers or add to them"),
    exclude(given("preview_size"), given("preview_paper"), "the size of a PNG follows from its paper"),
    exclude(given("roofs"), is("detail", "0"),
            "borders between faces would cost nothing, so give a larger -detail"),
    exclude(is("surface_of", "roofs"), is("detail", "0"),
            "borders between faces would cost nothing, so give a larger -detail"),
    exclude(is("surface_of", "roofs"), is("preset", "thesis"), "it detects no buildings"),
    exclude(is("surface_of", "roofs"), is_not("flow_ready", "0"), flow_roofs),
    exclude(is("surface_of", "roofs"), given("min_gap"), flow_roofs),
    exclude(is("surface_of", "roofs"), given("min_wall"), flow_roofs),
    exclude(is_not("simplify", "0"), is_not("regularize", "off"), "straight walls need no simplification"),

    // Footprints.
    exclude(given("split_by"), given("footprints"), given_walls),
    exclude(is_not("split_height", "0"), given("footprints"), given_walls),
    exclude(given("mask"), given("footprints"), "all footprints are measured, so give those of the area"),
    exclude(given("append"), given("footprints"),
            "write to another layer, with -overwrite if the file exists"),
    exclude(is("layers", "contours"), given("footprints"), "the footprints are the layer of buildings"),
    exclude(given("surface"), given("footprints"), no_outlines),
    exclude(given("page"), given("footprints"), no_outlines),
    exclude(given("flow_ready"), given("footprints"), kept_footprints),
    exclude(given("min_gap"), given("footprints"), kept_footprints),
    exclude(given("min_wall"), given("footprints"), kept_footprints),
    exclude(given("write_rejected"), given("footprints"), "no footprint is left out"),
    no_effect(given("footprints"), given("sweep"), no_layers),

    // Levels.
    no_effect(given("levels"), given("fl"), "the listed levels are the same for all buildings"),
    no_effect(given("levels"), given("i"), "the levels of an interval are the same for all buildings"),

    // Outlines and layers.
    no_effect(given("arcs"), is_not("simplify", "0"), "simplified outlines have no straight walls"),
    no_effect(given("arcs"), is("regularize", "off"), round_walls),
    no_effect(given("regularize_tolerance"), is_not("simplify", "0"),
              "simplified outlines have no straight walls"),
    no_effect(given("regularize_tolerance"), is("regularize", "off"), "it says how walls become straight"),
    no_effect(given("wall_inset"), is_not("simplify", "0"), "simplified outlines have no straight walls"),
    no_effect(given("wall_inset"), is("regularize", "off"), "it moves straight walls"),
    no_effect(given("wall_inset"), is("preset", "thesis"), thesis_walls, given("regularize")),
    no_effect(given("arcs"), is("regularize", "right"), round_walls),
    no_effect(given("arcs"), is("regularize", "free"), round_walls),
    no_effect(given("arcs"), given("t_srs"), "a circle in one CRS is not a circle in another"),
    no_effect(given("arcs"), is("preset", "thesis"), thesis_walls, given("regularize")),
    no_effect(given("arcs"), is_not("flow_ready", "0"), flow_walls),
    no_effect(given("arcs"), given("min_gap"), flow_walls),
    no_effect(given("arcs"), given("min_wall"), flow_walls),
    no_effect(given("regularize_tolerance"), is("preset", "thesis"), thesis_walls, given("regularize")),
    no_effect(given("disjoint"), is("layers", "buildings"),
              "only contours become bands, with -layers contours or both"),
    no_effect(is_not("fields", "own"), is("layers", "contours"), "only fields of buildings have other names",
              given("write_doubtful")),
    no_effect(given("split_field"), is("layers", "contours"), "only buildings have the field parcel",
              given("write_doubtful")),
    no_effect(given("roofs"), is("layers", "contours"), "only buildings have roofs"),
    no_effect(given("write_doubtful"), is("min_confidence", "0"), "nothing is doubtful then"),
    no_effect(given("max_building_width"), is_not("ground", "auto"),
              "it helps to find the ground, which is given"),

    // Surfaces.
    no_effect(given("surface_roof"), is("surface_of", "contours"), "tiers have heights of their own"),
    no_effect(given("surface_roof"), is("surface_of", "roofs"), "planes have heights of their own"),
    no_effect(given("surface_roof"), is("preset", "thesis"),
              "its surface is that of the contours unless -surface_of buildings is given",
              given("surface_of")),

    // -sweep.
    no_effect(given("layers"), given("sweep"), no_layers),
    no_effect(given("3d"), given("sweep"), no_layers),
    no_effect(given("f"), given("sweep"), no_layers),
    no_effect(given("dsco"), given("sweep"), no_layers),
    no_effect(given("lco"), given("sweep"), no_layers),
    no_effect(given("nln"), given("sweep"), no_layers),
    no_effect(given("append"), given("sweep"), no_layers),
    no_effect(given("fields"), given("sweep"), no_layers),
    no_effect(given("storey_height"), given("sweep"), no_layers),
    no_effect(given("split_field"), given("sweep"), no_layers),
    no_effect(given("arcs"), given("sweep"), no_layers),
    no_effect(given("write_doubtful"), given("sweep"), no_layers),
    no_effect(given("write_rejected"), given("sweep"), no_layers),
    no_effect(given("roofs"), given("sweep"), no_layers),
    no_effect(given("write_problems"), given("sweep"), no_layers),
    no_effect(given("write_ground"), given("sweep"), no_layers),
    no_effect(given("write_height"), given("sweep"), no_layers),
    no_effect(given("write_canopy"), given("sweep"), no_layers),
    no_effect(given("surface"), given("sweep"), no_layers),
    no_effect(given("page"), given("sweep"), no_layers),
    no_effect(given("preview_paper"), given("sweep"), "its contact sheet has the size of -preview_size"),
    no_effect(given("overwrite"), given("sweep"), "it writes a picture at most, with -preview",
              given("preview")),
};

constexpr std::array needs{
    OptionDependency{"off", {"i"}, "it is the elevation that the intervals count from"},
    OptionDependency{"cutline_layer", {"cutline"}, "it names the layer of its polygons"},
    OptionDependency{"preview_size", {"preview"}, "it is the size of its picture"},
    OptionDependency{"preview_paper", {"preview"}, "it is the paper of its picture"},
    OptionDependency{"preview_scale", {"preview_paper"}, "it is the scale of a map on paper"},
    OptionDependency{"landscape", {"preview_paper"}, "it turns the paper"},
    OptionDependency{"title", {"preview", "page"}, "it is the title of a picture or a page"},
    OptionDependency{"credit", {"preview", "page"}, "it is written on a picture or a page"},
    OptionDependency{"surface_of", {"surface"}, "it is the model of the surface"},
    OptionDependency{"surface_roof", {"surface"}, "it is the height of its flat roofs"},
    OptionDependency{"surface_solids", {"surface"}, "it says how many objects an OBJ has, or solids an STL"},
    OptionDependency{"surface_origin", {"surface"}, "it is the origin of its coordinates"},
    OptionDependency{"write_problems",
                     {"surface", "flow_ready", "min_gap", "min_wall"},
                     "it writes the problems of a surface or a flow solver"},
    OptionDependency{"mask_layer", {"mask"}, "it names the layer of its polygons"},
    OptionDependency{"exclude_layer", {"exclude"}, "it names the layer of its polygons"},
    OptionDependency{"exclude_buffer", {"exclude"}, "it widens its polygons"},
    OptionDependency{"corrections_layer", {"corrections"}, "it names the layer of the corrections"},
    OptionDependency{"footprints_layer", {"footprints"}, "it names the layer of the footprints"},
    OptionDependency{"split_layer", {"split_by"}, "it names the layer of the parcels"},
    OptionDependency{"split_field", {"split_by"}, "it is a field of the parcels"},
    OptionDependency{
        "split_width", {"split_by", "corrections"}, "it is the width of parts that parcels cut off"},
};

/// Returns the Damerau-Levenshtein distance (optimal string alignment).
std::size_t edit_distance(std::string_view one, std::string_view other) {
    std::vector<std::vector<std::size_t>> cost(one.size() + 1, std::vector<std::size_t>(other.size() + 1));
    for (std::size_t i = 0; i <= one.size(); ++i) {
        for (std::size_t j = 0; j <= other.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = cost[i - 1][j - 1] + (one[i - 1] == other[j - 1] ? 0 : 1);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost.back().back();
}

/// Formats the use as on a command line.
std::string written(const OptionCondition& use, const Request& request) {
    const std::string option = "-" + std::string(use.name);
    return use.match == Match::any ? option : option + " " + find_option(use.name)->show(request);
}

bool holds(const OptionCondition& use, const Request& request) {
    const OptionRow& row = *find_option(use.name);
    return row.is_given(request) && use.matches(row.show(request));
}

bool is_broken(const OptionRule& rule, const Request& request) {
    return holds(rule.one, request) && holds(rule.other, request) &&
           (rule.unless.name.empty() || !holds(rule.unless, request));
}

void check_rule(const OptionRule& rule, const Request& request) {
    if (!is_broken(rule, request))
        return;
    throw OptionError(
        written(rule.one, request) +
        (rule.kind == RuleKind::exclude ? " cannot be used together with " : " has no effect with ") +
        written(rule.other, request) + "; " + std::string(rule.advice) + ".");
}

/// Returns "-surface <file>, -flow_ready <m> or -min_gap <m>".
std::string needed_alternatives(const OptionDependency& need) {
    std::vector<std::string> synopses;
    for (const std::string_view name : need.needed)
        if (!name.empty())
            synopses.push_back(option_synopsis(*find_option(name)));
    return alternatives(synopses);
}

void check_need(const OptionDependency& need, const Request& request) {
    const auto is_given = [&](std::string_view name) {
        return !name.empty() && find_option(name)->is_given(request);
    };
    if (is_given(need.name) && std::ranges::none_of(need.needed, is_given))
        throw OptionError("-" + std::string(need.name) + " needs " + needed_alternatives(need) + "; " +
                          std::string(need.advice) + ".");
}

void check_preset(const Request& request) {
    const Preset preset = request.options.preset;
    for (const OptionRow& row : option_table()) {
        if (row.has_meaning(preset) || !row.is_given(request))
            continue;
        const std::string value = row.show(request);
        const bool any = row.scope.elsewhere.empty();
        if (any || value != row.scope.elsewhere)
            throw OptionError("-" + row.name + (any ? "" : " " + value) + " has no effect with -preset " +
                              std::string(preset_name(preset)) + "; " + row.scope.why + ".");
    }
}

/// Rejects offsets that are too many intervals away, because thresholds would be off by a thousandth of an
/// interval and more, or coincide.
void check_offset(const LevelOptions& levels) {
    constexpr double most_intervals = 0x1p43;
    if (levels.interval && !(std::abs(levels.offset) <= most_intervals * *levels.interval))
        throw OptionError("-off " + number_text(levels.offset) + " is too far away to count intervals of " +
                          number_text(*levels.interval) + " from; give a base near the elevations.");
}

/// Requires an OBJ or STL, because -surface_solids has no effect on CityJSON and glTF.
void check_solids(const Request& request) {
    const auto is_parted = [](const std::string& name) {
        const std::string small = to_lower(name);
        return small.ends_with(".obj") || small.ends_with(".stl");
    };
    const std::vector<std::string>& files = request.options.write.surfaces;
    if (find_option("surface_solids")->is_given(request) && std::ranges::none_of(files, is_parted))
        throw OptionError(
            "-surface_solids has no effect without an OBJ or STL; give a -surface whose name "
            "ends in .obj or .stl.");
}

/// One of two options needs a certain value, which the table of dependencies cannot say.
void check_roofs(const Request& request) {
    const WriteOptions& write = request.options.write;
    if (find_option("roof_min_area")->is_given(request) && !write.roofs &&
        write.surface_of != SurfaceOf::roofs)
        throw OptionError("-roof_min_area needs -roofs or -surface_of roofs; it is the size of their faces.");
}

/// Contours alone have no floors.
void check_storeys(const Request& request) {
    const WriteOptions& write = request.options.write;
    const bool has_buildings = write.layers != Layers::contours || write.doubtful || write.has_footprints() ||
                               !write.surfaces.empty() || !write.page.empty();
    if (find_option("storey_height")->is_given(request) && !has_buildings)
        throw OptionError("-storey_height has no effect with -layers contours; only buildings have floors.");
}

/// Checks everything but the values of a sweep.
void check_run(const Request& request) {
    for (const OptionRule& rule : option_rules())
        check_rule(rule, request);
    check_preset(request);
    for (const OptionDependency& need : option_dependencies())
        check_need(need, request);
    check_offset(request.options.levels);
    check_solids(request);
    check_roofs(request);
    check_storeys(request);
}

/// Checks each trial as a run of its own.
void check_sweep(const Request& request) {
    const SweepPlan& plan = request.tool.sweep_plan;
    for (const SweptOption& option : plan.options)
        if (find_option(option.name)->is_given(request))
            throw OptionError("-" + option.name + " has no effect with -sweep " + option.name + "=...; " +
                              std::string(own_values) + ".");
    for (const std::vector<std::string>& values : sweep_values(plan)) {
        Request trial{request.options, {}};
        for (std::size_t i = 0; i < values.size(); ++i)
            apply_option(*find_option(plan.options[i].name), trial, std::span(&values[i], 1));
        check_run(trial);
    }
    const WriteOptions& write = request.options.write;
    if (!write.preview.empty() && find_option("preview_size")->is_given(request))
        require_legible(plan.trials(), write.preview_size);
}

}  // namespace

std::span<const OptionRule> option_rules() {
    return rules;
}

std::span<const OptionDependency> option_dependencies() {
    return needs;
}

void check_options(const Request& request) {
    check_run(request);
    if (!request.tool.sweep.empty())
        check_sweep(request);
}

bool has_effect(const OptionRow& row, const Request& request) {
    Request given = request;
    given.options.given.insert(row.name);
    return row.has_meaning(request.options.preset) &&
           std::ranges::none_of(option_rules(), [&](const OptionRule& rule) {
               return rule.one.name == row.name && is_broken(rule, given);
           });
}

std::string nearest_name(std::string_view typed, std::span<const std::string> candidates) {
    const std::string wanted = to_lower(typed);
    // Allows a third of the letters to be wrong, so that short names do not match arbitrary ones.
    std::size_t best = wanted.size() / 3 + 1;
    std::string nearest;
    for (const std::string& candidate : candidates) {
        const std::string name = to_lower(candidate);
        const bool begins = wanted.size() >= 3 && name.starts_with(wanted);
        const std::size_t distance = std::min(edit_distance(wanted, name), begins ? std::size_t{1} : best);
        if (distance < best) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace d2b
