#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"
#include "options/option_cases.hpp"
#include "options/option_checks.hpp"
#include "options/option_table.hpp"
#include "options/run_plan.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

/// Cases of an option that a rule means.
std::vector<OptionCase> cases_of(const OptionCondition& use) {
    std::vector<OptionCase> found;
    for (const OptionCase& option : option_cases()) {
        if (option.name != use.name)
            continue;
        const std::string value = option.values.empty() ? "yes" : option.values.front();
        if (use.matches(value))
            found.push_back(option);
    }
    return found;
}

Texts both(const OptionCase& one, const OptionCase& other) {
    Texts words = one.words();
    for (const std::string& word : other.words())
        words.push_back(word);
    return words;
}

bool is_a_sentence(const std::string& text) {
    return std::regex_match(text, std::regex("-[a-z_0-9]+ [^\n]*[^.]\\."));
}

/// An option without a value in option_cases.cpp would be tried with nothing.
TEST(OptionRules, knowACaseOfEveryOption) {
    for (const OptionRow& row : option_table())
        if (!row.hidden && !row.name.starts_with("help") && row.name != "version") {
            EXPECT_FALSE(cases_of({row.name}).empty()) << row.name;
        }
}

/// Words of the command line reach the field that the row shows.
TEST(OptionRules, wordsChangeWhatTheirOptionShows) {
    std::set<std::string> changed;
    for (const OptionCase& option : option_cases()) {
        Texts words = option.words();
        words.insert(words.end(), {"--", "in.tif"});
        if (option.name != "sweep")
            words.emplace_back("out.gpkg");
        const OptionRow& row = *find_option(option.name);
        if (row.show(parse_command_line(words)) != row.standard)
            changed.insert(option.name);
    }
    for (const OptionRow& row : option_table())
        if (!row.hidden && !row.name.starts_with("help") && row.name != "version" && row.name != "p") {
            EXPECT_TRUE(changed.contains(row.name)) << row.name;
        }
}

TEST(OptionRules, nameOptionsThatThereAre) {
    for (const OptionRule& rule : option_rules()) {
        EXPECT_FALSE(cases_of(rule.one).empty()) << rule.one.name;
        EXPECT_FALSE(cases_of(rule.other).empty()) << rule.other.name;
        EXPECT_TRUE(rule.unless.name.empty() || find_option(rule.unless.name) != nullptr) << rule.unless.name;
    }
    for (const OptionDependency& need : option_dependencies()) {
        EXPECT_NE(find_option(need.name), nullptr) << need.name;
        EXPECT_NE(find_option(need.needed.front()), nullptr) << need.name;
        for (const std::string_view needed : need.needed)
            EXPECT_TRUE(needed.empty() || find_option(needed) != nullptr) << needed;
    }
}

TEST(OptionRules, refuseInEitherOrderWithOneSentence) {
    for (const OptionRule& rule : option_rules())
        for (const OptionCase& one : cases_of(rule.one))
            for (const OptionCase& other : cases_of(rule.other)) {
                const std::string message = refusal_of(both(one, other));
                EXPECT_NE(message, "") << one.text() << " " << other.text();
                EXPECT_EQ(refusal_of(both(other, one)), message);
            }
}

