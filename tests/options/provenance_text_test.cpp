#include "options/provenance_text.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "dem2buildings/command_line.hpp"
#include "options/option_scene.hpp"
#include "options/option_table.hpp"
#include "support/run_tool.hpp"

namespace d2b::test {
namespace {

Options options_of(const Texts& words) {
    Texts all = words;
    all.insert(all.end(), {"--", "in.tif", "out.gpkg"});
    return parse_command_line(all).options;
}

/// The words as a shell splits them.
Texts split(const std::string& text) {
    const std::string lines =
        run_tool(
            {"/bin/sh", "-c", "eval \"set -- $1\"; for word; do printf '%s\\n' \"$word\"; done", "sh", text})
            .out;
    Texts words;
    for (std::size_t at = 0; at < lines.size();) {
        const std::size_t end = lines.find('\n', at);
        words.push_back(lines.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

TEST(GivenWords, areThoseOfTheCommandLine) {
    EXPECT_EQ(reproducing_arguments({}), "");
    EXPECT_EQ(
        reproducing_arguments(options_of({"-q", "-threads", "2", "-overwrite", "-write_ground", "g.tif"})),
        "");
    EXPECT_EQ(reproducing_arguments(
                  options_of({"-nf", "10", "-preset", "thesis", "-fl", "-3", "12.5", "1e-7", "-3d"})),
              "-preset thesis -fl -3 12.5 1e-07 -nf 10 -3d");
    EXPECT_EQ(reproducing_arguments(options_of({"-te", "0", "-1", "2", "3.5", "-oo", "A=1", "-oo", "B=x y"})),
              "-oo A=1 -oo 'B=x y' -te 0 -1 2 3.5");
    EXPECT_EQ(
        reproducing_arguments(options_of({"-nln", "Bob's roofs", "-cutline=-a.gpkg", "-snodata", "-9999"})),
        "-snodata -9999 -cutline=-a.gpkg -nln 'Bob'\\''s roofs'");
}

TEST(GivenWords, areThoseOfFieldsThatAreSet) {
    Options options;
    options.preset = Preset::thesis;
    options.detect.mask = "mask.gpkg";
    options.write.layers = Layers::contours;
    EXPECT_EQ(reproducing_arguments(options), "-preset thesis -mask mask.gpkg -layers contours");
}

/// Metadata for others name the files that were read, but not their folders.
TEST(GivenWords, withoutFolders) {
    const auto shared = [](const Options& options, const std::map<std::string, std::string>& metadata) {
        return strip_folders(metadata, options);
    };
    Options options =
        options_of({"-oo", "INDEX=/home/ann/index", "-a_srs", "/home/ann/site.prj", "-cutline",
                    "../ann/area.gpkg", "-ground", "/home/ann/dtm.tif", "-mask", "ann/mask.tif", "-ndvi",
                    "https://ann@there.org/ndvi.tif?key=7", "-split_by",
                    "/vsizip//home/ann/plots.zip/plots.shp", "-t_srs", "EPSG:25832", "-nln", "low/high"});
    const auto metadata = shared(options, {{"D2B_SOURCE", "/home/ann/dem.tif"},
                                           {"D2B_OPTIONS", reproducing_arguments(options)},
                                           {"D2B_GROUND", "/home/ann/dtm.tif"},
                                           {"D2B_MASK", "ann/mask.tif"},
                                           {"D2B_PRESET", "buildings"}});
    EXPECT_EQ(metadata.at("D2B_SOURCE"), "dem.tif");
    EXPECT_EQ(metadata.at("D2B_GROUND"), "dtm.tif");
    EXPECT_EQ(metadata.at("D2B_MASK"), "mask.tif");
    EXPECT_EQ(metadata.at("D2B_PRESET"), "buildings");
    const std::string words = metadata.at("D2B_OPTIONS");
    EXPECT_EQ(words.find("ann"), std::string::npos) << words;
    for (const char* word : {"INDEX=index", "site.prj", "area.gpkg", "dtm.tif", "mask.tif", "ndvi.tif",
                             "plots.shp", "EPSG:25832", "low/high"})
        EXPECT_NE(words.find(word), std::string::npos) << word;
    EXPECT_EQ(words.find("key=7"), std::string::npos);
    // Names of systems have slashes, too, and so does the name of a folder that is a dataset.
    options = options_of({"-t_srs", "ETRS89 / UTM zone 32N"});
    EXPECT_EQ(shared(options, {{"D2B_OPTIONS", ""}, {"D2B_SOURCE", "/home/ann/tiles/"}}),
              (std::map<std::string, std::string>{{"D2B_OPTIONS", "-t_srs 'ETRS89 / UTM zone 32N'"},
                                                  {"D2B_SOURCE", "tiles"}}));
}

/// Several rasters are words of a shell, as the command line had them.
TEST(GivenWords, ofSeveralSources) {
    Options options;
    options.read.source = "/home/ann/west.tif\nbob's tiles/east.tif";
    const std::string words = source_text("/home/ann/west.tif and 1 other", options.read);
    EXPECT_EQ(words, "/home/ann/west.tif 'bob'\\''s tiles/east.tif'");
    EXPECT_EQ(strip_folders({{"D2B_SOURCE", words}}, options).at("D2B_SOURCE"), "west.tif east.tif");
    options.read.source = "/home/ann/tiles";
    EXPECT_EQ(source_text("/home/ann/tiles", options.read), "/home/ann/tiles");
    options.read.source = "<VRTDataset>\n</VRTDataset>";  // a mosaic as text
    EXPECT_EQ(source_text(options.read.source, options.read), options.read.source);
}

/// Whatever names a file: an option that is added to the table, too.
TEST(GivenWords, withoutFoldersOfAnyFile) {
    for (const OptionRow& row : option_table()) {
        const bool reads = row.kind == OptionKind::raster || row.kind == OptionKind::polygons ||
                           row.kind == OptionKind::dataset || row.kind == OptionKind::terrain ||
                           row.kind == OptionKind::crs;
        if (!reads || !row.repeats)
            continue;
        const Options options = options_of({"-" + row.name, "/home/ann/x"});
        EXPECT_EQ(strip_folders({{"D2B_OPTIONS", ""}}, options).at("D2B_OPTIONS"), "-" + row.name + " x");
    }
}

TEST(GivenWords, giveTheSameOptionsAgain) {
    for (const char* name : {"a b", "it's", "$HOME", "`x`", "a\\b", "-x", "--", "*", "#", "~", "\xC3\xA4"}) {
        const Options options = options_of({"-nln=" + std::string(name)});
        EXPECT_EQ(options_of(split(reproducing_arguments(options))).write.layer_name, name);
    }
    for (const OptionCase& option : option_cases()) {
        if (option.name == "sweep")
            continue;
        const std::string words = reproducing_arguments(options_of(option.words()));
        EXPECT_EQ(reproducing_arguments(options_of(split(words))), words) << option.text();
    }
}

/// All that the words leave out is about files beside the layers, or about the run and not its result.
TEST(GivenWords, leaveOutWhatChangesNoLayer) {
    const std::set<std::string> left_out{
        "append",        "overwrite",    "page",         "preview",        "preview_size",   "q",
        "json",          "write_canopy", "sweep",        "write_ground",   "write_height",   "threads",
        "surface",       "surface_of",   "surface_roof", "surface_origin", "surface_solids", "preview_paper",
        "preview_scale", "landscape",    "title",        "credit"};
    for (const OptionRow& row : option_table())
        EXPECT_EQ(!row.repeats, left_out.contains(row.name) || row.hidden || row.name.starts_with("help") ||
                                    row.name == "version")
            << row.name;
}

/// Every option of the table that was given, with its values; those of the surface where problems are
/// written.
TEST(GivenWords, keepEveryOptionWithItsValues) {
    for (const OptionCase& option : option_cases()) {
        if (option.name == "sweep")
            continue;
        const Request given{options_of(option.words()), {}};
        const Request kept{options_of(split(reproducing_arguments(given.options))), {}};
        const bool with_surface = given.options.write.problems;
        for (const OptionRow& row : option_table())
            if (row.repeats || (with_surface && row.name.starts_with("surface"))) {
                EXPECT_EQ(row.is_given(kept), row.is_given(given)) << row.name << " in " << option.text();
                EXPECT_EQ(row.texts(kept), row.texts(given)) << row.name << " in " << option.text();
            }
    }
}

TEST(GivenWords, nameTheSurfaceWhereItsProblemsAreWritten) {
    EXPECT_EQ(
        reproducing_arguments(options_of({"-surface", "a.obj", "-surface", "b.city.json", "-surface_of",
                                          "contours", "-surface_origin", "1", "2", "3", "-write_problems"})),
        "-write_problems -surface a.obj -surface b.city.json -surface_of contours -surface_origin 1 2 3");
    EXPECT_EQ(reproducing_arguments(options_of({"-surface", "a.obj", "-flow_ready", "3"})), "-flow_ready 3");
    EXPECT_EQ(reproducing_arguments(options_of({"-flow_ready", "3", "-write_problems"})),
              "-flow_ready 3 -write_problems");
}

using Provenances = OptionScene;

/// The metadata of a result are enough to make it again.
TEST_F(Provenances, repeatTheRun) {
    for (const OptionCase& option : option_cases()) {
        if (!shapes_the_result(option.name))
            continue;
        const Outcome outcome = outcome_of(option.words());
        ASSERT_EQ(outcome.error, "") << option.text();
        const Outcome again = outcome_of(split(outcome.options));
        EXPECT_EQ(again.options, outcome.options);
        // A raster or a surface beside the layers, which come first.
        const bool beside = !find_option(option.name)->repeats;
        EXPECT_EQ(again.written == outcome.written, !beside) << option.text();
        EXPECT_TRUE(outcome.written.starts_with(again.written)) << option.text();
    }
    const Texts many = split(
        "-b 2 -te 391000 5819907 391098 5820000 -cutline /vsimem/scene/areas.gpkg -cutline_layer north "
        "-snodata 16 -min_height 1.5 -min_area 20 -fl 3 4.5 -fields osm -3d -write_doubtful -regularize free "
        "-t_srs EPSG:4326");
    const Outcome outcome = outcome_of(many);
    ASSERT_EQ(outcome.error, "");
    EXPECT_NE(outcome.written, outcome_of({}).written);
    EXPECT_EQ(outcome_of(split(outcome.options)), outcome);
}

}  // namespace
}  // namespace d2b::test
