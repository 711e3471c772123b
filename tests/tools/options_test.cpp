#include <array>
#include <clocale>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/option_checks.hpp"
#include "options/option_values.hpp"
#include "tools/parse.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;
using Four = std::array<double, 4>;

TEST(OptionTable, holdsTheseOptions) {
    std::set<std::string> names;
    for (const OptionRow& row : option_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        for (const std::string& alias : row.aliases)
            EXPECT_TRUE(names.insert(alias).second) << alias;
    }
    const std::set<std::string> expected{"preset",
                                         "lod",
                                         "fl",
                                         "i",
                                         "off",
                                         "trace",
                                         "nf",
                                         "min_area",
                                         "b",
                                         "oo",
                                         "if",
                                         "a_srs",
                                         "te",
                                         "zunit",
                                         "zrange",
                                         "snodata",
                                         "inodata",
                                         "srcwin",
                                         "projwin",
                                         "cutline",
                                         "cutline_layer",
                                         "mask_layer",
                                         "cutline_layer",
                                         "mask_layer",
                                         "layers",
                                         "t_srs",
                                         "3d",
                                         "f",
                                         "of",
                                         "disjoint",
                                         "simplify",
                                         "output_format",
                                         "dsco",
                                         "co",
                                         "lco",
                                         "nln",
                                         "q",
                                         "quiet",
                                         "append",
                                         "json",
                                         "threads",
                                         "overwrite",
                                         "help",
                                         "h",
                                         "version",
                                         "p",
                                         "man",
                                         "options_md",
                                         "options_json",
                                         "bash_completion",
                                         "ground",
                                         "max_building_width",
                                         "min_height",
                                         "min_building_height",
                                         "min_confidence",
                                         "mask",
                                         "ndvi",
                                         "split_height",
                                         "split_by",
                                         "split_layer",
                                         "split_field",
                                         "split_width",
                                         "levels",
                                         "detail",
                                         "regularize",
                                         "regularize_tolerance",
                                         "wall_inset",
                                         "arcs",
                                         "flow_ready",
                                         "min_gap",
                                         "min_wall",
                                         "fields",
                                         "write_doubtful",
                                         "write_rejected",
                                         "write_problems",
                                         "write_problems",
                                         "write_ground",
                                         "write_height",
                                         "write_canopy",
                                         "surface",
                                         "surface_of",
                                         "surface_roof",
                                         "surface_solids",
                                         "surface_origin",
                                         "page",
                                         "preview",
                                         "preview_size",
                                         "sweep"};
    EXPECT_EQ(names, expected);
}

TEST(OptionTable, saysAllOfEveryOption) {
    for (const OptionRow& row : option_table()) {
        EXPECT_FALSE(row.help.empty()) << row.name;
        EXPECT_EQ(row.help.back(), '.') << row.name;
        EXPECT_EQ(row.title.empty(), row.hidden) << row.name;
        EXPECT_TRUE(row.details.empty() || row.details.back() == '.') << row.name;
        EXPECT_EQ(row.values.empty(), row.arity == Arity::none) << row.name;
        EXPECT_TRUE(row.apply) << row.name;
        EXPECT_TRUE(row.texts) << row.name;
        EXPECT_EQ(row.kind == OptionKind::toggle, row.arity == Arity::none) << row.name;
        EXPECT_EQ(row.has_meaning(Preset::thesis), row.scope.why.empty()) << row.name;
        EXPECT_TRUE(row.has_meaning(Preset::buildings)) << row.name;
    }
}

TEST(OptionTable, namesEachWordOfAChoiceOnce) {
    const auto choices = [](const char* name) { return find_option(name)->choices; };
    EXPECT_EQ(choices("preset"), (Texts{"buildings", "thesis"}));
    EXPECT_EQ(choices("ground"), (Texts{"auto", "none"}));
    EXPECT_EQ(find_option("ground")->values, "auto|none|<terrain model>");
    EXPECT_EQ(choices("zunit"), (Texts{"m", "ft", "us-ft"}));
    for (const OptionRow& row : option_table()) {
        if (row.kind != OptionKind::choice)
            continue;
        EXPECT_EQ(row.values, joined(row.choices, "|")) << row.name;
        EXPECT_EQ(row.range, alternatives(row.choices)) << row.name;
        for (const std::string& word : row.choices) {
            Request request;
            const Texts text{word};
            apply_option(row, request, text);
            EXPECT_EQ(row.show(request), word) << row.name;
        }
    }
}