TEST(OptionRules, sayWhichTwoAndWhatToDo) {
    for (
        const auto& [words, message] : std::vector<std::pair<Texts, std::string>>{
            {{"-arcs", "-regularize", "off"},
             "-arcs has no effect with -regularize off; only -regularize auto makes round walls."},
            {{"-wall_inset", "0.3", "-regularize", "off"},
             "-wall_inset has no effect with -regularize off; it moves straight walls."},
            {{"-disjoint", "-layers", "buildings"},
             "-disjoint has no effect with -layers buildings; only contours become bands, with -layers "
             "contours or both."},
            {{"-simplify", "0.5", "-regularize", "right"},
             "-simplify 0.5 cannot be used together with -regularize right; straight walls need no "
             "simplification."},
            {{"-max_building_width", "40", "-ground", "dtm.tif"},
             "-max_building_width has no effect with -ground dtm.tif; it helps to find the ground, which is "
             "given."},
            {{"-sweep", "lod=1..3,nf=2", "-lod", "2"},
             "-lod has no effect with -sweep lod=...; the sweep names the values itself."},
            {{"-sweep", "detail=1", "-detail", "2"},
             "-detail has no effect with -sweep detail=...; the sweep names the values itself."},
            {{"-sweep", "min_area=10..50", "-min_area", "20"},
             "-min_area has no effect with -sweep min_area=...; the sweep names the values itself."},
            {{"-sweep", "min_height=2..3", "-preset", "thesis"},
             "-min_height has no effect with -preset thesis; it detects no buildings, so leave one of them "
             "out."},
            {{"-sweep", "split_width=1..2"},
             "-split_width needs -split_by <polygons or lines> or -corrections <points, polygons and lines>; "
             "it is the width of parts that parcels cut off."},
            {{"-preview", "p.png", "-preview_size", "900", "-preview_paper", "A4"},
             "-preview_size cannot be used together with -preview_paper; the size of a PNG follows from its "
             "paper."},
            {{"-preview", "p.png", "-landscape"},
             "-landscape needs -preview_paper A0|A1|A2|A3|A4|A5; it turns the paper."},
            {{"-title", "Town"},
             "-title needs -preview <file> or -page <file.html>; it is the title of a picture or a page."},
            {{"-roofs", "-detail", "0"},
             "-roofs cannot be used together with -detail 0; borders between faces would cost nothing, so "
             "give a larger -detail."},
            {{"-roofs", "-layers", "contours"},
             "-roofs has no effect with -layers contours; only buildings have roofs."},
            {{"-roof_min_area", "15"},
             "-roof_min_area needs -roofs or -surface_of roofs; it is the size of their faces."},
            {{"-surface", "s.obj", "-surface_of", "buildings", "-roof_min_area", "15"},
             "-roof_min_area needs -roofs or -surface_of roofs; it is the size of their faces."},
            {{"-surface", "s.obj", "-surface_of", "roofs", "-flow_ready", "1"},
             "-surface_of roofs cannot be used together with -flow_ready 1; roofs are planes that meet, and "
             "have edges of any length."},
            {{"-surface", "s.obj", "-surface_of", "roofs", "-surface_roof", "p90"},
             "-surface_roof has no effect with -surface_of roofs; planes have heights of their own."},
            {{"-mask_layer", "roofs"},
             "-mask_layer needs -mask <raster or polygons>; it names the layer of its polygons."},
            {{"-split_width", "2"},
             "-split_width needs -split_by <polygons or lines> or -corrections <points, polygons and lines>; "
             "it is the width of parts that parcels cut off."},
            {{"-exclude_layer", "bridges"},
             "-exclude_layer needs -exclude <polygons>; it names the layer of its polygons."},
            {{"-exclude_buffer", "2"}, "-exclude_buffer needs -exclude <polygons>; it widens its polygons."},
            {{"-corrections_layer", "edits"},
             "-corrections_layer needs -corrections <points, polygons and lines>; it names the layer of the "
             "corrections."},
            {{"-storey_height", "4", "-layers", "contours"},
             "-storey_height has no effect with -layers contours; only buildings have floors."},
            {{"-exclude", "b.gpkg", "-preset", "thesis"},
             "-exclude has no effect with -preset thesis; it detects no buildings, so leave one of them "
             "out."},
            {{"-corrections", "e.gpkg", "-preset", "thesis"},
             "-corrections has no effect with -preset thesis; it detects no buildings, so leave one of them "
             "out."},
            {{"-footprints_layer", "roofs"},
             "-footprints_layer needs -footprints <polygons>; it names the layer of the footprints."},
            {{"-split_by", "p.gpkg", "-footprints", "f.gpkg"},
             "-split_by cannot be used together with -footprints; each footprint is a building "
             "already."},
            {{"-split_height", "3", "-footprints", "f.gpkg"},
             "-split_height 3 cannot be used together with -footprints; each footprint is a building "
             "already."},
            {{"-mask", "m.gpkg", "-footprints", "f.gpkg"},
             "-mask cannot be used together with -footprints; all footprints are measured, so give those of "
             "the area."},
            {{"-append", "-footprints", "f.gpkg"},
             "-append cannot be used together with -footprints; write to another layer, with -overwrite if "
             "the file exists."},
            {{"-layers", "contours", "-footprints", "f.gpkg"},
             "-layers contours cannot be used together with -footprints; the footprints are the layer of "
             "buildings."},
            {{"-surface", "s.obj", "-footprints", "f.gpkg"},
             "-surface cannot be used together with -footprints; blocks are made of outlines of found "
             "buildings."},
            {{"-flow_ready", "3", "-footprints", "f.gpkg"},
             "-flow_ready cannot be used together with -footprints; footprints are written as they are."},
            {{"-write_rejected", "-footprints", "f.gpkg"},
             "-write_rejected cannot be used together with -footprints; no footprint is left out."},
            {{"-split_by", "p.gpkg", "-split_field", "no", "-layers", "contours"},
             "-split_field has no effect with -layers contours; only buildings have the field parcel."}})
        EXPECT_EQ(refusal_of(words), message);
}

