#include "options/option_rules.hpp"

#include <array>

namespace d2b {
namespace {

constexpr std::string_view one_window = "give one of -srcwin, -projwin and -te";
constexpr std::string_view sweep_levels = "the levels of a sweep are those of its lod";
constexpr std::string_view own_values = "the sweep names the values itself";
constexpr std::string_view no_layers = "a sweep writes no layers and no rasters";
constexpr std::string_view round_walls = "round walls come from -regularize auto alone";
constexpr std::string_view thesis_walls = "its outlines stay as traced unless -regularize auto is given";

constexpr std::string_view flow_walls = "arcs are short walls, which are merged";

constexpr OptionUse given(std::string_view name) {
    return {name};
}
constexpr OptionUse is(std::string_view name, std::string_view value) {
    return {name, Match::equal, value};
}
constexpr OptionUse is_not(std::string_view name, std::string_view value) {
    return {name, Match::other, value};
}
constexpr OptionUse names(std::string_view name, std::string_view part) {
    return {name, Match::names, part};
}

constexpr OptionRule exclude(OptionUse one, OptionUse other, std::string_view advice) {
    return {RuleKind::exclude, one, other, advice};
}
constexpr OptionRule no_effect(OptionUse one, OptionUse other, std::string_view advice,
                               OptionUse unless = {}) {
    return {RuleKind::no_effect, one, other, advice, unless};
}

constexpr std::array rules{
    exclude(given("fl"), given("i"), "list the levels or give an interval"),
    exclude(given("lod"), given("fl"), "the listed levels take the place of those of -lod"),
    exclude(given("lod"), given("i"), "the interval takes the place of -lod"),
    exclude(given("sweep"), given("fl"), sweep_levels),
    exclude(given("sweep"), given("i"), sweep_levels),
    exclude(given("srcwin"), given("projwin"), one_window),
    exclude(given("srcwin"), given("te"), one_window),
    exclude(given("projwin"), given("te"), one_window),
    exclude(given("snodata"), given("inodata"), "set a NoData value or ignore it"),
    exclude(given("overwrite"), given("append"), "replace the layers or add to them"),
    exclude(is_not("simplify", "0"), is_not("regularize", "off"), "straight walls need no simplification"),

    // Levels.
    no_effect(given("levels"), given("fl"), "the listed levels are the same for all buildings"),
    no_effect(given("levels"), given("i"), "the levels of an interval are the same for all buildings"),
    no_effect(given("lod"), names("sweep", "lod"), own_values),
    no_effect(given("nf"), names("sweep", "nf"), own_values),
    no_effect(given("detail"), names("sweep", "detail"), own_values),

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
    no_effect(given("arcs"), given("t_srs"), "a circle in one CRS is no circle in another"),
    no_effect(given("arcs"), is("preset", "thesis"), thesis_walls, given("regularize")),
    no_effect(given("arcs"), is_not("flow_ready", "0"), flow_walls),
    no_effect(given("arcs"), given("min_gap"), flow_walls),
    no_effect(given("arcs"), given("min_wall"), flow_walls),
    no_effect(given("regularize_tolerance"), is("preset", "thesis"), thesis_walls, given("regularize")),
    no_effect(given("disjoint"), is("layers", "buildings"),
              "contours alone become bands, with -layers contours or both"),
    no_effect(is_not("fields", "own"), is("layers", "contours"), "only fields of buildings have other names",
              given("write_doubtful")),
    no_effect(given("split_field"), is("layers", "contours"), "only buildings say whose parcel they are",
              given("write_doubtful")),
    no_effect(given("write_doubtful"), is("min_confidence", "0"), "nothing is doubtful then"),
    no_effect(given("max_building_width"), is_not("ground", "auto"),
              "it helps to find the ground, which is given"),

    // Surfaces.
    no_effect(given("surface_roof"), is("surface_of", "contours"), "tiers have heights of their own"),
    no_effect(given("surface_roof"), is("preset", "thesis"),
              "its surface is that of the contours unless -surface_of buildings is given",
              given("surface_of")),

    // -sweep.
    no_effect(names("sweep", "detail"), is("preset", "thesis"), "it detects no buildings"),
    no_effect(given("layers"), given("sweep"), no_layers),
    no_effect(given("3d"), given("sweep"), no_layers),
    no_effect(given("f"), given("sweep"), no_layers),
    no_effect(given("dsco"), given("sweep"), no_layers),
    no_effect(given("lco"), given("sweep"), no_layers),
    no_effect(given("nln"), given("sweep"), no_layers),
    no_effect(given("append"), given("sweep"), no_layers),
    no_effect(given("fields"), given("sweep"), no_layers),
    no_effect(given("split_field"), given("sweep"), no_layers),
    no_effect(given("arcs"), given("sweep"), no_layers),
    no_effect(given("write_doubtful"), given("sweep"), no_layers),
    no_effect(given("write_rejected"), given("sweep"), no_layers),
    no_effect(given("write_problems"), given("sweep"), no_layers),
    no_effect(given("write_ground"), given("sweep"), no_layers),
    no_effect(given("write_height"), given("sweep"), no_layers),
    no_effect(given("write_canopy"), given("sweep"), no_layers),
    no_effect(given("surface"), given("sweep"), no_layers),
    no_effect(given("page"), given("sweep"), no_layers),
    no_effect(given("overwrite"), given("sweep"), "it writes a picture at most, with -preview",
              given("preview")),
};

constexpr std::array needs{
    OptionNeed{"off", "i", "it is the elevation that the intervals count from"},
    OptionNeed{"cutline_layer", "cutline", "it names the layer of its polygons"},
    OptionNeed{"preview_size", "preview", "it is the size of its picture"},
    OptionNeed{"surface_of", "surface", "it says what the surface is made of"},
    OptionNeed{"surface_roof", "surface", "it is the height of its flat roofs"},
    OptionNeed{"surface_solids", "surface", "it says how many objects an OBJ has, or solids an STL"},
    OptionNeed{"surface_origin", "surface", "its coordinates begin there"},
    OptionNeed{"write_problems",
               "surface",
               "what it writes was in the way of a surface or a flow solver",
               {"flow_ready", "min_gap", "min_wall"}},
    OptionNeed{"mask_layer", "mask", "it names the layer of its polygons"},
    OptionNeed{"split_layer", "split_by", "it names the layer of the parcels"},
    OptionNeed{"split_field", "split_by", "it is a field of the parcels"},
    OptionNeed{"split_width", "split_by", "it is the width of what parcels cut off"},
};

}  // namespace

std::span<const OptionRule> option_rules() {
    return rules;
}

std::span<const OptionNeed> option_needs() {
    return needs;
}

}  // namespace d2b
