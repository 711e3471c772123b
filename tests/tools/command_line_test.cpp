#include "dem2buildings_tiles/command_line.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <cpl_conv.h>
#include <gtest/gtest.h>

#include "dem2buildings/tokens.hpp"
#include "dem2buildings_tiles/help.hpp"
#include "read/gdal_setup.hpp"
#include "support/error_of.hpp"
#include "tools/parse.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

TEST(CommandLine, takesOneDashOrTwoAndABlankOrAnEqualsSign) {
    for (const Texts& arguments : {Texts{"-lod", "7"}, {"--lod", "7"}, {"-lod=7"}, {"--lod=7"}})
        EXPECT_EQ(parse(arguments).options.levels.lod, 7) << arguments[0];
    for (const Texts& arguments : {Texts{"-te", "1", "2", "3", "4"},
                                   {"--te", "1", "2", "3", "4"},
                                   {"-te=1", "2", "3", "4"},
                                   {"--te=1", "2", "3", "4"}})
        EXPECT_EQ(parse(arguments).options.read.extent, (std::array<double, 4>{1, 2, 3, 4})) << arguments[0];
    for (const Texts& arguments :
         {Texts{"-fl", "1", "2"}, {"--fl", "1", "2"}, {"-fl=1", "2"}, {"--fl=1", "2"}})
        EXPECT_EQ(parse(arguments).options.levels.fixed, (Numbers{1, 2})) << arguments[0];
    EXPECT_TRUE(parse({"--overwrite"}).options.write.overwrite);
    EXPECT_EQ(parse({"-oo=NAME=VALUE"}).options.read.open_options, Texts{"NAME=VALUE"});
    EXPECT_EQ(parse({"-nln=-strange"}).options.write.layer_name, "-strange");
    EXPECT_EQ(parse({"-off=-5", "-i=2"}).options.levels.offset, -5);
}

TEST(CommandLine, takesOptionsAnywhere) {
    for (const Texts& arguments : {Texts{"-lod", "7", "-q", "a.tif", "b.gpkg"},
                                   {"a.tif", "-lod", "7", "-q", "b.gpkg"},
                                   {"a.tif", "b.gpkg", "-q", "-lod", "7"},
                                   {"-q", "a.tif", "-lod=7", "b.gpkg"}}) {
        const Request request = parse_command_line(arguments);
        EXPECT_EQ(request.options.levels.lod, 7);
        EXPECT_TRUE(request.tool.quiet);
        EXPECT_EQ(request.options.read.source, "a.tif");
        EXPECT_EQ(request.options.write.destination, "b.gpkg");
    }
}

TEST(CommandLine, takesSeveralSourcesBeforeTheDestination) {
    for (const Texts& arguments : {Texts{"-q", "a.tif", "b.tif", "c.tif", "d.gpkg"},
                                   {"a.tif", "b.tif", "-fl", "1", "2", "c.tif", "d.gpkg"},
                                   {"a.tif", "--", "b.tif", "c.tif", "d.gpkg"}}) {
        const Options options = parse_command_line(arguments).options;
        EXPECT_EQ(options.read.source, "a.tif\nb.tif\nc.tif");
        EXPECT_EQ(options.write.destination, "d.gpkg");
    }
    EXPECT_EQ(parse_command_line({"a\nb.tif", "c.gpkg"}).options.read.source, "a\nb.tif");
}

TEST(CommandLine, takesNegativeNumbersForValues) {
    const Options options =
        parse({"-snodata", "-9999", "-i", "1", "-off", "-.5", "-te", "-4", "-3e1", "-2", "-1"}).options;
    EXPECT_EQ(options.read.nodata, -9999.0);
    EXPECT_EQ(options.levels.offset, -0.5);
    EXPECT_EQ(options.read.extent, (std::array<double, 4>{-4, -30, -2, -1}));
    EXPECT_EQ(parse({"-fl", "-2", "-1", "0"}).options.levels.fixed, (Numbers{-2, -1, 0}));
    EXPECT_EQ(refusal({"-lod", "-4"}), "-lod must be a whole number from 1 to 10000, not '-4'.");
}