/// Refuses also an option that repeats the default.
TEST(OptionRules, refuseWhatHasNoMeaningInAPreset) {
    const std::string end =
        " has no effect with -preset thesis; it detects no buildings, so leave one of them out.";
    int tried = 0;
    for (const OptionCase& option : option_cases()) {
        const OptionRow& row = *find_option(option.name);
        if (row.has_meaning(Preset::thesis))
            continue;
        Texts words = option.words();
        words.insert(words.end(), {"-preset", "thesis"});
        const std::string value = option.values.empty() ? "yes" : option.values.front();
        const bool any = row.scope.elsewhere.empty();
        if (value == row.scope.elsewhere)
            EXPECT_EQ(refusal_of(words), "");
        else if (option.with.empty())
            EXPECT_EQ(refusal_of(words), "-" + row.name + (any ? "" : " " + value) + end);
        else
            EXPECT_NE(refusal_of(words), "");
        ++tried;
    }
    EXPECT_GT(tried, 16);
    for (const char* name : {"min_height", "min_confidence", "max_building_width"})
        EXPECT_EQ(refusal_of({"-preset", "thesis", "-" + std::string(name), find_option(name)->standard}),
                  "-" + std::string(name) + end);
}

TEST(OptionRules, leaveWhatMakesSense) {
    for (const Texts& words :
         std::vector<Texts>{{"-arcs", "-regularize", "auto"},
                            {"-arcs", "-preset", "thesis", "-regularize", "auto"},
                            {"-arcs", "-simplify", "0"},
                            {"-simplify", "1", "-regularize", "off"},
                            {"-disjoint", "-layers", "both"},
                            {"-fields", "own", "-layers", "contours"},
                            {"-fields", "osm", "-layers", "contours", "-write_doubtful"},
                            {"-preset", "thesis", "-ground", "none"},
                            {"-preset", "thesis", "-split_height", "0"},
                            {"-preset", "thesis", "-levels", "global"},
                            {"-max_building_width", "40", "-ground", "auto"},
                            {"-sweep", "lod=1..3", "-nf", "2"},
                            {"-sweep", "lod=1..3", "-title", "Town", "-preview", "p.png"},
                            {"-sweep", "lod=1..3", "-overwrite", "-preview", "p.png"},
                            {"-cutline", "a.gpkg", "-cutline_layer", "town"}})
        EXPECT_EQ(refusal_of(words), "") << words.front();
}

/// Whatever stands beside whatever else is taken, or refused by a sentence, in whatever order.
TEST(OptionRules, everyPairIsTakenOrRefusedByASentence) {
    const std::vector<OptionCase> cases = option_cases();
    for (const OptionCase& one : cases) {
        EXPECT_EQ(refusal_of(one.words()), "") << one.text();
        for (const OptionCase& other : cases) {
            if (one.name == other.name)
                continue;
            const std::string message = refusal_of(both(one, other));
            EXPECT_EQ(message, refusal_of(both(other, one))) << one.text() << " " << other.text();
            EXPECT_TRUE(message.empty() || is_a_sentence(message)) << message;
        }
    }
}

/// Options of a program that sets fields, not names.
std::string refusal(const Options& options) {
    return error_of([&] { check_options({options, {}}); });
}

TEST(OptionChecks, AnOffsetIsWhereIntervalsCanBeCountedFrom) {
    Options options;
    options.levels.interval = 1;
    options.levels.offset = 1e300;
    EXPECT_EQ(refusal(options),
              "-off 1e+300 is too far away to count intervals of 1 from; give a base near the elevations.");
    options.levels.offset = -1e13;
    EXPECT_EQ(refusal(options),
              "-off -10000000000000 is too far away to count intervals of 1 from; give a base near the "
              "elevations.");
    options.levels.offset = -8e12;
    EXPECT_EQ(refusal(options), "(no error)");
    options.levels.interval = 0.5;
    EXPECT_NE(refusal(options), "(no error)");
    options.levels.offset = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(options), "(no error)");
}