TEST(OptionTable, saysWhatAValueIs) {
    for (const auto& [name, kind] : std::map<std::string, OptionKind>{{"preset", OptionKind::choice},
                                                                      {"lod", OptionKind::whole},
                                                                      {"min_height", OptionKind::number},
                                                                      {"fl", OptionKind::numbers},
                                                                      {"srcwin", OptionKind::numbers},
                                                                      {"te", OptionKind::extent},
                                                                      {"t_srs", OptionKind::crs},
                                                                      {"ndvi", OptionKind::raster},
                                                                      {"cutline", OptionKind::polygons},
                                                                      {"mask", OptionKind::dataset},
                                                                      {"ground", OptionKind::terrain},
                                                                      {"write_canopy", OptionKind::geotiff},
                                                                      {"preview", OptionKind::picture},
                                                                      {"surface", OptionKind::surface},
                                                                      {"page", OptionKind::page},
                                                                      {"zunit", OptionKind::text},
                                                                      {"arcs", OptionKind::toggle}})
        EXPECT_EQ(find_option(name)->kind, kind) << name;
    EXPECT_EQ(option_kind_names[static_cast<std::size_t>(OptionKind::toggle)], "switch");
    EXPECT_EQ(option_kind_names[static_cast<std::size_t>(OptionKind::picture)], "file:png,svg,pdf");
    EXPECT_EQ(option_kind_names[static_cast<std::size_t>(OptionKind::page)], "file:html");
    EXPECT_EQ(option_kind_names[static_cast<std::size_t>(OptionKind::text)], "text");
}

/// What a dialog says in place of the name of an option.
TEST(OptionTable, hasTitlesThatADialogTellsApart) {
    std::set<std::string> titles;
    for (const OptionRow& row : option_table()) {
        if (row.hidden)
            continue;
        EXPECT_TRUE(titles.insert(row.title).second) << row.title;
        EXPECT_TRUE(std::isupper(row.title.front())) << row.title;
        EXPECT_EQ(row.title.find_first_of(".-\""), std::string::npos) << row.title;
    }
    EXPECT_EQ(find_option("ndvi")->section, DialogSection::trees);
    EXPECT_EQ(find_option("if")->section, DialogSection::advanced);
    EXPECT_EQ(dialog_section_names[static_cast<std::size_t>(DialogSection::trees)], "Trees");
    EXPECT_EQ(dialog_section_names[static_cast<std::size_t>(DialogSection::advanced)], "Advanced");
}

/// Names of arguments of Python: none is a keyword, or what extract() itself takes.
TEST(OptionTable, hasNamesThatPythonCanSpell) {
    const std::set<std::string> taken{"if",  "in",  "is",  "as",        "or",       "not", "and", "lambda",
                                      "for", "def", "dem", "transform", "progress", "src", "dst"};
    std::set<std::string> names;
    for (const OptionRow& row : option_table()) {
        const PythonUse& python = row.python;
        EXPECT_EQ(python.name.empty(), !python.extract && !python.extract_file) << row.name;
        EXPECT_TRUE(!python.extract || python.extract_file) << row.name;
        if (python.name.empty())
            continue;
        EXPECT_TRUE(std::regex_match(python.name, std::regex("[a-z][a-z_0-9]*"))) << row.name;
        EXPECT_FALSE(taken.contains(python.name)) << row.name;
        EXPECT_TRUE(names.insert(python.name).second) << row.name;
    }
    EXPECT_EQ(find_option("3d")->python.name, "with_z");
    EXPECT_EQ(find_option("if")->python.name, "input_format");
    for (const char* neither : {"p", "q", "json", "sweep", "help", "version", "man"})
        EXPECT_EQ(find_option(neither)->python.name, "") << neither;
    for (const char* of_files : {"f", "dsco", "nln", "overwrite", "write_ground", "preview", "arcs"}) {
        EXPECT_TRUE(find_option(of_files)->python.extract_file) << of_files;
        EXPECT_FALSE(find_option(of_files)->python.extract) << of_files;
    }
}

TEST(OptionTable, knowsWhatWasGiven) {
    const OptionRow& row = *find_option("min_height");
    Request request;
    EXPECT_FALSE(row.is_given(request));
    request.options.detect.min_height = 3;
    EXPECT_TRUE(row.is_given(request));
    Request by_name;
    const Texts text{"2"};  // its default
    apply_option(row, by_name, text);
    EXPECT_TRUE(row.is_given(by_name));
    EXPECT_EQ(row.show(by_name), row.standard);
}

