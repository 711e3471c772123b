#include <sstream>

#include <gtest/gtest.h>

#include "dem2buildings_score/command_line.hpp"
#include "dem2buildings_score/help.hpp"
#include "dem2buildings_score/report.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;

std::string refusal_of_score(const Texts& arguments) {
    return error_of([&] { static_cast<void>(parse_score_command_line(arguments)); });
}

TEST(ScoreCommandLine, readsOptionsAnywhere) {
    const ScoreCommand request = parse_score_command_line(
        {"-layer", "a", "found.gpkg", "--reference_layer=b", "-aoi", "area.gpkg", "reference.gpkg", "-dem",
         "d.tif", "-min_object", "12.5", "-height_field=roof", "-json", "-q"});
    EXPECT_EQ(request.found, "found.gpkg");
    EXPECT_EQ(request.reference, "reference.gpkg");
    EXPECT_EQ(request.layer, "a");
    EXPECT_EQ(request.reference_layer, "b");
    EXPECT_EQ(request.area_of_interest, "area.gpkg");
    EXPECT_EQ(request.dem, "d.tif");
    EXPECT_EQ(request.height_field, "roof");
    EXPECT_EQ(request.min_object_m2, 12.5);
    EXPECT_TRUE(request.json);
    EXPECT_TRUE(request.quiet);
}

TEST(ScoreCommandLine, refusesAnOptionWithoutAName) {
    EXPECT_EQ(refusal_of_score({"-=x", "a.gpkg", "b.gpkg"}),
              "An option has no name before its =; dem2buildings_score --help lists all.");
}

TEST(ScoreCommandLine, hasDefaults) {
    const ScoreCommand request = parse_score_command_line({"a", "b"});
    EXPECT_EQ(request.min_object_m2, 50);
    EXPECT_EQ(request.layer + request.reference_layer + request.area_of_interest + request.dem, "");
    EXPECT_FALSE(request.roofs || request.json || request.quiet || request.asks_for_text());
}

TEST(ScoreCommandLine, takesFileNamesBehindTwoDashes) {
    const ScoreCommand request = parse_score_command_line({"-q", "--", "-a", "--b"});
    EXPECT_EQ(request.found, "-a");
    EXPECT_EQ(request.reference, "--b");
}

TEST(ScoreCommandLine, asksForNoFileNamesWithHelp) {
    EXPECT_TRUE(parse_score_command_line({"--help"}).help);
    EXPECT_TRUE(parse_score_command_line({"--help_all"}).help);
    EXPECT_TRUE(parse_score_command_line({"-version"}).version);
    EXPECT_TRUE(parse_score_command_line({"-man"}).man_page);
}

TEST(ScoreCommandLine, refusesWrongFileNames) {
    const std::string usage = "; usage: dem2buildings_score [options] <found> <reference>.";
    EXPECT_EQ(refusal_of_score({"-q"}), "The found and the reference footprints are missing" + usage);
    EXPECT_EQ(refusal_of_score({"a"}), "The reference is missing, there is only 'a'" + usage);
    EXPECT_EQ(refusal_of_score({"a", "b", "c"}),
              "There are too many file names, from 'c' on; give the found footprints and one reference.");
    EXPECT_EQ(refusal_of_score({"a", ""}), "A file name is empty" + usage);
}

TEST(ScoreCommandLine, refusesUnknownOptions) {
    EXPECT_EQ(refusal_of_score({"-laier", "x", "a", "b"}), "There is no option -laier; did you mean -layer?");
    EXPECT_EQ(refusal_of_score({"--zzz=1", "a", "b"}),
              "There is no option --zzz; dem2buildings_score --help lists all.");
}

TEST(ScoreCommandLine, refusesWrongValues) {
    EXPECT_EQ(refusal_of_score({"a", "b", "-dem"}), "-dem needs a value: -dem <raster>.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-dem", "-json"}), "-dem needs a value: -dem <raster>.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-dem="}), "-dem needs a value: -dem <raster>.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-dem", ""}), "-dem needs a value: -dem <raster>.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-json=1"}), "-json is a switch and takes no value.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-dem", "x", "-dem", "y"}), "-dem is given twice; give it once.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-min_object", "-1"}),
              "-min_object must be a number of at least 0, not '-1'.");
    EXPECT_EQ(refusal_of_score({"a", "b", "-min_object", "big"}),
              "-min_object must be a number of at least 0, not 'big'.");
}

TEST(ScoreCommandLine, comparesRoofs) {
    const ScoreCommand request = parse_score_command_line({"-roofs", "-roof_types", "t.gpkg", "a", "b"});
    EXPECT_TRUE(request.roofs);
    EXPECT_EQ(request.roof_types, "t.gpkg");
    EXPECT_EQ(
        refusal_of_score({"-roofs", "-height_field", "h", "a", "b"}),
        "-height_field has no effect with -roofs, because planes have elevations; leave one of them out.");
    EXPECT_EQ(refusal_of_score({"-roof_types", "t.gpkg", "a", "b"}),
              "-roof_types has no effect without -roofs; give -roofs, too, or leave it out.");
}

TEST(ScoreHelp, leavesOptionsOfRoofsOutOfThoseOfFootprints) {
    EXPECT_NE(score_options_json().find("min_object"), std::string::npos);
    EXPECT_EQ(score_options_json().find("roof_types"), std::string::npos);
}

TEST(ScoreHelp, namesEveryOptionAndFitsALine) {
    const std::string help = tool_help(score_texts());
    const std::string man = tool_man_page(score_texts());
    for (const ScoreOption& option : score_options()) {
        EXPECT_NE(help.find("  -" + option.name), std::string::npos) << option.name;
        EXPECT_FALSE(option.help.empty());
        std::string escaped = option.name;
        EXPECT_NE(man.find("\\-" + escaped), std::string::npos) << option.name;
    }
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 80U) << line;
}

TEST(ScoreText, writesFigures) {
    ScoreCommand request;
    request.found = "f.gpkg";
    request.reference = "r.gpkg";
    ScoreRun run;
    run.found_layer = "buildings";
    run.reference_layer = "blocks";
    run.score.iou = 0.87654;
    run.score.outline_rms_m = 1.23456;
    run.score.found.invalid = 3;
    const std::string text = score_text(request, run, false);
    EXPECT_NE(text.find("found                 f.gpkg, layer buildings\n"), std::string::npos) << text;
    EXPECT_NE(text.find("measured in           plain units\n"), std::string::npos) << text;
    EXPECT_NE(text.find("IoU                   87.65 %\n"), std::string::npos) << text;
    EXPECT_NE(text.find("outline RMS           1.235 m"), std::string::npos) << text;
    EXPECT_NE(text.find("PoLiS                 -"), std::string::npos) << text;
    EXPECT_NE(text.find("height error          -\n"), std::string::npos) << text;
    EXPECT_NE(text.find("direction error       -\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("short edges"), std::string::npos) << text;
    run.score.heights = HeightErrors{4, -0.5, 2, 1.5};
    const std::string quiet = score_text(request, run, true);
    EXPECT_EQ(quiet.find("f.gpkg"), std::string::npos);
    EXPECT_NE(quiet.find("height error, mean    -0.500 m\nheight error, RMS     2.000 m\n"
                         "height error, median  1.500 m\n"),
              std::string::npos)
        << quiet;
}

}  // namespace
}  // namespace d2b::test