TEST(OptionChecks, ThesisRefusesFieldsOfWhatLooksForBuildings) {
    int tried = 0;
    for (const OptionCase& option : option_cases()) {
        const OptionRow& row = *find_option(option.name);
        Request request;
        for (std::size_t i = 0; i < option.with.size(); ++i) {
            if (!option.with[i].starts_with('-'))
                continue;
            const bool has_value = i + 1 < option.with.size() && !option.with[i + 1].starts_with('-');
            if (const OptionRow* other = find_option(option.with[i]))
                apply_option(*other, request, has_value ? Texts{option.with[i + 1]} : Texts{});
        }
        apply_option(row, request, option.values);
        if (row.has_meaning(Preset::thesis) || row.show(request) == row.standard ||
            row.show(request) == row.scope.elsewhere)
            continue;
        request.options.preset = Preset::thesis;
        request.options.given = {};
        EXPECT_NE(
            refusal(request.options).find(" has no effect with -preset thesis; it detects no buildings"),
            std::string::npos)
            << option.text();
        ++tried;
    }
    EXPECT_GT(tried, 16);
}

/// The default of an option is refused like any other value of it, where it was given by name.
TEST(OptionChecks, WhatIsGivenByNameIsKnown) {
    const std::vector<std::string> two{"2"};
    Request request;
    request.options.preset = Preset::thesis;
    request.options.detect.min_height = 2;
    EXPECT_NO_THROW(check_options(request));
    apply_option(*find_option("min_height"), request, two);
    EXPECT_THROW(check_options(request), OptionError);
    // A run sees the options alone.
    EXPECT_NE(refusal(request.options), "(no error)");
}

TEST(OptionChecks, RulesHoldForFieldsToo) {
    Options options;
    options.outline.simplify = 0.5;
    options.outline.walls = Walls::off;
    EXPECT_EQ(refusal(options), "(no error)");
    options.outline.walls = Walls::right;
    EXPECT_EQ(refusal(options),
              "-simplify 0.5 cannot be used together with -regularize right; straight walls need no "
              "simplification.");
    options = {};
    options.levels.fixed = {5};
    options.levels.interval = 5;
    EXPECT_EQ(refusal(options), "-fl cannot be used together with -i; list the levels or give an interval.");
    options = {};
    options.levels.offset = 5;
    EXPECT_EQ(refusal(options),
              "-off needs -i <interval>; it is the elevation that the intervals count from.");
}

TEST(SetOption, TakesTheNamesAndValuesOfTheCommandLine) {
    Options options;
    set_option(options, "lod", {"3"});
    set_option(options, "-min_area", {"50.5"});
    set_option(options, "disjoint");
    set_option(options, "srcwin", {"1", "2", "30", "40"});
    set_option(options, "threads", {"2"});
    EXPECT_EQ(options.levels.lod, 3);
    EXPECT_EQ(options.filter.min_area_m2, 50.5);
    EXPECT_TRUE(options.outline.disjoint);
    EXPECT_EQ(options.read.source_window, (std::array<double, 4>{1, 2, 30, 40}));
    EXPECT_EQ(options.run.threads, 2);
}

TEST(SetOption, RefusesWhatTheTableRefuses) {
    const auto refusal = [](const std::string& name, const Texts& values) {
        Options options;
        return error_of([&] { set_option(options, name, values); });
    };
    EXPECT_EQ(refusal("nonesuch", {"1"}),
              "There is no option 'nonesuch'; docs/reference/options.md lists all.");
    EXPECT_NE(refusal("lod", {"many"}).find("-lod must be"), std::string::npos);
    EXPECT_EQ(refusal("disjoint", {"1"}), "-disjoint takes no value.");
    EXPECT_EQ(refusal("json", {}), "-json is of the program alone; leave it out.");
    EXPECT_EQ(refusal("sweep", {"lod=1..3"}), "-sweep is of the program alone; leave it out.");
}

/// Options set before stay where the next is refused.
TEST(SetOption, LeavesOptionsAsTheyWereWhereItRefuses) {
    Options options;
    set_option(options, "lod", {"3"});
    EXPECT_THROW(set_option(options, "lod", {"0.5"}), OptionError);
    EXPECT_EQ(options.levels.lod, 3);
    EXPECT_EQ(options.given.count("lod"), 1U);
}

Options of(Preset preset) {
    Options options;
    options.preset = preset;
    return options;
}

