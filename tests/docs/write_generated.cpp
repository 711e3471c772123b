// Writes the parts of docs/ that are made from the tables of options and attributes:
//   write_generated <docs folder>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "compare/change_layer.hpp"
#include "dem2buildings/help.hpp"
#include "features/attribute_table.hpp"

namespace {

std::string read(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// Replaces the text between `<!-- name -->` and `<!-- end of name -->`.
bool replace_part(const std::string& path, const std::string& name, const std::string& text) {
    const std::string begin = "<!-- " + name + " -->\n";
    std::string page = read(path);
    const std::size_t from = page.find(begin);
    const std::size_t to = page.find("<!-- end of " + name + " -->");
    if (from == std::string::npos || to == std::string::npos) {
        std::cerr << path << " lacks the marks of " << name << '\n';
        return false;
    }
    page.replace(from + begin.size(), to - from - begin.size(), text);
    std::ofstream(path) << page;
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: write_generated <docs folder>\n";
        return 2;
    }
    const std::string docs = argv[1];
    std::ofstream(docs + "/reference/options.md") << d2b::options_markdown();

    const bool done =
        replace_part(docs + "/reference/output.md", "schema", d2b::features::schema_markdown()) &&
        replace_part(docs + "/reference/compare.md", "changes",
                     d2b::features::schema_table(d2b::compare::change_fields()));
    return done ? 0 : 1;
}