TEST(CommandLine, levelsEndBeforeFileNames) {
    for (const Texts& arguments : {Texts{"-fl", "10", "20", "in.tif", "out.gpkg"},
                                   {"in.tif", "-fl", "10", "20", "out.gpkg"},
                                   {"in.tif", "out.gpkg", "-fl", "10", "20"},
                                   {"-fl", "10", "in.tif", "-fl", "20", "out.gpkg"},
                                   {"-fl", "10", "20", "-q", "in.tif", "out.gpkg"},
                                   {"-fl", "10", "20", "--", "in.tif", "out.gpkg"}}) {
        const Options options = parse_command_line(arguments).options;
        EXPECT_EQ(options.levels.fixed, (Numbers{10, 20}));
        EXPECT_EQ(options.read.source, "in.tif");
        EXPECT_EQ(options.write.destination, "out.gpkg");
    }
}

TEST(CommandLine, fileNamesThatAreNumbersNeedAPathBehindLevels) {
    const Options options = parse_command_line({"-fl", "10", "./20", "30.gpkg"}).options;
    EXPECT_EQ(options.levels.fixed, (Numbers{10}));
    EXPECT_EQ(options.read.source, "./20");
    EXPECT_EQ(options.write.destination, "30.gpkg");
    EXPECT_EQ(
        refusal_of_all({"-fl", "10", "20", "30.gpkg"}),
        "The destination is missing, there is only '30.gpkg'; usage: dem2buildings [options] <src_raster>... "
        "<dst_vector>.");
    EXPECT_EQ(parse_command_line({"-fl", "10", "--", "20", "30"}).options.read.source, "20");
    EXPECT_EQ(parse_command_line({"20", "30", "-fl", "10"}).options.read.source, "20");
}

TEST(CommandLine, twoDashesEndTheOptions) {
    const Options options = parse_command_line({"-lod", "7", "--", "-q", "--out.gpkg"}).options;
    EXPECT_EQ(options.levels.lod, 7);
    EXPECT_EQ(options.read.source, "-q");
    EXPECT_EQ(options.write.destination, "--out.gpkg");
    EXPECT_EQ(parse_command_line({"a", "--", "b"}).options.write.destination, "b");
}

TEST(CommandLine, doesNotTakeBeginningsForOptions) {
    EXPECT_EQ(refusal({"-trac", "cells"}), "There is no option -trac; did you mean -trace?");
}

TEST(CommandLine, helpComesBeforeAllOtherErrors) {
    EXPECT_TRUE(parse_command_line({"-frobnicate", "--help"}).tool.help);
    EXPECT_TRUE(parse_command_line({"-lod", "0", "a", "b", "c", "-h"}).tool.help);
    const ToolOptions tool = parse_command_line({"--version", "--help"}).tool;
    EXPECT_TRUE(tool.version);
    EXPECT_FALSE(tool.help);  // the first counts
}

TEST(CommandLine, isQuietWhereTheResultGoesToStdout) {
    const Request request = parse_command_line({"a.tif", "/vsistdout/", "-f", "GeoJSON"});
    EXPECT_TRUE(writes_to_stdout(request));
    EXPECT_TRUE(request.tool.quiet);
    EXPECT_FALSE(writes_to_stdout(parse({})));
    EXPECT_FALSE(parse({}).tool.quiet);
}

TEST(CommandLine, keepsTheOrderOfRepeatedOptions) {
    EXPECT_EQ(parse({"-fl", "3", "-q", "-fl", "1", "2"}).options.levels.fixed, (Numbers{3, 1, 2}));
}

TEST(Tokens, tellOptionsAndFileNamesApart) {
    const Tokens tokens = split_tokens({"a", "-zzz", "-lod", "4", "--yy=1", "b", "--", "-c"});
    ASSERT_EQ(tokens.options.size(), 1U);
    EXPECT_EQ(tokens.options[0].row->name, "lod");
    EXPECT_EQ(tokens.options[0].values, Texts{"4"});
    EXPECT_EQ(tokens.file_names, (Texts{"a", "b", "-c"}));
    EXPECT_EQ(tokens.unknown, (Texts{"-zzz", "--yy=1"}));
}

std::string gdal_config(const char* key) {
    return CPLGetConfigOption(key, "(not set)");
}

TEST(GdalSwitches, leaveAllElseAsItWas) {
    const Texts arguments{"-lod", "4", "a.tif", "", "-fl", "-1", "b.gpkg"};
    EXPECT_EQ(reading::apply_gdal_switches(arguments), arguments);
    EXPECT_EQ(reading::apply_gdal_switches({}), Texts{});
}