RunPlan plan_of(const Options& options, Layers layers = Layers::both) {
    return make_run_plan(options, layers);
}

TEST(RunPlan, LeavesWhatIsGiven) {
    Options options = of(Preset::buildings);
    options.ground.mode = GroundMode::given;
    options.levels.source = LevelSource::global;
    options.trace.mode = TraceMode::points;
    options.outline.walls = Walls::right;
    options.filter.min_area_m2 = 12;
    RunPlan plan = plan_of(options);
    EXPECT_EQ(plan.ground, GroundMode::given);
    EXPECT_EQ(plan.levels, LevelSource::global);
    EXPECT_EQ(plan.trace, TraceMode::points);
    EXPECT_EQ(plan.walls, Walls::right);
    EXPECT_EQ(plan.building_m2, 12);
    EXPECT_EQ(plan.contour_m2, 0);

    options = of(Preset::thesis);
    options.trace.mode = TraceMode::cells;
    options.outline.walls = Walls::free;
    options.filter.min_area_m2 = 12;
    plan = plan_of(options);
    EXPECT_EQ(plan.trace, TraceMode::cells);
    EXPECT_EQ(plan.walls, Walls::free);
    EXPECT_EQ(plan.contour_m2, 12);
    EXPECT_EQ(plan.asked.filter.min_area_m2, 12);
}

TEST(RunPlan, AWallIsWorthHalfASquareMetreOrACellAndAQuarter) {
    EXPECT_EQ(RunPlan::wall_price(0.5), 2);
    EXPECT_EQ(RunPlan::wall_price(2.5), 1.25);
    EXPECT_EQ(RunPlan::wall_price(0), 1.25);  // nobody knows how large cells are
}

TEST(RunPlan, SimplifiedOutlinesHaveNoStraightWalls) {
    Options options;
    options.outline.simplify = 0.5;
    EXPECT_EQ(plan_of(options).walls, Walls::off);
}

/// Walls lie within 2.5 m of their steps unless another distance is asked for.
TEST(RunPlan, WallsMayLeaveTheirTraceByCellsOrMetres) {
    Options options;
    EXPECT_EQ(plan_of(options).wall_tolerance(0.5), 5);
    EXPECT_EQ(plan_of(options).wall_tolerance(1), 2.5);
    EXPECT_EQ(plan_of(options).wall_tolerance(2.5), 1.5);  // no slanted wall lies nearer to its staircase
    EXPECT_EQ(plan_of(options).wall_tolerance(0), 1.5);    // nobody knows how large cells are
    options.outline.wall_tolerance = 3;
    EXPECT_EQ(plan_of(options).wall_tolerance(2.5), 3);
}

TEST(RunPlan, DecidesWhatIsNotGiven) {
    const Options thesis = plan_of(of(Preset::thesis), Layers::contours).resolved();
    EXPECT_EQ(thesis.ground.mode, GroundMode::none);
    EXPECT_EQ(thesis.levels.source, LevelSource::global);
    EXPECT_EQ(thesis.trace.mode, TraceMode::points);
    EXPECT_EQ(thesis.outline.walls, Walls::off);
    EXPECT_EQ(thesis.filter.min_area_m2, 0);
    EXPECT_EQ(thesis.write.layers, Layers::contours);
    EXPECT_EQ(plan_of(of(Preset::buildings)).resolved().filter.min_area_m2, 30);
}

/// A format that holds one layer gets the buildings alone.
TEST(RunPlan, RefusesWhatStandsInLayersThatAreNotWritten) {
    const auto refusal = [](const Options& options, Layers layers) {
        return error_of([&] { static_cast<void>(make_run_plan(options, layers)); });
    };
    Options options;
    options.outline.disjoint = true;
    for (const Layers layers : {Layers::both, Layers::contours})
        EXPECT_EQ(refusal(options, layers), "(no error)");
    EXPECT_EQ(refusal(options, Layers::buildings),
              "-disjoint has no effect if only buildings are written; use -layers contours, or a format that "
              "holds both layers, such as GeoPackage.");
    options = {};
    options.write.fields = FieldNames::osm;
    EXPECT_EQ(
        refusal(options, Layers::contours),
        "-fields has no effect if only contours are written; only fields of buildings have other names.");
    options.write.doubtful = true;
    EXPECT_EQ(refusal(options, Layers::contours), "(no error)");
}

}  // namespace
}  // namespace d2b::test