TEST(OptionTable, findsNamesWithDashesAndAliases) {
    EXPECT_EQ(find_option("lod")->name, "lod");
    EXPECT_EQ(find_option("-lod")->name, "lod");
    EXPECT_EQ(find_option("--output_format")->name, "f");
    EXPECT_EQ(find_option("lo"), nullptr);
    EXPECT_EQ(find_option("---lod"), nullptr);
    EXPECT_EQ(find_option(""), nullptr);
}

TEST(OptionTable, defaultsAreThoseOfTheOptions) {
    const Options standard;
    EXPECT_EQ(find_option("preset")->standard, preset_name(standard.preset));
    EXPECT_EQ(find_option("b")->standard, std::to_string(standard.read.band));
    EXPECT_EQ(find_option("lod")->standard, std::to_string(standard.levels.lod));
    EXPECT_EQ(find_option("nf")->standard, std::to_string(standard.filter.noise_factor));
    EXPECT_EQ(find_option("max_building_width")->standard, number_text(standard.ground.max_building_width));
    EXPECT_EQ(find_option("min_height")->standard, number_text(standard.detect.min_height));
    EXPECT_EQ(find_option("min_building_height")->standard, "0");
    EXPECT_EQ(find_option("min_confidence")->standard, number_text(standard.detect.min_confidence));
    EXPECT_EQ(find_option("regularize_tolerance")->standard, "");
    EXPECT_EQ(find_option("split_height")->standard, "0");
    EXPECT_EQ(find_option("fields")->standard, "own");
    EXPECT_EQ(find_option("surface_roof")->standard, "mean");
    EXPECT_EQ(find_option("surface_solids")->standard, "each");
    EXPECT_EQ(find_option("off")->standard, "0");
    EXPECT_EQ(find_option("simplify")->standard, "0");
    EXPECT_EQ(find_option("flow_ready")->standard, "0");
    for (const char* name : {"ground",
                             "min_gap",
                             "min_wall",
                             "levels",
                             "trace",
                             "min_area",
                             "regularize",  // what the preset decides
                             "mask",
                             "ndvi",
                             "arcs",
                             "write_doubtful",
                             "write_rejected",
                             "write_ground",
                             "write_height",
                             "write_canopy",
                             "surface",
                             "surface_of",  // what the preset decides
                             "surface_origin",
                             "page",
                             "fl",
                             "i",
                             "oo",
                             "if",
                             "a_srs",
                             "snodata",
                             "inodata",
                             "srcwin",
                             "projwin",
                             "te",
                             "cutline",
                             "zunit",
                             "layers",
                             "disjoint",
                             "t_srs",
                             "3d",
                             "f",
                             "dsco",
                             "lco",
                             "nln",
                             "overwrite",
                             "append",
                             "q",
                             "json",
                             "help",
                             "version"})
        EXPECT_EQ(find_option(name)->standard, "") << name;
}

TEST(OptionTable, defaultAsTextSetsTheDefault) {
    for (const OptionRow& row : option_table()) {
        if (row.standard.empty())
            continue;
        Request request;
        const Texts text{row.standard};
        apply_option(row, request, text);
        EXPECT_EQ(row.show(request), row.standard) << row.name;
    }
}

TEST(Options, withoutAnyAreTheDefaults) {
    const Request request = parse({});
    for (const OptionRow& row : option_table())
        EXPECT_EQ(row.show(request), row.standard) << row.name;
    EXPECT_EQ(request.options.read.source, "in.tif");
    EXPECT_EQ(request.options.write.destination, "out.gpkg");
    EXPECT_EQ(request.options.write.layers, std::nullopt);
}

