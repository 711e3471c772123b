// Writes the parts of docs/ that are made from the tables of options and attributes:
//   write_generated <docs folder>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "dem2buildings/help.hpp"
#include "features/attribute_table.hpp"

namespace {

std::string read(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: write_generated <docs folder>\n";
        return 2;
    }
    const std::string docs = argv[1];
    std::ofstream(docs + "/reference/options.md") << d2b::options_markdown();

    const std::string begin = "<!-- schema -->\n";
    const std::string end = "<!-- end of schema -->";
    std::string page = read(docs + "/reference/output.md");
    const std::size_t from = page.find(begin);
    const std::size_t to = page.find(end);
    if (from == std::string::npos || to == std::string::npos) {
        std::cerr << docs << "/reference/output.md lacks the marks of the schema\n";
        return 1;
    }
    page.replace(from + begin.size(), to - from - begin.size(), d2b::features::schema_markdown());
    std::ofstream(docs + "/reference/output.md") << page;
    return 0;
}