TEST(GdalSwitches, setConfigurationOptionsInBothForms) {
    EXPECT_EQ(reading::apply_gdal_switches({"-q", "--config", "D2B_ONE", "1", "x"}), (Texts{"-q", "x"}));
    EXPECT_EQ(gdal_config("D2B_ONE"), "1");
    EXPECT_EQ(reading::apply_gdal_switches({"--config", "D2B_TWO=2", "-q", "x"}), (Texts{"-q", "x"}));
    EXPECT_EQ(gdal_config("D2B_TWO"), "2");
    EXPECT_EQ(reading::apply_gdal_switches({"--config", "D2B_THREE=a=b", "--config", "D2B_FOUR", "c=d"}),
              Texts{});
    EXPECT_EQ(gdal_config("D2B_THREE"), "a=b");
    EXPECT_EQ(gdal_config("D2B_FOUR"), "c=d");
    EXPECT_EQ(reading::apply_gdal_switches({"--config", "D2B_TWO="}), Texts{});
    EXPECT_EQ(gdal_config("D2B_TWO"), "");
}

TEST(GdalSwitches, leaveOurVersionAndWhatFollowsTwoDashes) {
    EXPECT_EQ(reading::apply_gdal_switches({"--version"}), Texts{"-version"});
    EXPECT_EQ(reading::apply_gdal_switches({"a", "--", "--config", "--version"}),
              (Texts{"a", "--", "--config", "--version"}));
}

TEST(GdalSwitches, printAndAreDone) {
    for (const Texts& arguments :
         {Texts{"--formats"}, {"--format", "GTiff"}, {"--help-general"}, {"--build"}}) {
        testing::internal::CaptureStdout();
        const auto left = reading::apply_gdal_switches(arguments);
        std::fflush(stdout);
        EXPECT_FALSE(left.has_value()) << arguments[0];
        EXPECT_NE(testing::internal::GetCapturedStdout(), "") << arguments[0];
    }
}

TEST(GdalSwitches, refuseWithTheReasonOfGdal) {
    const auto refusal_of_switches = [](const Texts& arguments) {
        return error_of([&] { static_cast<void>(reading::apply_gdal_switches(arguments)); });
    };
    EXPECT_EQ(refusal_of_switches({"--config", "A"}),
              "--config option given without a key and value argument.");
    EXPECT_EQ(refusal_of_switches({"--debug"}), "--debug option given without debug level.");
    EXPECT_TRUE(refusal_of_switches({"--optfile", "/nonexistent"}).starts_with("Unable to open optfile"));
    EXPECT_TRUE(
        refusal_of_switches({"--format", "XX"}).starts_with("--format option given with format 'XX'"));
}

TEST(GdalSwitches, knowTheVersionOfGdal) {
    int major = 0;
    int minor = 0;
    ASSERT_EQ(std::sscanf(reading::gdal_version().c_str(), "%d.%d.", &major, &minor), 2)
        << reading::gdal_version();
    EXPECT_TRUE(major > 3 || (major == 3 && minor >= 6)) << reading::gdal_version();
}

std::string refused_with(const Texts& arguments) {
    return error_of([&] { static_cast<void>(parse_tile_command_line(arguments)); });
}

TEST(TilesCommandLine, takesTheOptionsOfDem2buildings) {
    const TileCommand command = parse_tile_command_line(
        {"plan", "-lod", "3", "--tile=2", "a.tif", "-nln", "work", "b.gpkg", "work", "-3d"});
    EXPECT_EQ(command.kind, tiles::TileStep::plan);
    EXPECT_EQ(command.side, 2);
    EXPECT_EQ(command.work, "work");
    EXPECT_EQ(command.words, (Texts{"-lod", "3", "a.tif", "-nln", "work", "b.gpkg", "-3d"}));
    EXPECT_EQ(command.request.options.read.source, "a.tif");
    EXPECT_EQ(command.request.options.write.destination, "b.gpkg");
    EXPECT_EQ(command.request.options.write.layer_name, "work");
    EXPECT_EQ(command.request.options.levels.lod, 3);
}

TEST(TilesCommandLine, takesAList) {
    const TileCommand command =
        parse_tile_command_line({"plan", "-lod", "3", "-input_file_list", "a.txt", "b.gpkg", "work"});
    EXPECT_EQ(command.list, "a.txt");
    EXPECT_EQ(command.work, "work");
    EXPECT_EQ(command.words, (Texts{"work/source.vrt", "-lod", "3", "b.gpkg"}));
    EXPECT_EQ(command.request.options.read.source, "work/source.vrt");
    EXPECT_EQ(command.request.options.write.destination, "b.gpkg");
    EXPECT_EQ(parse_tile_command_line({"plan", "-input_file_list=a.txt", "b.gpkg", "--", "-w"}).words,
              (Texts{"./-w/source.vrt", "b.gpkg", "--"}));
}

