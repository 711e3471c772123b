#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/command_line.hpp"
#include "dem2buildings_mesh/help.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

using Arguments = std::vector<std::string>;
using mesh::parse_mesh_command_line;

std::string refusal(const Arguments& arguments) {
    return error_of<OptionError>([&] { (void)parse_mesh_command_line(arguments); });
}

TEST(MeshCommandLine, readsOptionsAnywhere) {
    Arguments words{"-min_angle", "30", "in.city.json", "--max_edge=2.5", "-ground", "g.tif", "out.stl"};
    words.insert(words.end(), {"-ground_error", "0.1", "-margin", "50", "-base", "3", "-min_wall", "1"});
    words.insert(words.end(), {"-origin", "-5", "6", "7", "-overwrite", "-json"});
    const mesh::MeshCommand command = parse_mesh_command_line(words);
    EXPECT_EQ(command.city, "in.city.json");
    EXPECT_EQ(command.destination, "out.stl");
    EXPECT_EQ(command.min_angle, 30);
    EXPECT_EQ(command.max_edge, 2.5);
    EXPECT_EQ(command.ground, "g.tif");
    EXPECT_EQ(command.ground_error, 0.1);
    EXPECT_EQ(command.margin, 50);
    EXPECT_EQ(command.base, 3);
    EXPECT_EQ(command.min_wall, 1);
    EXPECT_EQ(command.origin, (std::array<double, 3>{-5, 6, 7}));
    EXPECT_TRUE(command.overwrite && command.json);
    EXPECT_TRUE(parse_mesh_command_line({"a", "b", "-q"}).quiet);
}

TEST(MeshCommandLine, refusesInASentence) {
    EXPECT_EQ(refusal({"-q"}),
              "The city file and the output are missing; usage: dem2buildings_mesh [options] <in.city.json> "
              "<out>.");
    EXPECT_EQ(refusal({"a"}),
              "The output is missing, there is only 'a'; usage: dem2buildings_mesh [options] <in.city.json> "
              "<out>.");
    EXPECT_EQ(refusal({"a", "b", "c"}),
              "There are too many file names, from 'c' on; give a city file and one output.");
    EXPECT_EQ(refusal({"a", ""}),
              "A file name is empty; usage: dem2buildings_mesh [options] <in.city.json> <out>.");
    EXPECT_EQ(refusal({"-min_angle", "31", "a", "b"}), "-min_angle must be a number from 0 to 30, not '31'.");
    EXPECT_EQ(refusal({"-max_edge", "0", "a", "b"}), "-max_edge must be a number above 0, not '0'.");
    EXPECT_EQ(refusal({"-max_edg", "2", "a", "b"}), "There is no option -max_edg; did you mean -max_edge?");
    EXPECT_EQ(refusal({"-margin", "2", "a", "b"}),
              "-margin has no effect without terrain; give -ground as well.");
    EXPECT_EQ(refusal({"a", "b", "-origin", "1", "2"}), "-origin needs a value: -origin <x> <y> <z>.");
    EXPECT_EQ(refusal({"a", "b", "-origin", "1", "2", "z"}), "-origin must be a number, not 'z'.");
    EXPECT_EQ(refusal({"a", "b", "-origin", "1", "2", "0.5"}),
              "-origin takes whole metres; leave the decimals out.");
    EXPECT_EQ(refusal({"a", "b", "-q", "-json"}),
              "-q prints no report and -json prints one; give one of them.");
}

TEST(MeshCommandLine, namesEveryOptionInItsTexts) {
    for (const mesh::MeshOption& option : mesh::mesh_options())
        for (const std::string& text : {tool_help(mesh::mesh_texts()), mesh::mesh_bash_completion()})
            EXPECT_NE(text.find("-" + option.name), std::string::npos) << option.name;
}

}  // namespace
}  // namespace d2b::test
