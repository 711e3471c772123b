#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings_tiles/command_line.hpp"
#include "dem2buildings_tiles/help.hpp"

namespace d2b::test {
namespace {

using Arguments = std::vector<std::string>;

std::string refused_with(const Arguments& arguments) {
    try {
        (void)parse_tile_command_line(arguments);
    } catch (const OptionError& error) {
        return error.what();
    }
    return "(not refused)";
}

TEST(TilesCommandLine, takesTheOptionsOfDem2buildings) {
    const TileCommand command = parse_tile_command_line(
        {"plan", "-lod", "3", "--tile=2", "a.tif", "-nln", "work", "b.gpkg", "work", "-3d"});
    EXPECT_EQ(command.kind, TileCommandKind::plan);
    EXPECT_EQ(command.side, 2);
    EXPECT_EQ(command.work, "work");
    EXPECT_EQ(command.words, (Arguments{"-lod", "3", "a.tif", "-nln", "work", "b.gpkg", "-3d"}));
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
    EXPECT_EQ(command.words, (Arguments{"work/source.vrt", "-lod", "3", "b.gpkg"}));
    EXPECT_EQ(command.request.options.read.source, "work/source.vrt");
    EXPECT_EQ(command.request.options.write.destination, "b.gpkg");
    EXPECT_EQ(parse_tile_command_line({"plan", "-input_file_list=a.txt", "b.gpkg", "--", "-w"}).words,
              (Arguments{"./-w/source.vrt", "b.gpkg", "--"}));
}

TEST(TilesCommandLine, takesTiles) {
    const TileCommand command =
        parse_tile_command_line({"find", "-threads", "2", "work", "7", "0", "12", "-q"});
    EXPECT_EQ(command.kind, TileCommandKind::find);
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
              "join takes the work folder alone, not 'b' as well; usage: dem2buildings_tiles join <work>.");
    EXPECT_EQ(refused_with({"find", "-lod", "3", "work"}),
              "find has no option -lod; those of dem2buildings are given to plan.");
    EXPECT_EQ(refused_with({"find", "work", "1x"}), "A tile is a whole number from 0 on, not '1x'.");
    EXPECT_EQ(refused_with({"find", "work", "--", "-1"}), "A tile is a whole number from 0 on, not '-1'.");
    EXPECT_EQ(refused_with({"plan", "-tile", "0", "a", "b", "c"}),
              "-tile must be a whole number from 1 to 1000, not '0'.");
    EXPECT_EQ(refused_with({"plan", "-tile"}), "-tile needs a value: -tile <units>.");
    EXPECT_EQ(refused_with({"plan", "-tile", "1", "-tile", "2", "a", "b", "c"}),
              "-tile is given twice; give it once.");
    EXPECT_EQ(refused_with({"merge", "-json=1", "work"}), "-json is a switch and takes no value.");
    EXPECT_EQ(
        refused_with({"plan", "a.tif", "b.gpkg"}),
        "plan takes three names, those of the source, the destination and the work folder, not 2; usage: "
        "dem2buildings_tiles plan [options] <src_raster> <dst_vector> <work>.");
    EXPECT_EQ(refused_with({"plan", "a.tif", "b.gpkg", ""}),
              "A file name is empty; usage: dem2buildings_tiles plan [options] "
              "<src_raster> <dst_vector> <work>.");
    EXPECT_EQ(
        refused_with({"plan", "-input_file_list", "a.txt", "a.tif", "b.gpkg", "work"}),
        "plan takes two names beside -input_file_list, those of the destination and the work folder, not "
        "3.");
    EXPECT_EQ(refused_with({"plan", "-oo", "A=1", "-input_file_list", "a.txt", "b.gpkg", "work"}),
              "-oo speaks of one source, and -input_file_list names many; make a mosaic of them with "
              "gdalbuildvrt.");
    EXPECT_EQ(refused_with({"join", "-input_file_list", "a.txt", "work"}),
              "join has no option -input_file_list; those of dem2buildings are given to plan.");
    EXPECT_EQ(refused_with({"plan", "-sweep", "lod 1 2", "a.tif", "b.gpkg", "work"}),
              "-sweep does not work in tiles: it runs the whole several times; run dem2buildings.");
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