TEST(TilesCommandLine, takesTiles) {
    const TileCommand command =
        parse_tile_command_line({"find", "-threads", "2", "work", "7", "0", "12", "-q"});
    EXPECT_EQ(command.kind, tiles::TileStep::find);
    EXPECT_EQ(command.tiles, (std::vector<std::int64_t>{0, 7, 12}));
    EXPECT_EQ(command.threads, 2);
    EXPECT_TRUE(command.quiet);
    EXPECT_EQ(parse_tile_command_line({"merge", "--", "-work"}).work, "-work");
    EXPECT_TRUE(parse_tile_command_line({"merge", "-json", "work"}).json);
    EXPECT_EQ(parse_tile_command_line({"find", "-help"}).text, "help");
}

TEST(TilesCommandLine, refusesWhatItDoesNotKnow) {
    EXPECT_EQ(refused_with({"fnd", "work"}),
              "The first argument names a step, plan, find, join, draw, merge or write, not 'fnd'; "
              "dem2buildings_tiles --help says what they do.");
    EXPECT_EQ(refused_with({"join"}), "The work folder is missing; usage: dem2buildings_tiles join <work>.");
    EXPECT_EQ(refused_with({"join", "a", "b"}),
              "join only takes the work folder, not 'b' as well; usage: dem2buildings_tiles join <work>.");
    EXPECT_EQ(refused_with({"find", "-lod", "3", "work"}),
              "find has no option -lod; only plan takes the options of dem2buildings.");
    EXPECT_EQ(refused_with({"find", "work", "1x"}), "A tile is a whole number from 0 on, not '1x'.");
    EXPECT_EQ(refused_with({"find", "work", "--", "-1"}), "A tile is a whole number from 0 on, not '-1'.");
    EXPECT_EQ(refused_with({"plan", "-tile", "0", "a", "b", "c"}),
              "-tile must be a whole number from 1 to 1000, not '0'.");
    EXPECT_EQ(refused_with({"plan", "-tile"}), "-tile needs a value: -tile <units>.");
    EXPECT_EQ(refused_with({"plan", "-tile", "1", "-tile", "2", "a", "b", "c"}),
              "-tile is given twice; give it once.");
    EXPECT_EQ(refused_with({"merge", "-json=1", "work"}), "-json is a switch and takes no value.");
    EXPECT_EQ(refused_with({"plan", "a.tif", "b.gpkg"}),
              "plan takes three names, the source, the destination and the work folder, not 2; usage: "
              "dem2buildings_tiles plan [options] <src_raster> <dst_vector> <work>.");
    EXPECT_EQ(refused_with({"plan", "a.tif", "b.gpkg", ""}),
              "A file name is empty; usage: dem2buildings_tiles plan [options] "
              "<src_raster> <dst_vector> <work>.");
    EXPECT_EQ(refused_with({"plan", "-input_file_list", "a.txt", "a.tif", "b.gpkg", "work"}),
              "plan takes two names with -input_file_list, the destination and the work folder, not 3.");
    EXPECT_EQ(refused_with({"plan", "-oo", "A=1", "-input_file_list", "a.txt", "b.gpkg", "work"}),
              "-oo applies to one source, and -input_file_list names many; join them with gdalbuildvrt.");
    EXPECT_EQ(refused_with({"join", "-input_file_list", "a.txt", "work"}),
              "join has no option -input_file_list; only plan takes the options of dem2buildings.");
    EXPECT_EQ(
        refused_with({"plan", "-sweep", "lod 1 2", "a.tif", "b.gpkg", "work"}),
        "-sweep does not work in tiles, because it runs the whole area several times; run dem2buildings.");
    EXPECT_EQ(refused_with({"plan", "/vsistdin/", "b.gpkg", "work"}),
              "The source is read by several processes, so it cannot be /vsistdin/; give a file.");
    EXPECT_EQ(refused_with({"plan", "-lodd", "3", "a", "b", "c"}),
              "There is no option -lodd; did you mean -lod?");
}

TEST(TilesHelp, isOfLinesThatFit) {
    std::istringstream help(tiles_help());
    for (std::string line; std::getline(help, line);)
        EXPECT_LE(line.size(), 80U) << line;
    for (const TileStepName& step : tile_step_names()) {
        EXPECT_NE(tiles_man_page().find(std::string(step.help)), std::string::npos);
        EXPECT_NE(tiles_bash_completion().find(std::string(step.name)), std::string::npos);
    }
}

}  // namespace
}  // namespace d2b::test