TEST(Options, ofTheInput) {
    const auto read = [](const Texts& arguments) { return parse(arguments).options.read; };
    EXPECT_EQ(read({"-b", "3"}).band, 3);
    EXPECT_EQ(read({"-oo", "A=1", "-oo", "B=x=y"}).open_options, (Texts{"A=1", "B=x=y"}));
    EXPECT_EQ(read({"-if", "GTiff", "-if", "VRT"}).drivers, (Texts{"GTiff", "VRT"}));
    EXPECT_EQ(read({"-a_srs", "EPSG:25832+7837"}).crs, "EPSG:25832+7837");
    EXPECT_EQ(read({"-snodata", "-9999"}).nodata, -9999.0);
    EXPECT_TRUE(read({"-inodata"}).ignore_nodata);
    EXPECT_EQ(read({"-srcwin", "0", "10", "20", "30"}).source_window, (Four{0, 10, 20, 30}));
    EXPECT_EQ(read({"-projwin", "-10", "5", "10.5", "-5"}).projected_window, (Four{-10, 5, 10.5, -5}));
    EXPECT_EQ(read({"-te", "-10", "-20", "1e3", "2000.25"}).extent, (Four{-10, -20, 1000, 2000.25}));
    EXPECT_EQ(read({"-cutline", "area.gpkg"}).cutline, "area.gpkg");
    EXPECT_EQ(read({"-cutline", "area.gpkg", "-cutline_layer", "town"}).cutline_layer, "town");
    for (const char* unit : {"m", "ft", "us-ft", "0.3048", "1e-3"})
        EXPECT_EQ(read({"-zunit", unit}).vertical_unit, unit);
    EXPECT_EQ(read({"-zrange", "-10", "2.5e3"}).elevation_range, (std::array<double, 2>{-10, 2500}));
}

TEST(Options, ofTheGround) {
    const auto ground = [](const Texts& arguments) { return parse(arguments).options.ground; };
    EXPECT_EQ(ground({}).mode, std::nullopt);
    EXPECT_EQ(ground({"-ground", "auto"}).mode, GroundMode::automatic);
    EXPECT_EQ(ground({"-ground", "none"}).mode, GroundMode::none);
    EXPECT_EQ(ground({"-ground", "none"}).terrain, "");
    for (const char* file : {"dtm.tif", "./auto", "./none"}) {
        EXPECT_EQ(ground({"-ground", file}).mode, GroundMode::given) << file;
        EXPECT_EQ(ground({"-ground", file}).terrain, file);
        EXPECT_EQ(find_option("ground")->show(parse({"-ground", file})), file);
    }
    EXPECT_EQ(ground({"-max_building_width", "120.5"}).max_building_width, 120.5);
}

TEST(Options, ofDetection) {
    const auto detect = [](const Texts& arguments) { return parse(arguments).options.detect; };
    EXPECT_EQ(parse({"-preset", "thesis"}).options.preset, Preset::thesis);
    EXPECT_EQ(parse({"-preset", "buildings"}).options.preset, Preset::buildings);
    EXPECT_EQ(detect({"-min_height", "3.5"}).min_height, 3.5);
    EXPECT_EQ(detect({"-min_building_height", "10"}).min_building_height, 10);
    EXPECT_EQ(detect({"-min_confidence", "1"}).min_confidence, 1);
    EXPECT_EQ(detect({"-min_confidence", "0"}).min_confidence, 0);
    EXPECT_EQ(detect({"-mask", "area.gpkg"}).mask, "area.gpkg");
    EXPECT_EQ(detect({"-mask", "area.gpkg", "-mask_layer", "town"}).mask_layer, "town");
    EXPECT_EQ(detect({"-ndvi", "ndvi.tif"}).ndvi, "ndvi.tif");
    EXPECT_EQ(detect({"-split_height", "4"}).split_height, 4);
    const DetectOptions cut =
        detect({"-split_by", "p.gpkg", "-split_layer", "l", "-split_field", "f", "-split_width", "2"});
    EXPECT_EQ(cut.split_by, "p.gpkg");
    EXPECT_EQ(cut.split_layer, "l");
    EXPECT_EQ(cut.split_field, "f");
    EXPECT_EQ(cut.split_width, 2);
    EXPECT_TRUE(cut.is_split_by());
    EXPECT_FALSE(detect({}).is_split_by());
}

