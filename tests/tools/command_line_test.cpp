#include <gtest/gtest.h>

#include "dem2buildings/tokens.hpp"
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
        "The destination is missing, there is only '30.gpkg'; usage: dem2buildings [options] <src_raster> "
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

}  // namespace
}  // namespace d2b::test