TEST(Options, ofLevels) {
    const auto levels = [](const Texts& arguments) { return parse(arguments).options.levels; };
    EXPECT_EQ(levels({"-levels", "building"}).source, LevelSource::building);
    EXPECT_EQ(levels({"-levels", "natural"}).source, LevelSource::natural);
    EXPECT_EQ(levels({"-levels", "global"}).source, LevelSource::global);
    EXPECT_EQ(levels({}).source, std::nullopt);
    EXPECT_EQ(levels({"-lod", "1"}).lod, 1);
    EXPECT_EQ(levels({"-detail", "1.5"}).detail, 1.5);
    EXPECT_EQ(levels({}).detail, std::nullopt);
    EXPECT_EQ(levels({"-lod", "10000"}).lod, 10000);
    EXPECT_EQ(levels({"-lod", "+7"}).lod, 7);
    EXPECT_EQ(levels({"-fl", "10", "12.5", "-3"}).fixed, (std::vector<double>{10, 12.5, -3}));
    EXPECT_EQ(levels({"-i", "2.5"}).interval, 2.5);
    EXPECT_EQ(levels({"-i", "2.5", "-off", "-1.25"}).offset, -1.25);
}

TEST(Options, ofContours) {
    EXPECT_EQ(parse({"-trace", "cells"}).options.trace.mode, TraceMode::cells);
    EXPECT_EQ(parse({"-trace", "points"}).options.trace.mode, TraceMode::points);
    EXPECT_EQ(parse({"-nf", "0"}).options.filter.noise_factor, 0);
    EXPECT_EQ(parse({"-min_area", "12.5"}).options.filter.min_area_m2, 12.5);
    EXPECT_EQ(parse({}).options.filter.min_area_m2, std::nullopt);
    EXPECT_EQ(parse({}).options.outline.walls, std::nullopt);
    EXPECT_EQ(parse({"-regularize", "auto"}).options.outline.walls, Walls::automatic);
    EXPECT_EQ(parse({"-regularize", "off"}).options.outline.walls, Walls::off);
    EXPECT_EQ(parse({"-regularize", "right"}).options.outline.walls, Walls::right);
    EXPECT_EQ(parse({"-regularize", "free"}).options.outline.walls, Walls::free);
    EXPECT_EQ(parse({"-regularize_tolerance", "0.75"}).options.outline.wall_tolerance, 0.75);
    EXPECT_EQ(parse({}).options.outline.wall_inset, 0);
    EXPECT_EQ(parse({"-wall_inset", "0.25"}).options.outline.wall_inset, 0.25);
    EXPECT_EQ(parse({"-flow_ready", "1.5"}).options.outline.narrowest_gap(), 1.5);
    EXPECT_EQ(parse({"-flow_ready", "1.5"}).options.outline.shortest_wall(), 1.5);
    EXPECT_EQ(parse({"-flow_ready", "1.5", "-min_gap", "0"}).options.outline.narrowest_gap(), 0);
    EXPECT_EQ(parse({"-min_wall", "0.5"}).options.outline.shortest_wall(), 0.5);
    EXPECT_EQ(parse({"-min_wall", "0.5"}).options.outline.narrowest_gap(), 0);
    EXPECT_TRUE(parse({"-arcs"}).options.outline.arcs);
    EXPECT_EQ(parse({"-simplify", "0.5"}).options.outline.simplify, 0.5);
    EXPECT_TRUE(parse({"-disjoint"}).options.outline.disjoint);
}

TEST(Options, ofTheOutput) {
    const auto write = [](const Texts& arguments) { return parse(arguments).options.write; };
    EXPECT_EQ(write({"-layers", "buildings"}).layers, Layers::buildings);
    EXPECT_EQ(write({"-layers", "contours"}).layers, Layers::contours);
    EXPECT_EQ(write({"-layers", "both"}).layers, Layers::both);
    EXPECT_EQ(parse({"-t_srs", "EPSG:4326"}).options.outline.target_crs, "EPSG:4326");
    EXPECT_TRUE(write({"-3d"}).with_z);
    for (const char* name : {"-f", "-of", "-output_format"})
        EXPECT_EQ(write({name, "ESRI Shapefile"}).format, "ESRI Shapefile") << name;
    for (const char* name : {"-dsco", "-co"})
        EXPECT_EQ(write({name, "VERSION=1.3"}).dataset_options, (Texts{"VERSION=1.3"})) << name;
    EXPECT_EQ(write({"-dsco", "A=1", "-co", "B=2"}).dataset_options, (Texts{"A=1", "B=2"}));
    EXPECT_EQ(write({"-lco", "FID=id", "-lco", "EMPTY="}).layer_options, (Texts{"FID=id", "EMPTY="}));
    EXPECT_EQ(write({"-nln", "roofs"}).layer_name, "roofs");
    EXPECT_TRUE(write({"-overwrite"}).overwrite);
    EXPECT_TRUE(write({"-append"}).append);
    EXPECT_EQ(write({"-fields", "own"}).fields, FieldNames::own);
    EXPECT_EQ(write({"-fields", "urock"}).fields, FieldNames::urock);
    EXPECT_EQ(write({"-fields", "city4cfd"}).fields, FieldNames::city4cfd);
    EXPECT_EQ(write({"-fields", "osm"}).fields, FieldNames::osm);
    EXPECT_TRUE(write({"-write_doubtful"}).doubtful);
    EXPECT_TRUE(write({"-write_rejected"}).rejected);
    EXPECT_EQ(write({"-page", "a.html"}).page, "a.html");
    EXPECT_TRUE(write({"-surface", "a.obj", "-write_problems"}).problems);
    EXPECT_EQ(write({"-write_ground", "g.tif"}).ground, "g.tif");
    EXPECT_EQ(write({"-write_height", "h.tif"}).height, "h.tif");
    EXPECT_EQ(write({"-write_canopy", "c.tif"}).canopy, "c.tif");
    EXPECT_EQ(write({"-surface", "a.obj", "-surface", "b.obj"}).surfaces, (Texts{"a.obj", "b.obj"}));
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_of", "contours"}).surface_of, SurfaceOf::contours);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_of", "buildings"}).surface_of, SurfaceOf::buildings);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_roof", "p50"}).surface_roof, SurfaceRoof::p50);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_roof", "max"}).surface_roof, SurfaceRoof::max);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_roof", "mean"}).surface_roof, SurfaceRoof::mean);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_solids", "one"}).surface_solids, SurfaceSolids::one);
    EXPECT_EQ(write({"-surface", "a.obj", "-surface_origin", "1", "-2", "3"}).surface_origin,
              (std::array<double, 3>{1, -2, 3}));
    EXPECT_EQ(find_option("p")->show(parse({"-p"})), "");  // accepted, changes nothing
}

TEST(Options, ofTheReport) {
    for (const char* name : {"-q", "-quiet"})
        EXPECT_TRUE(parse({name}).tool.quiet) << name;
    EXPECT_TRUE(parse({"-json"}).tool.json);
    EXPECT_TRUE(parse({"-json"}).tool.quiet);
    for (const char* name : {"-help", "-h", "--help", "--h"})
        EXPECT_TRUE(parse_command_line({name}).tool.help) << name;
    EXPECT_TRUE(parse_command_line({"-version"}).tool.version);
    EXPECT_TRUE(parse_command_line({"-man"}).tool.man_page);
    EXPECT_TRUE(parse_command_line({"-options_md"}).tool.options_markdown);
    EXPECT_TRUE(parse_command_line({"-options_json"}).tool.options_json);
    EXPECT_TRUE(parse_command_line({"-bash_completion"}).tool.bash_completion);
}

TEST(Options, aSweepIsEveryPairOfItsNumbers) {
    const auto sweep_of = [](const std::string& text) { return parse_sweep(text); };
    EXPECT_EQ(sweep_of("lod=1..6,nf=5..60").lods, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(sweep_of("lod=1..6,nf=5..60").noise_factors, (std::vector<int>{5, 16, 27, 38, 49, 60}));
    EXPECT_EQ(sweep_of("nf=5..21..5").noise_factors, (std::vector<int>{5, 10, 15, 20}));
    EXPECT_TRUE(sweep_of("nf=5..21..5").lods.empty());
    EXPECT_EQ(sweep_of("nf=7").noise_factors, std::vector<int>{7});
    EXPECT_EQ(sweep_of("lod=3..3").lods, std::vector<int>{3});
    EXPECT_EQ(sweep_of("nf=0..1000000000..1000000000").noise_factors, (std::vector<int>{0, 1000000000}));
    EXPECT_EQ(sweep_of("detail=0..2..0.5,lod=4").details, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
    EXPECT_EQ(sweep_of("detail=0..1..0.1").details.size(), 11U);
    EXPECT_EQ(sweep_of("detail=0..3").details, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(sweep_of("detail=0.5..3").details, (std::vector<double>{0.5, 1, 1.5, 2, 2.5, 3}));
    EXPECT_EQ(sweep_of("detail=1.5").details, std::vector<double>{1.5});
    for (const char* wrong : {"detail=",
                              "detail=-1..2",
                              "detail=2..1",
                              "detail=0..1..0",
                              "detail=0..1000..0.1",
                              "detail=0,detail=1",
                              "detail=0..1..0.5..2",
                              "detail=nan",
                              "lod",
                              "lod=",
                              "lod=0..3",
                              "lod=3..1",
                              "nf=1..2..0",
                              "lod=1..2..3..4",
                              "x=1",
                              "lod=1,lod=2",
                              "lod=1..2,",
                              "nf=1.5",
                              "nf=0..1000000000..1",
                              "lod=1..20..1,nf=0..30..1"})
        EXPECT_THROW((void)sweep_of(wrong), OptionError) << wrong;
}

TEST(Sweep, aSheetHoldsWhatCanBeRead) {
    EXPECT_NO_THROW(require_legible(16, 1600));
    EXPECT_NO_THROW(require_legible(17, 2000));
    EXPECT_NO_THROW(require_legible(1, 200));
    const auto refused = [](const std::vector<std::string>& words) {
        try {
            static_cast<void>(parse_command_line(words));
            return std::string();
        } catch (const OptionError& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(refused({"-sweep", "lod=1..6,nf=5..60", "-preview", "p.png", "in.tif"}),
              "-sweep names 36 trials, and a picture of 1600 pixels has room for 16 that can be read; name "
              "fewer values, or give -preview_size 2400.");
    EXPECT_EQ(
        refused({"-sweep", "lod=1..2", "-preview", "p.png", "-preview_size", "300", "in.tif"}),
        "-sweep names 2 trials, and a picture of 300 pixels has room for 1 that can be read; name fewer "
        "values, or give -preview_size 800.");
    EXPECT_EQ(refused({"-sweep", "lod=1..6,nf=5..60", "in.tif"}), "");
    EXPECT_EQ(
        refused({"-sweep", "lod=1..6,nf=5..60", "-preview", "p.png", "-preview_size", "2400", "in.tif"}), "");
}

TEST(Options, everyOptionChangesWhatItShows) {
    const std::vector<Texts> command_lines{{"-lod", "5"},
                                           {"-fl", "1"},
                                           {"-i", "1"},
                                           {"-i", "1", "-off", "2"},
                                           {"-trace", "cells"},
                                           {"-nf", "3"},
                                           {"-min_area", "4"},
                                           {"-min_building_height", "4"},
                                           {"-b", "2"},
                                           {"-oo", "A=B"},
                                           {"-if", "VRT"},
                                           {"-a_srs", "x"},
                                           {"-snodata", "0"},
                                           {"-inodata"},
                                           {"-cutline", "x"},
                                           {"-cutline", "x", "-cutline_layer", "y"},
                                           {"-zunit", "ft"},
                                           {"-zrange", "-10", "100"},
                                           {"-srcwin", "0", "0", "1", "1"},
                                           {"-disjoint"},
                                           {"-t_srs", "x"},
                                           {"-3d"},
                                           {"-projwin", "0", "1", "1", "0"},
                                           {"-simplify", "1"},
                                           {"-f", "x"},
                                           {"-dsco", "A=B"},
                                           {"-te", "0", "0", "1", "1"},
                                           {"-lco", "A=B"},
                                           {"-nln", "x"},
                                           {"-overwrite"},
                                           {"-append"},
                                           {"-q"},
                                           {"-json"},
                                           {"-threads", "2"},
                                           {"-layers", "both"},
                                           {"-help"},
                                           {"-version"},
                                           {"-man"},
                                           {"-options_md"},
                                           {"-options_json"},
                                           {"-bash_completion"},
                                           {"-preset", "thesis"},
                                           {"-ground", "none"},
                                           {"-max_building_width", "90"},
                                           {"-min_height", "3"},
                                           {"-min_confidence", "0.4"},
                                           {"-mask", "x"},
                                           {"-mask", "x", "-mask_layer", "y"},
                                           {"-ndvi", "x"},
                                           {"-split_height", "3"},
                                           {"-split_by", "x"},
                                           {"-split_by", "x", "-split_layer", "y"},
                                           {"-split_by", "x", "-split_field", "y"},
                                           {"-split_by", "x", "-split_width", "2"},
                                           {"-levels", "global"},
                                           {"-detail", "1"},
                                           {"-regularize", "off"},
                                           {"-regularize_tolerance", "1"},
                                           {"-wall_inset", "0.25"},
                                           {"-arcs"},
                                           {"-flow_ready", "1"},
                                           {"-min_gap", "1"},
                                           {"-min_wall", "1"},
                                           {"-fields", "osm"},
                                           {"-write_doubtful"},
                                           {"-write_rejected"},
                                           {"-write_ground", "x"},
                                           {"-write_height", "x"},
                                           {"-surface", "x"},
                                           {"-surface", "x", "-surface_of", "contours"},
                                           {"-surface", "x", "-surface_roof", "p90"},
                                           {"-surface", "x.stl", "-surface_solids", "one"},
                                           {"-surface", "x", "-surface_origin", "1", "2", "3"},
                                           {"-surface", "x", "-write_problems"},
                                           {"-page", "x"},
                                           {"-preview", "x"},
                                           {"-preview", "x", "-preview_size", "800"},
                                           {"-sweep", "lod=1..2"},
                                           {"-write_canopy", "x"}};
    std::set<std::string> seen{"p"};  // no effect
    for (const Texts& arguments : command_lines) {
        const bool needs_the_first =
            arguments.size() >= 3 &&
            (arguments[2] == "-off" || arguments[2] == "-preview_size" ||
             arguments[2].starts_with("-surface_") || arguments[2].starts_with("-split_") ||
             arguments[2] == "-write_problems" || arguments[2].ends_with("_layer"));
        const OptionRow& row = *find_option(arguments[needs_the_first ? 2 : 0]);
        EXPECT_NE(row.show(parse(arguments)), row.standard) << row.name;
        seen.insert(row.name);
    }
    for (const OptionRow& row : option_table())
        EXPECT_TRUE(seen.contains(row.name)) << row.name;
}

TEST(Options, showFourNumbersAndLists) {
    const Request request =
        parse({"-te", "-1.5", "0", "1", "2", "-fl", "3", "4.25", "-oo", "A=1", "-oo", "B=2"});
    EXPECT_EQ(find_option("te")->show(request), "-1.5 0 1 2");
    EXPECT_EQ(find_option("fl")->show(request), "3 4.25");
    EXPECT_EQ(find_option("oo")->show(request), "A=1 B=2");
}

TEST(OptionValues, doNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"})
        if (std::setlocale(LC_ALL, locale) != nullptr)
            break;
    EXPECT_EQ(parse({"-i", "2.5"}).options.levels.interval, 2.5);
    EXPECT_EQ(refusal({"-i", "2,5"}), "-i must be a number above 0, not '2,5'.");
    EXPECT_EQ(number_text(0.1), "0.1");
    std::setlocale(LC_ALL, before.c_str());
}

TEST(OptionValues, areShortestAndReadBack) {
    EXPECT_EQ(number_text(10), "10");
    EXPECT_EQ(number_text(-0.25), "-0.25");
    EXPECT_EQ(number_text(1000000), "1000000");
    EXPECT_EQ(number_text(1e300), "1e+300");
    EXPECT_EQ(read_number({}, number_text(1.0 / 3)), 1.0 / 3);
}

TEST(OptionValues, lookLikeNumbers) {
    for (const char* text : {"1", "-1", "+1", "1.", ".5", "-.5", "1e5", "1E-5", "nan", "-inf", "1e999"})
        EXPECT_TRUE(looks_like_number(text)) << text;
    for (const char* text : {"", "-", "+", "+-1", "1m", "0x10", "./1", "1,5", " 1", "1 ", "dsm.tif"})
        EXPECT_FALSE(looks_like_number(text)) << text;
}

TEST(NearestName, isTheOneThatWasMeant) {
    const Texts names{"lod", "overwrite", "quiet", "te", "b", "srcwin"};
    EXPECT_EQ(nearest_name("lodd", names), "lod");
    EXPECT_EQ(nearest_name("LOD", names), "lod");
    EXPECT_EQ(nearest_name("quite", names), "quiet");     // neighbours swapped
    EXPECT_EQ(nearest_name("over", names), "overwrite");  // a beginning
    EXPECT_EQ(nearest_name("overwite", names), "overwrite");
    EXPECT_EQ(nearest_name("scrwin", names), "srcwin");
    EXPECT_EQ(nearest_name("B", names), "b");
    EXPECT_EQ(nearest_name("x", names), "");  // any other letter is not near
    EXPECT_EQ(nearest_name("frobnicate", names), "");
}

}  // namespace
}  // namespace d2b::test
